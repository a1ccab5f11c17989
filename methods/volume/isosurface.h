// What methods that show an isosurface by slices have in common: parameters, the surface's uniform block
// (isosurface.glsl), and the depth buffer that lets the nearest slice win.
#pragma once

#include <vector>

#include "backends/device.h"
#include "methods/volume/gradient_parameters.h"
#include "methods/volume/volume_uniforms.h"

namespace volumark {

// std140, binding 5 of isosurface.glsl, where the fields are explained.
struct SurfaceUniforms {
  Float4 colour{}, ambient{}, vectors{};
};
static_assert(sizeof(SurfaceUniforms) == 48);

inline constexpr uint32_t kSurfaceBinding = 5;

// What the texels of the data, with gradients or without, must tell.
struct SurfaceTexels {
  Format format = Format::R32F;
  float value_origin = 0, value_scale = 1;    // as in VolumeTexels
  float vector_scale = 1, vector_offset = 0;  // as in GradientTexels
};

// `scene.isosurface` is set. Data of exactly the isovalue are inside, whatever the rounding of a texture's filter: the
// value is lowered by 2^-22 of what its normalisation computes with; where texels are half floats it is rounded to one
// as the data are.
SurfaceUniforms surface_uniforms(const Scene& scene, const SurfaceTexels& texels);

namespace isosurface_parameters {

inline const Choice kOrder{
    "order",
    "front_to_back: with a depth buffer, so that what lies behind the surface is rejected before "
    "it is sampled; back_to_front: nearer slices overwrite",
    {"front_to_back", "back_to_front"},
    "front_to_back"};

inline const Choice kRefine{"refine",
                            "none: the surface is met at the first slice inside of it; linear: on the line between the "
                            "values of two slices",
                            {"none", "linear"},
                            "none",
                            Ideal<const char*>{"linear", "position of the surface"}};

using gradient_parameters::kNormals;

inline const Choice kGradientFormat{"gradient_format",
                                    "texels that hold gradient (or normal) and value together",
                                    {"rgba32f", "rgba16f", "rgba8"},
                                    "rgba16f",
                                    Ideal<const char*>{"rgba32f", "gradient texture and filter"}};

}  // namespace isosurface_parameters

// D32FS8 textures as large as the targets drawn to; each stays alive until the end, since draws recorded before may use
// it. Dies before the Device.
class DepthTarget {
 public:
  explicit DepthTarget(Device& device) : device_(device) {}
  ~DepthTarget();
  DepthTarget(const DepthTarget&) = delete;
  DepthTarget& operator=(const DepthTarget&) = delete;

  Texture of(int width, int height);

 private:
  Device& device_;
  std::vector<Texture> textures_;
};

// One depth a vertex for polygons drawn one after the other: the nth of `polygons` at (n + 1/2) / polygons, so that
// the first one drawn is the nearest. `indices`: triangles, fans polygon by polygon as build_slices makes them.
std::vector<float> drawing_depths(const std::vector<uint32_t>& indices, size_t vertices, int polygons);

}  // namespace volumark
