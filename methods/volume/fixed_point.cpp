#include "methods/volume/fixed_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace volumark {
namespace {

Float4 float4(const glm::dvec3& v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

// Levels of a vector of [-1, 1] or a colour of [0, 1], for the constant registers.
Float4 signed_levels(const glm::dvec3& v) {
  const auto level = [](double x) { return static_cast<double>(std::lround(std::clamp(x, -1., 1.) * 255)); };
  return float4({level(v.x), level(v.y), level(v.z)});
}
Float4 colour_levels(const glm::dvec3& v) { return signed_levels(glm::max(v, glm::dvec3(0))); }

// Texel coordinates run from 0 to the number of cells; along an axis of one sample the box is one cell wide.
glm::dvec3 cells_of(const Volume& volume) { return glm::dvec3(glm::max(volume.size - 1, glm::ivec3(1))); }

bool has_specular(const Scene& scene) { return scene.effects.lighting && scene.effects.lighting->specular > 0; }

// n where shininess is 2^n; nothing otherwise.
std::optional<int> squarings(double shininess) {
  const auto whole = static_cast<uint32_t>(std::clamp(shininess, 0., 65536.));
  if (static_cast<double>(whole) != shininess || !std::has_single_bit(whole)) return std::nullopt;
  return std::countr_zero(whole);
}

void fill_lights(const Scene& scene, const ViewRays& rays, FixedUniforms& uniforms) {
  const Lighting& lighting = *scene.effects.lighting;
  uniforms.lighting = colour_levels(glm::dvec3(lighting.ambient));
  uniforms.counts[0] = static_cast<float>(lighting.lights.size());
  // One direction to the eye a frame, from the middle of the box (the local frame's origin).
  const double distance = glm::length(rays.eye);
  const glm::dvec3 to_eye = rays.perspective && distance > 0 ? rays.eye / distance : -rays.forward;
  const glm::dmat3 to_local = glm::transpose(scene.volume->axes);
  for (size_t i = 0; i < lighting.lights.size() && i < kMaxFixedLights; ++i) {
    const Light& light = lighting.lights[i];
    const glm::dvec3 l = glm::normalize(to_local * light.vector), sum = l + to_eye;
    const double length = glm::length(sum);
    uniforms.lights[i].direction = signed_levels(l);
    uniforms.lights[i].half = signed_levels(length > 1e-12 ? sum / length : glm::dvec3(0));
    uniforms.lights[i].diffuse = colour_levels(light.colour * lighting.diffuse);
    uniforms.lights[i].specular = colour_levels(light.colour * lighting.specular);
  }
}

}  // namespace

FixedDepths fixed_depths(const Volume& volume, const ViewRays& rays, double step) {
  const glm::dvec3 reach = volume.extent() * 0.5;
  const double middle = -glm::dot(rays.origin, rays.forward), half = glm::dot(reach, glm::abs(rays.forward));
  const double first = std::max(middle - half, rays.z_near), end = middle + half;
  return {first, end > first ? static_cast<int>(std::ceil((end - first) / step - 1e-9)) : 0};
}

FixedUniforms fixed_uniforms(const Scene& scene, const View& view, int width, int height, double step) {
  const Volume& volume = *scene.volume;
  const ViewRays rays = view_rays(volume, view, width, height);
  const glm::dvec3 extent = volume.extent(), cells = cells_of(volume), scale = cells / extent;
  FixedUniforms uniforms;
  // NDC x = 2 X / width - 1, y = 1 - 2 Y / height.
  uniforms.origin = float4((rays.origin - rays.origin_x + rays.origin_y) * scale + 0.5 * cells);
  uniforms.origin_x = float4(rays.origin_x * scale * (2. / width));
  uniforms.origin_y = float4(rays.origin_y * scale * (-2. / height));
  uniforms.direction = float4((rays.direction - rays.direction_x + rays.direction_y) * scale);
  uniforms.direction_x = float4(rays.direction_x * scale * (2. / width));
  uniforms.direction_y = float4(rays.direction_y * scale * (-2. / height));
  uniforms.metric = float4(1. / scale);
  const FixedDepths depths = fixed_depths(volume, rays, step);
  uniforms.depth = {static_cast<float>(depths.first), static_cast<float>(step), rays.perspective ? 1.F : 0.F, 0};
  uniforms.limit = float4(cells * 256.);
  uniforms.last = float4(glm::dvec3(volume.size - 1));
  const std::vector<LocalPlane> planes = local_clip_planes(scene);
  for (size_t i = 0; i < planes.size() && i < kMaxClipPlanes; ++i) {
    // local = (t / 256 - cells / 2) / scale.
    const glm::dvec3 normal = planes[i].normal / scale;
    uniforms.clip_planes[i] = float4(normal, 256 * (planes[i].distance + 0.5 * glm::dot(normal, cells)));
  }
  uniforms.counts[1] = static_cast<float>(planes.size());
  if (scene.effects.lighting) fill_lights(scene, rays, uniforms);
  const int power = has_specular(scene) ? squarings(scene.effects.lighting->shininess).value_or(0) + 1 : 0;
  uniforms.counts[2] = static_cast<float>(power);
  uniforms.counts[3] = scene.effects.lighting && scene.effects.lighting->two_sided ? 1.F : 0.F;
  return uniforms;
}

FixedResources::FixedResources(const Scene& scene, std::span<const uint8_t> texels, std::span<const uint8_t> palette,
                               Device& device)
    : device_(device) {
  const glm::ivec3 size = scene.volume->size;
  const auto voxels = static_cast<size_t>(size.x) * static_cast<size_t>(size.y) * static_cast<size_t>(size.z);
  volume_ = device.create_texture({.label = "8-bit volume",
                                   .dimension = 3,
                                   .format = texels.size() == voxels ? Format::R8 : Format::RGBA8,
                                   .width = size.x,
                                   .height = size.y,
                                   .depth = size.z,
                                   .data = std::as_bytes(texels)});
  // The destructor does not run when a constructor throws.
  try {
    palette_ = device.create_texture(
        {.label = "palette", .dimension = 1, .format = Format::RGBA8, .width = 256, .data = std::as_bytes(palette)});
  } catch (...) {
    device.destroy(volume_);
    throw;
  }
  texture_bytes_ = texels.size() + palette.size();
}

FixedResources::~FixedResources() {
  device_.destroy(volume_);
  device_.destroy(palette_);
}

std::vector<BindingDecl> FixedResources::declarations() {
  return {{0, BindingKind::Uniform, 0}, {1, BindingKind::Sampled, 3}, {2, BindingKind::Sampled, 1}};
}

std::vector<Binding> FixedResources::bindings(Buffer uniforms) const {
  constexpr Sampler kTexels{Filter::Nearest, Wrap::Clamp};  // filtering is the program's own
  return {bind_uniform(0, uniforms), bind_sampled(1, volume_, kTexels), bind_sampled(2, palette_, kTexels)};
}

std::vector<SpecConstant> FixedResources::constants(const Scene& scene, const FixedSettings& settings) {
  const Lighting* lighting = scene.effects.lighting ? &*scene.effects.lighting : nullptr;
  return {{"VM_CLASSIFIED", settings.classification == Classification::Pre ? 1 : 0},
          {"VM_LIGHTS", lighting != nullptr ? static_cast<int32_t>(lighting->lights.size()) : 0},
          {"VM_SPECULAR", has_specular(scene) ? squarings(lighting->shininess).value_or(0) + 1 : 0},
          {"VM_TWO_SIDED", lighting != nullptr && lighting->two_sided ? 1 : 0},
          {"VM_CLIP_PLANES", static_cast<int32_t>(scene.effects.clip_planes.size())}};
}

std::optional<std::string> fixed_point_unsupported(const Scene& scene, Classification classification) {
  if (!scene.effects.fixed_point) return std::nullopt;
  if (classification == Classification::Preintegrated) {
    return "8-bit palettes are applied to samples or voxels, not to segments: choose classification post or pre";
  }
  if (scene.effects.lighting) {
    const Lighting& lighting = *scene.effects.lighting;
    if (lighting.lights.size() > kMaxFixedLights) {
      return fmt::format("{} lights, at most {} fit the combiners' constants", lighting.lights.size(), kMaxFixedLights);
    }
    for (const Light& light : lighting.lights) {
      if (light.kind == Light::Kind::Point) {
        return "a point light has another direction at every sample, combiner constants hold one a frame";
      }
    }
    if (has_specular(scene) && !squarings(lighting.shininess)) {
      return fmt::format("shininess {} is not a power of two, and combiners raise to a power by squaring",
                         lighting.shininess);
    }
  }
  if (scene.volume) {
    const glm::ivec3 size = scene.volume->size;
    const bool scalar = classification != Classification::Pre && !scene.effects.lighting;
    const double bytes = (size.x + 1.) * (size.y + 1.) * (size.z + 1.) * (scalar ? 1 : 4);
    if (bytes >= 0x1p31) {
      return fmt::format("8-bit texels of {}x{}x{} samples take {:.1f} GiB, at most 2 are addressed", size.x, size.y,
                         size.z, bytes / 0x1p30);
    }
  }
  return std::nullopt;
}

}  // namespace volumark
