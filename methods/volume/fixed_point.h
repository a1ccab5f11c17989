// The effect fixed_point: the arithmetic of the boards of 2000 (docs/effects.md has the definition and its sources).
// What its programs read: an 8-bit volume and palette made on the host, and vectors and colours in levels of 1/255.
// Everything that decides a bit of the picture is an integer, or float arithmetic in one fixed order without
// contraction.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "backends/device.h"
#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_uniforms.h"
#include "scenes/scene.h"

namespace volumark {

inline constexpr int kMaxFixedLights = 8;

struct FixedLight {
  Float4 direction;  // to the light, local frame, in signed levels -255..255
  Float4 half;       // between it and the eye, which is as far away as the boards' constant registers have it
  Float4 diffuse;    // levels 0..255
  Float4 specular;
};

// The block of fixed_point.glsl (std140, binding 0), where the fields are explained.
struct FixedUniforms {
  Float4 origin{}, origin_x{}, origin_y{};
  Float4 direction{}, direction_x{}, direction_y{};
  Float4 metric{};
  Float4 depth{};
  Float4 limit{};
  Float4 last{};
  Float4 lighting{};
  Float4 counts{};
  Float4 bricks{};
  Float4 clip_planes[kMaxClipPlanes]{};
  FixedLight lights[kMaxFixedLights]{};
};
static_assert(sizeof(FixedUniforms) == (13 + kMaxClipPlanes + 4 * kMaxFixedLights) * 16);

struct FixedSettings {
  Classification classification = Classification::Post;  // Post or Pre
  bool linear_opacity = false;
  double step = 1;  // world units between samples, > 0
};

// Where the samples lie in depth: sample k at first + (k + .5) step, counted from the reference plane of ViewRays.
struct FixedDepths {
  double first = 0;  // where the box, cut by the near plane, begins
  int count = 0;     // samples until it ends
};
FixedDepths fixed_depths(const Volume& volume, const ViewRays& rays, double step);

// The 256 entries of the palette, RGBA: colour, and opacity of one step. Levels.
std::vector<uint8_t> fixed_palette(const Scene& scene, const FixedSettings& settings);
// Texels, x fastest: R8 (the value in the transfer window), with lighting RGBA8 (normal, value), pre-classified RGBA8
// (associated colour, opacity).
std::vector<uint8_t> fixed_texels(const Scene& scene, const FixedSettings& settings);

// Fills everything but limit.w, lighting.w and bricks, which are for programs that walk along a ray.
FixedUniforms fixed_uniforms(const Scene& scene, const View& view, int width, int height, double step);

// What the programs read; owns its objects, dies before the Device.
class FixedResources {
 public:
  // `texels` and `palette`: of fixed_texels and fixed_palette.
  FixedResources(const Scene& scene, std::span<const uint8_t> texels, std::span<const uint8_t> palette, Device& device);
  ~FixedResources();
  FixedResources(const FixedResources&) = delete;
  FixedResources& operator=(const FixedResources&) = delete;

  // Bindings 0..2 and constants 0..4 of fixed_point.glsl.
  static std::vector<BindingDecl> declarations();
  static std::vector<SpecConstant> constants(const Scene& scene, const FixedSettings& settings);
  std::vector<Binding> bindings(Buffer uniforms) const;
  size_t texture_bytes() const { return texture_bytes_; }

 private:
  Device& device_;
  Texture volume_, palette_;
  size_t texture_bytes_ = 0;
};

// Why the effect cannot be simulated for this scene; nothing where it can, or where the scene does not call for it.
std::optional<std::string> fixed_point_unsupported(const Scene& scene, Classification classification);

}  // namespace volumark
