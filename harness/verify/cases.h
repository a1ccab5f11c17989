// The functions of the hard cases, one family a file; case_list.cpp says which is which.
#pragma once

#include "harness/verify/case_run.h"

namespace volumark::hard_cases {

// closed_form.cpp
void slab(CaseRun& run);
void sphere(CaseRun& run);
void grazing_shell(CaseRun& run);
void clip_planes(CaseRun& run);
void eye_and_ties(CaseRun& run);
// segments.cpp
void preintegration_table(CaseRun& run);
void linear_segment(CaseRun& run);
void opacity_correction(CaseRun& run);
void associated_colours(CaseRun& run);
// fields.cpp
void plane_field(CaseRun& run);
void sphere_field(CaseRun& run);
void marschner_lobb(CaseRun& run);
// precision.cpp
void eight_bit_accumulation(CaseRun& run);
void eight_bit_target(CaseRun& run);
void many_segments(CaseRun& run);
void scale_and_place(CaseRun& run);
// data.cpp
void refused_data(CaseRun& run);
void degenerate_volumes(CaseRun& run);
void extreme_transfer(CaseRun& run);
void isovalue_outside(CaseRun& run);
// reference_cases.cpp
void reference_on_levels(CaseRun& run);
void reference_bound(CaseRun& run);
// along_rays.cpp
void segments_in_order(CaseRun& run);
void thin_medium(CaseRun& run);
void early_end(CaseRun& run);
// lattices.cpp
void lit_gradient(CaseRun& run);
void voxel_types(CaseRun& run);
void order_around_eye(CaseRun& run);
// stacks.cpp
void stack_switch(CaseRun& run);
void polygon_textures(CaseRun& run);
void thick_slices(CaseRun& run);
// isosurfaces.cpp
void isosurface_plane(CaseRun& run);
void isosurface_waves(CaseRun& run);
void isosurface_on_levels(CaseRun& run);
// agreement.cpp
void agreement(CaseRun& run);

}  // namespace volumark::hard_cases
