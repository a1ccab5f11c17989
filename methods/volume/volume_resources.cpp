#include "methods/volume/volume_resources.h"

#include <fmt/format.h>

#include <algorithm>

namespace volumark {

VolumeResources::VolumeResources(const Scene& scene, const VolumeSettings& settings, Device& device)
    : device_(device), table_size_(settings.table_size), preintegrated_size_(settings.preintegrated_size) {
  // The destructor does not run when a constructor throws: a refused texture must not leak the ones before it.
  try {
    create_volume(scene, settings);
    const std::vector<float> table = transfer_table(scene.transfer, table_size_);
    TextureDesc desc;
    desc.label = "transfer table";
    desc.dimension = 1;
    desc.width = table_size_;
    desc.data = bytes_of(table);
    transfer_ = create(desc);
    // Bound by every program, so there is always one; a single black texel where nobody looks at it.
    const bool used = settings.classification == Classification::Preintegrated;
    if (!used) preintegrated_size_ = 1;
    const std::vector<float> segments =
        used ? preintegration_table(scene.transfer, preintegrated_size_, settings.segment) : std::vector<float>(4);
    desc.label = "pre-integration table";
    desc.dimension = 2;
    desc.width = desc.height = preintegrated_size_;
    desc.data = bytes_of(segments);
    preintegrated_ = create(desc);
  } catch (...) {
    release();
    throw;
  }
}

VolumeResources::~VolumeResources() { release(); }

void VolumeResources::release() {
  for (const Texture texture : {volume_, transfer_, preintegrated_}) {
    if (texture) device_.destroy(texture);
  }
}

Texture VolumeResources::create(const TextureDesc& desc) {
  texture_bytes_ += static_cast<size_t>(desc.width) * static_cast<size_t>(desc.height) *
                    static_cast<size_t>(desc.depth) * texel_bytes(desc.format);
  return device_.create_texture(desc);
}

std::vector<BindingDecl> VolumeResources::declarations() {
  return {{0, BindingKind::Uniform, 0},
          {1, BindingKind::Sampled, 3},
          {2, BindingKind::Sampled, 1},
          {3, BindingKind::Sampled, 2}};
}

std::vector<Binding> VolumeResources::bindings(Buffer uniforms) const {
  constexpr Sampler kTable{Filter::Nearest, Wrap::Clamp};  // tables are read by texelFetch
  return {bind_uniform(0, uniforms), bind_sampled(1, volume_, {Filter::Linear, Wrap::Clamp}),
          bind_sampled(2, transfer_, kTable), bind_sampled(3, preintegrated_, kTable)};
}

std::vector<SpecConstant> VolumeResources::constants(const Scene& scene, Classification classification,
                                                     bool linear_opacity) {
  const Lighting* lighting = scene.effects.lighting ? &*scene.effects.lighting : nullptr;
  return {{"VM_CLASSIFICATION", static_cast<int32_t>(classification)},
          {"VM_LINEAR_OPACITY", linear_opacity ? 1 : 0},
          {"VM_LIGHTS", lighting != nullptr ? static_cast<int32_t>(lighting->lights.size()) : 0},
          {"VM_SPECULAR", lighting != nullptr && lighting->specular > 0 ? 1 : 0},
          {"VM_TWO_SIDED", lighting != nullptr && lighting->two_sided ? 1 : 0},
          {"VM_CLIP_PLANES", static_cast<int32_t>(scene.effects.clip_planes.size())}};
}

void VolumeResources::fill(VolumeUniforms& uniforms) const {
  uniforms.value = {value_origin_, value_scale_, static_cast<float>(table_size_ - 1),
                    static_cast<float>(preintegrated_size_ - 1)};
}

std::optional<std::string> volume_unsupported(const Scene& scene, const VolumeSettings& settings,
                                              const BackendInfo& backend) {
  if (scene.volume) {
    const glm::ivec3 size = scene.volume->size;
    const int largest = std::max({size.x, size.y, size.z});
    if (largest > backend.limits.texture_3d) {
      return fmt::format("the volume is {}x{}x{}, 3D textures of {} go to {}", size.x, size.y, size.z, backend.id,
                         backend.limits.texture_3d);
    }
  }
  if (settings.table_size > backend.limits.texture_1d) {
    return fmt::format("table_size is {}, 1D textures of {} go to {}", settings.table_size, backend.id,
                       backend.limits.texture_1d);
  }
  if (settings.classification == Classification::Preintegrated &&
      settings.preintegrated_size > backend.limits.texture_2d) {
    return fmt::format("preintegrated_size is {}, 2D textures of {} go to {}", settings.preintegrated_size, backend.id,
                       backend.limits.texture_2d);
  }
  if (scene.effects.clip_planes.size() > kMaxClipPlanes) {
    return fmt::format("{} clip planes, at most {} are simulated", scene.effects.clip_planes.size(), kMaxClipPlanes);
  }
  if (scene.effects.lighting && scene.effects.lighting->lights.size() > kMaxLights) {
    return fmt::format("{} lights, at most {} are simulated", scene.effects.lighting->lights.size(), kMaxLights);
  }
  if (scene.effects.lighting && settings.classification == Classification::Pre) {
    return "lighting needs the gradient of the data, which a pre-classified volume no longer holds";
  }
  return std::nullopt;
}

}  // namespace volumark
