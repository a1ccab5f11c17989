// Fields given by a formula, for tests whose answer is known and for scenes that need no file. Each is seeded or
// closed: the same specification gives the same samples everywhere. Positions are p = world / (extent / 2), so that the
// longest axis of the lattice spans [-1, 1]; the box is centred at the world's origin, its spacing is the same on all
// axes.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <variant>

#include "scenes/vessel_tree.h"
#include "scenes/volume.h"

namespace volumark {

// The same value everywhere.
struct ConstantField {
  double value = 1;
};
// value = |p| * extent / 2: the distance from the centre in world units. Trilinear interpolation of samples h apart
// lies above it by at most h^2 / (4 r) at radius r: a sphere {value < r} shrinks by that much.
struct DistanceField {};
// value = from + (to - from) u, with u in [0, 1] along the axis of the box.
struct RampField {
  int axis = 0;
  double from = 0, to = 1;
};
// Marschner and Lobb, An Evaluation of Reconstruction Filters for Volume Rendering, IEEE Visualization 1994:
// rho(x, y, z) = (1 - sin(pi z / 2) + alpha (1 + rho_r(sqrt(x^2 + y^2)))) / (2 (1 + alpha)), in [0, 1],
// rho_r(r) = cos(2 pi f_M cos(pi r / 2)).
struct MarschnerLobbField {
  double frequency = 6, alpha = 0.25;
};
// value = 1 / (1 + exp(-steepness (radius - |p| + amplitude fbm(frequency p)))), in (0, 1): a ball with a fractal
// surface. fbm: the sum over `octaves` of gain^o noise(2^o q), with Perlin's improved noise (SIGGRAPH 2002) over a
// permutation shuffled from the seed.
struct PerlinCloudField {
  uint32_t seed = 1;
  int octaves = 4;
  double frequency = 2.5, gain = 0.5, radius = 0.55, amplitude = 0.7, steepness = 10;
};
using Field =
    std::variant<ConstantField, DistanceField, RampField, MarschnerLobbField, PerlinCloudField, VesselTreeField>;

struct ProceduralSpec {
  Field field;
  glm::ivec3 size{128};
  VoxelType type = VoxelType::F32;
  double extent = 2;  // world length of the longest axis
};

double marschner_lobb(const MarschnerLobbField& field, const glm::dvec3& p);
double perlin_cloud(const PerlinCloudField& field, const glm::dvec3& p);

// Least and greatest value that the field can take in the box: the range over which integer voxels are spread.
struct FieldRange {
  double lo, hi;
};
FieldRange field_range(const ProceduralSpec& spec);

// F32: the values. Integer types: rounded to the type's non-negative levels over field_range, with slope and intercept
// such that data values stay those of the field.
Volume make_volume(const ProceduralSpec& spec);

}  // namespace volumark
