// Small scenes with known pictures, put together in memory: boxes, spheres, slabs, ramps, and the views onto them.
#pragma once

#include <vector>

#include "scenes/procedural.h"
#include "scenes/scene.h"

namespace volumark {

inline constexpr double kSlabDepth = 1 - 0.3678794411714423216;  // opacity at optical depth 1

// f32 samples of the field; the longest axis is `extent` world units, the box is centred at the origin.
Volume volume_of(const Field& field, const glm::ivec3& size, double extent = 2);
// The same, of values x fastest.
Volume volume_of(const std::vector<float>& values, const glm::ivec3& size, const glm::dvec3& spacing);

// One colour and one extinction for all values.
TransferFunction homogeneous(double extinction, const glm::dvec3& colour = glm::dvec3(1));
TransferFunction transfer_of(std::vector<TransferPoint> points, double lo = 0, double hi = 1);
Scene scene_of(Volume volume, TransferFunction transfer);

// Towards the origin along `direction`, from outside.
View orthographic(const glm::dvec3& direction, double half_height, double distance = 4);
View perspective(const glm::dvec3& eye, const glm::dvec3& target, double fov_y = 0.7);

// A box of `samples`^3 values 1 and side 2 whose extinction makes the optical depth along an axis `depth`.
Scene homogeneous_cube(int samples, double depth);
// A cloud of two octaves in perspective: smooth, coloured, nothing symmetric.
Scene small_cloud();

// How far a sample or the end of a chord may lie from its place, in world units, for a box of side 2. Places come from
// plane equations through the corners of polygons, floats of 2^-24 of the box: across a picture of so many pixels a
// polygon that is a pixel wide is off by that many times their rounding, once for each of its two gradients.
inline double place_error(int pixels) { return 2 * 2 * pixels * 0x1p-24; }

// The part of a ray inside of the axis-aligned box [-half, half]; the ray's t of entry and exit, empty where they
// cross.
struct Chord {
  double t0 = 0, t1 = 0;
  double length() const { return t1 > t0 ? t1 - t0 : 0; }
};
Chord box_chord(const Ray& ray, const glm::dvec3& half);
// Cut further, to where normal . p >= distance.
Chord cut_chord(Chord chord, const Ray& ray, const ClipPlane& plane);

}  // namespace volumark
