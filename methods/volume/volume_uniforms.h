// The C++ side of the uniform block in volume_common.glsl (std140, binding 0), and how it is filled from a scene and a
// view. All of it is computed in double precision relative to the volume's middle, and only then rounded to float: a
// scene far from the origin looks as it does at the origin.
#pragma once

#include <array>
#include <cstddef>

#include "scenes/scene.h"

namespace volumark {

inline constexpr int kMaxClipPlanes = 16;
inline constexpr int kMaxLights = 64;

using Float4 = std::array<float, 4>;

struct VolumeLight {
  Float4 vector;  // local frame; w = 0: unit direction towards the light, w = 1: position
  Float4 colour;
};

// Field by field as in volume_common.glsl, where they are explained.
struct VolumeUniforms {
  Float4 ray_origin{}, ray_origin_x{}, ray_origin_y{};
  Float4 ray_direction{}, ray_direction_x{}, ray_direction_y{};
  Float4 depth{};
  Float4 extent{};
  Float4 size{};
  Float4 texture_scale{};
  Float4 texture_offset{};
  Float4 texel{};
  Float4 value{};
  Float4 gradient_scale{};
  Float4 eye{};
  Float4 forward{};
  Float4 lighting{};
  Float4 counts{};
  Float4 own[4]{};
  Float4 clip_planes[kMaxClipPlanes]{};
  VolumeLight lights[kMaxLights]{};
};
static_assert(offsetof(VolumeUniforms, ray_direction) == 48);
static_assert(offsetof(VolumeUniforms, depth) == 96);
static_assert(offsetof(VolumeUniforms, extent) == 112);
static_assert(offsetof(VolumeUniforms, value) == 192);
static_assert(offsetof(VolumeUniforms, lighting) == 256);
static_assert(offsetof(VolumeUniforms, own) == 288);
static_assert(offsetof(VolumeUniforms, clip_planes) == 352);
static_assert(offsetof(VolumeUniforms, lights) == 608);
static_assert(sizeof(VolumeUniforms) == 608 + kMaxLights * 32);

// The rays of a view in double precision: P(z) = origin + z * direction in local coordinates (the volume's own axes,
// world units, origin at the middle of the box), both affine in NDC. z is depth along `forward` from the reference
// plane.
struct ViewRays {
  glm::dvec3 origin, origin_x, origin_y;
  glm::dvec3 direction, direction_x, direction_y;
  glm::dvec3 eye, forward;  // orthographic: eye is any point on the plane of depth 0
  double reference_depth;   // of the reference plane, along forward from the eye
  double z_near;            // of the near plane, relative to the reference plane
  bool perspective;

  glm::dvec3 at(double x, double y, double z) const {
    return origin + x * origin_x + y * origin_y + z * (direction + x * direction_x + y * direction_y);
  }
};
ViewRays view_rays(const Volume& volume, const View& view, int width, int height);

// A half space of the local frame: keeps dot(normal, p) >= distance.
struct LocalPlane {
  glm::dvec3 normal;
  double distance;
};
std::vector<LocalPlane> local_clip_planes(const Scene& scene);

double smallest_spacing(const Volume& volume);

// Fills lighting, lights and counts.xzw, in a frame with its origin at `middle` (world) and axes `to_local`.
void fill_lights(const Lighting& lighting, const glm::dvec3& middle, const glm::dmat3& to_local,
                 VolumeUniforms& uniforms);

// Fills everything but `value` (VolumeResources does), depth.yzw and `own` (the method does).
VolumeUniforms volume_uniforms(const Scene& scene, const View& view, int width, int height);

}  // namespace volumark
