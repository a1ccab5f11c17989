// A second integrator to check the reference with: long double, straight from the scene's definitions (Volume::at,
// TransferFunction::at, trilinear weights), sharing no code and no formula with methods/reference.
#pragma once

#include <array>
#include <random>

#include "scenes/scene.h"

namespace volumark::brute {

// Premultiplied rgba, to about 1e-14 without lighting. Lit, normals that turn fast where the gradient nearly vanishes
// need a `fineness` of 40 for that: it multiplies the number of sub-intervals. Clip planes and t_near as documented.
std::array<long double, 4> brute_force(const Scene& scene, const Ray& ray, int fineness = 1);

// A volume of these sizes with samples uniform in [0, 1], stored as `type`.
Volume random_volume(const glm::ivec3& size, VoxelType type, std::mt19937_64& random);
Volume constant_volume(const glm::ivec3& size, double value);
// value = index along x / (size.x - 1), spacing such that the box is the unit cube.
Volume unit_ramp(const glm::ivec3& size);
// Distance from the world's origin, in a box of [-half, half]^3 of n^3 samples.
Volume distance_volume(int n, double half);

Scene scene_of(Volume volume, std::vector<TransferPoint> points);
Ray ray_between(const glm::dvec3& from, const glm::dvec3& to);

}  // namespace volumark::brute
