// What volume methods put on a Device before the first frame: the volume as a 3D texture, the transfer function and its
// pre-integration as tables. Owns these objects; dies before the Device. Parameters: volume_parameters.h.
#pragma once

#include <optional>
#include <string>

#include "backends/device.h"
#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_uniforms.h"
#include "scenes/scene.h"

namespace volumark {

// ---- Tables ---------------------------------------------------------------------------------------------------------
// (r, g, b, tau) at `nodes` values evenly spaced over the window, the ends included. Between nodes the table is
// interpolated linearly: exact where every control point falls on a node (1021 = 4 * 255 + 1 nodes hold every quarter
// of a level of an 8-bit window); otherwise a kink inside an interval errs by at most a quarter of the change of slope
// times the interval, and a jump is smeared over one interval, with the same integral (at a node: the second value).
std::vector<float> transfer_table(const TransferFunction& transfer, int nodes);

// size x size texels, x: front, y: back. Along a segment on which s runs linearly from front to back: rgb = the
// emission and a = the extinction of a homogeneous segment that looks the same. Extinction is the exact mean; emission
// includes self-attenuation over `segment` world units, exact at that length, and at others to second order. Cost
// O(size^2).
std::vector<float> preintegration_table(const TransferFunction& transfer, int size, double segment);

// ---- Resources ------------------------------------------------------------------------------------------------------
struct VolumeSettings {
  std::string volume_format = "native";
  Classification classification = Classification::Post;
  int table_size = 1021;
  int preintegrated_size = 256;
  double segment = 0;  // world units; of the pre-integration table
};

class VolumeResources {
 public:
  VolumeResources(const Scene& scene, const VolumeSettings& settings, Device& device);
  ~VolumeResources();
  VolumeResources(const VolumeResources&) = delete;
  VolumeResources& operator=(const VolumeResources&) = delete;

  // Bindings 0..3 of volume_common.glsl.
  static std::vector<BindingDecl> declarations();
  std::vector<Binding> bindings(Buffer uniforms) const;
  // Constants 0..5 of volume_common.glsl.
  static std::vector<SpecConstant> constants(const Scene& scene, Classification classification, bool linear_opacity);
  // Sets uniforms.value.
  void fill(VolumeUniforms& uniforms) const;

  size_t texture_bytes() const { return texture_bytes_; }
  Texture volume() const { return volume_; }
  // s_n = (stored - origin) * scale, with `stored` as the texture returns it.
  float value_origin() const { return value_origin_; }
  float value_scale() const { return value_scale_; }

 private:
  void create_volume(const Scene& scene, const VolumeSettings& settings);
  Texture create(const TextureDesc& desc);
  void release();

  Device& device_;
  Texture volume_, transfer_, preintegrated_;
  float value_origin_ = 0, value_scale_ = 1;
  int table_size_ = 0, preintegrated_size_ = 0;
  size_t texture_bytes_ = 0;
};

// Why these resources cannot be had on `backend`; nothing where they can.
std::optional<std::string> volume_unsupported(const Scene& scene, const VolumeSettings& settings,
                                              const BackendInfo& backend);

}  // namespace volumark
