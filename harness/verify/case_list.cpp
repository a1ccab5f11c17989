#include <array>

#include "harness/verify/cases.h"

namespace volumark {

// The one list of hard cases: add yours here, with its function in a file of its family. Numbers are those of
// docs/stability.md.
std::span<const HardCase> hard_case_list() {
  using namespace hard_cases;
  static const HardCase list[] = {
      {"slab", "1", "Homogeneous slab in any number of slices", "1 - exp(-tau L); linear opacity: 1 - (1 - 1/n)^n",
       CaseNeeds::Method, slab},
      {"sphere", "2", "Homogeneous sphere, every pixel and the mean over the disc", "exp(-2 tau sqrt(R^2 - b^2))",
       CaseNeeds::Method, sphere},
      {"grazing_shell", "3", "Thin shell, grazed", "2 sqrt(R^2 - b^2) - 2 sqrt(r^2 - b^2)", CaseNeeds::Method,
       grazing_shell},
      {"preintegration_table", "4", "Pre-integrated segments of linear extinction",
       "Williams and Max 1992; Moreland and Angel 2004: I = Lf (1 - Psi) + Lb (Psi - zeta)", CaseNeeds::Host,
       preintegration_table},
      {"linear_segment", "4", "One pre-integrated segment, drawn", "I = Lf (1 - Psi) + Lb (Psi - zeta)",
       CaseNeeds::Method, linear_segment},
      {"segments_in_order", "4", "Pre-integrated segments, composed", "I = Lf (1 - Psi) + Lb (Psi - zeta) of the whole",
       CaseNeeds::Method, segments_in_order},
      {"opacity_correction", "5", "Opacity correction for any step, and along the diagonal", "1 - (1 - a)^(d / voxel)",
       CaseNeeds::Method, opacity_correction},
      {"plane_field", "6", "Linear fields are exact under trilinear interpolation", "extinction at the chord's middle",
       CaseNeeds::Method, plane_field},
      {"sphere_field", "6", "Sphere distances: one-sided error, order 2 (reference)", "h^2 / (4 r)", CaseNeeds::Host,
       sphere_field},
      {"marschner_lobb", "7", "Marschner-Lobb field, f_M = 6, alpha = .25, from 41^3", "Marschner and Lobb 1994",
       CaseNeeds::Method, marschner_lobb},
      {"associated_colours", "8", "Interpolation of associated colours", "the middle of red and nothing is half of red",
       CaseNeeds::Method, associated_colours},
      {"eight_bit_accumulation", "9", "Accumulation in 8 bits stalls where it must", "ceil(255 - 127.5 / k)",
       CaseNeeds::Method, eight_bit_accumulation},
      {"eight_bit_target", "9", "Targets of few bits err by no more than their rounding", "rounding of each blend",
       CaseNeeds::Method, eight_bit_target},
      {"many_segments", "10", "Up to 1e5 segments of one ray", "1 - 1/e", CaseNeeds::Method, many_segments},
      {"thin_medium", "10", "Thin segments, to their own digits", "1 - exp(-tau L)", CaseNeeds::Method, thin_medium},
      {"early_end", "10", "Rays that may end early", "at most the threshold is lost", CaseNeeds::Method, early_end},
      {"clip_planes", "11", "A homogeneous cube behind clip planes", "tau (L - z0)", CaseNeeds::Method, clip_planes},
      {"octree_levels", "12", "Constant and linear fields over any mixture of levels", "needs an octree",
       CaseNeeds::Absent, nullptr},
      {"prism_sections", "13", "Prism and plane: all 27 classes", "needs shells", CaseNeeds::Absent, nullptr},
      {"shared_faces", "14", "Neighbouring prisms: no crack, no double hit", "needs shells", CaseNeeds::Absent,
       nullptr},
      {"degenerate_prisms", "15", "Prisms of no thickness, flipped, slivers", "needs shells", CaseNeeds::Absent,
       nullptr},
      {"scale_and_place", "16", "Scenes of any size, at any place", "the same picture", CaseNeeds::Method,
       scale_and_place},
      {"lambda_at_infinity", "17", "Edges parallel to the slice", "needs shells", CaseNeeds::Absent, nullptr},
      {"projected_tetrahedra", "18", "Each class of a projected tetrahedron", "needs tetrahedra", CaseNeeds::Absent,
       nullptr},
      {"distance_volumes", "19", "Distance volumes of meshes that are not closed", "needs distance volumes of meshes",
       CaseNeeds::Absent, nullptr},
      {"octree_refinement", "20", "T-vertices and jumps of level", "needs an octree", CaseNeeds::Absent, nullptr},
      {"eye_and_ties", "21", "Eye on a slice and inside the volume, views at 45 degrees", "1 - exp(-tau chord)",
       CaseNeeds::Method, eye_and_ties},
      {"spherical_domain", "22", "Poles, date line, eye inside", "needs the effect spherical_domain", CaseNeeds::Absent,
       nullptr},
      {"refused_data", "23", "Not a number, infinity, short files", "a refusal that says why", CaseNeeds::Host,
       refused_data},
      {"degenerate_volumes", "23", "Volumes of one sample along an axis", "a box of one spacing", CaseNeeds::Method,
       degenerate_volumes},
      {"extreme_transfer", "23", "No opacity, full opacity, a step, values outside, denormals", "1 - exp(-tau chord)",
       CaseNeeds::Method, extreme_transfer},
      {"reference_on_levels", "23a", "The reference where a jump lies on a level of the data",
       "an integrator in long double that shares no code with it", CaseNeeds::Host, reference_on_levels},
      {"reference_bound", "23b", "The reference's bound at extinction 50 a voxel and at tangent steps",
       "an integrator in long double that shares no code with it", CaseNeeds::Host, reference_bound},
      {"voxel_types", "23", "The same data in every type of voxel", "the picture of the floats", CaseNeeds::Method,
       voxel_types},
      {"lit_gradient", "23", "Light on lattices of unequal spacing, turned, and on none at all",
       "(c (ambient + diffuse n.l) + specular (n.h)^s) (1 - exp(-tau L))", CaseNeeds::Method, lit_gradient},
      {"sensitivity", "24", "The picture follows the camera in proportion",
       "a hundredth of what a hundredfold motion does", CaseNeeds::Scenes, nullptr},
      {"agreement", "25", "Backends agree on every shipped scene", "the same programs", CaseNeeds::Backends, agreement},
  };
  return list;
}

}  // namespace volumark
