#include "methods/slices2d/stacks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "backends/defects.h"
#include "methods/volume/volume_texels.h"

namespace volumark {
namespace {

// Tiles along one side.
int tiles_in(int extent, int tile) { return std::max(extent / tile, 1); }

// Vectors in RGB with the axes of the stack's frame.
void turn_vectors(std::vector<std::byte>& texels, size_t texel, int axis) {
  const size_t channel = texel / 4, first = static_cast<size_t>((axis + 1) % 3) * channel;
  for (size_t at = 0; at < texels.size(); at += texel) {
    std::byte* vector = texels.data() + at;
    std::rotate(vector, vector + first, vector + 3 * channel);
  }
}

// The ray that stands for the view (best_stack).
glm::dvec3 main_direction(const Volume& volume, const ViewRays& rays) {
  if (!rays.perspective) return rays.forward;
  const glm::dvec3 reach = glm::abs(rays.eye) / (0.5 * volume.extent());
  const bool inside = std::max({reach.x, reach.y, reach.z}) < 1;
  const glm::dvec3 to_middle = -rays.eye;
  const double depth = glm::dot(to_middle, rays.forward);
  if (inside || !(depth > rays.reference_depth + rays.z_near)) return rays.forward;
  const auto ndc = [&](const glm::dvec3& axis) { return glm::dot(to_middle, axis) / glm::dot(axis, axis) / depth; };
  if (std::abs(ndc(rays.direction_x)) > 1 || std::abs(ndc(rays.direction_y)) > 1) return rays.forward;
  return to_middle;
}

}  // namespace

size_t StackLayout::texels() const {
  size_t count = 0;
  for (const StackPage& page : pages)
    count += static_cast<size_t>(extent(page).x) * static_cast<size_t>(extent(page).y);
  return count;
}

std::optional<StackLayout> stack_layout(const glm::ivec3& size, int axis, int limit) {
  StackLayout layout;
  layout.axis = axis;
  layout.slice = {size[(axis + 1) % 3], size[(axis + 2) % 3]};
  layout.slices = size[axis];
  const glm::ivec2 tile = layout.tile();
  if (tile.x > limit || tile.y > limit) return std::nullopt;
  // Three slices at least, side by side along the shorter side of a tile.
  const int least = std::min(layout.slices, 3);
  int columns = tiles_in(std::min(kPageExtent, limit), tile.x), rows = tiles_in(std::min(kPageExtent, limit), tile.y);
  if (columns * rows < least) {
    (tile.x < tile.y ? columns : rows) = least;
    if (columns * tile.x > limit || rows * tile.y > limit) return std::nullopt;
  }
  const int capacity = columns * rows;
  for (int first = 0;;) {
    StackPage page;
    page.first = first;
    page.last = std::min(first + capacity, layout.slices) - 1;
    const int count = page.last - page.first + 1;
    // As square as it goes, so that small stacks waste no texels of a full row.
    const double square = std::sqrt(static_cast<double>(count) * tile.y / tile.x);
    page.columns = std::clamp(static_cast<int>(std::ceil(square)), 1, std::min(columns, count));
    page.columns = std::max(page.columns, (count + rows - 1) / rows);
    page.rows = (count + page.columns - 1) / page.columns;
    layout.pages.push_back(page);
    if (page.last == layout.slices - 1) return layout;
    first = page.last - 1;
  }
}

std::vector<std::byte> page_texels(const StackLayout& layout, const StackPage& page, const glm::ivec3& size,
                                   std::span<const std::byte> texels, size_t texel) {
  const glm::ivec2 extent = layout.extent(page), tile = layout.tile();
  std::vector<std::byte> out(static_cast<size_t>(extent.x) * static_cast<size_t>(extent.y) * texel);
  const size_t stride[3] = {texel, texel * static_cast<size_t>(size.x),
                            texel * static_cast<size_t>(size.x) * static_cast<size_t>(size.y)};
  const size_t across = stride[layout.axis], along_x = stride[(layout.axis + 1) % 3],
               along_y = stride[(layout.axis + 2) % 3];
  for (int slice = page.first; slice <= page.last; ++slice) {
    const int place = slice - page.first;
    const glm::ivec2 corner = glm::ivec2(place % page.columns, place / page.columns) * tile;
    for (int y = 0; y < tile.y; ++y) {
      const int from_y = std::clamp(y - 1, 0, layout.slice.y - 1);
      const std::byte* row =
          texels.data() + static_cast<size_t>(slice) * across + static_cast<size_t>(from_y) * along_y;
      std::byte* to =
          out.data() +
          (static_cast<size_t>(corner.y + y) * static_cast<size_t>(extent.x) + static_cast<size_t>(corner.x)) * texel;
      for (int x = 0; x < tile.x; ++x, to += texel) {
        const int from_x = std::clamp(x - (defect(Defect::ForgottenGutter) ? 0 : 1), 0, layout.slice.x - 1);
        std::memcpy(to, row + static_cast<size_t>(from_x) * along_x, texel);
      }
    }
  }
  return out;
}

glm::dvec3 turned(const glm::dvec3& v, int axis) { return {v[(axis + 1) % 3], v[(axis + 2) % 3], v[axis]}; }

Float4 turned(const Float4& v, int axis) {
  const auto a = static_cast<size_t>(axis);
  return {v[(a + 1) % 3], v[(a + 2) % 3], v[a], v[3]};
}

ViewRays turned(const ViewRays& rays, int axis) {
  ViewRays out = rays;
  for (glm::dvec3 ViewRays::*member :
       {&ViewRays::origin, &ViewRays::origin_x, &ViewRays::origin_y, &ViewRays::direction, &ViewRays::direction_x,
        &ViewRays::direction_y, &ViewRays::eye, &ViewRays::forward}) {
    out.*member = turned(rays.*member, axis);
  }
  return out;
}

VolumeUniforms turned(const VolumeUniforms& uniforms, int axis) {
  VolumeUniforms out = uniforms;
  for (Float4 VolumeUniforms::*member :
       {&VolumeUniforms::ray_origin, &VolumeUniforms::ray_origin_x, &VolumeUniforms::ray_origin_y,
        &VolumeUniforms::ray_direction, &VolumeUniforms::ray_direction_x, &VolumeUniforms::ray_direction_y,
        &VolumeUniforms::extent, &VolumeUniforms::size, &VolumeUniforms::texture_scale, &VolumeUniforms::texture_offset,
        &VolumeUniforms::texel, &VolumeUniforms::gradient_scale, &VolumeUniforms::eye, &VolumeUniforms::forward}) {
    out.*member = turned(uniforms.*member, axis);
  }
  for (Float4& plane : out.clip_planes) plane = turned(plane, axis);
  for (VolumeLight& light : out.lights) light.vector = turned(light.vector, axis);
  return out;
}

int best_stack(const Volume& volume, const ViewRays& rays) {
  const glm::dvec3 score = glm::abs(glm::normalize(main_direction(volume, rays))) / volume.spacing;
  int best = 2;
  for (const int axis : {1, 0})
    if ((score[axis] > score[best] * (1 + 1e-9)) != defect(Defect::WrongStack)) best = axis;
  return best;
}

SliceStacks::SliceStacks(const Scene& scene, const StackSettings& settings, Device& device)
    : device_(device), table_size_(settings.volume.table_size), slots_(settings.slots) {
  // The destructor does not run when a constructor throws: a refused texture must not leak the ones before it.
  try {
    const glm::ivec3 size = scene.volume->size;
    for (int axis = 0; axis < 3; ++axis) {
      const std::optional<StackLayout> layout = stack_layout(size, axis, device.info().limits.texture_2d);
      if (!layout) throw std::runtime_error(fmt::format("slices of {}x{}x{} do not fit", size.x, size.y, size.z));
      Stack& stack = stacks_[static_cast<size_t>(axis)];
      stack.layout = *layout;
      stack.pages.resize(layout->pages.size());
    }
    if (settings.gradient) {
      // First, for its values give way to those of the data.
      const GradientTexels gradients = gradient_texels(scene, *settings.gradient);
      value_origin_ = gradients.value_origin;
      value_scale_ = gradients.value_scale;
      vector_scale_ = gradients.scale;
      vector_offset_ = gradients.offset;
      normals_ = settings.gradient->normals;
      if (settings.data) add_data(scene, settings.volume);
      add_texture("gradients", size, gradients.format, gradients.texels, true);
    } else {
      add_data(scene, settings.volume);
    }
    const std::vector<float> table = transfer_table(scene.transfer, table_size_);
    TextureDesc desc;
    desc.label = "transfer table";
    desc.dimension = 1;
    desc.width = table_size_;
    desc.data = bytes_of(table);
    transfer_ = create(desc);
  } catch (...) {
    release();
    throw;
  }
}

void SliceStacks::add_data(const Scene& scene, const VolumeSettings& settings) {
  const VolumeTexels texels = volume_texels(scene, settings);
  value_origin_ = texels.value_origin;
  value_scale_ = texels.value_scale;
  add_texture("data", scene.volume->size, texels.format, texels.of(*scene.volume), false);
}

void SliceStacks::add_texture(const char* label, const glm::ivec3& size, Format format,
                              std::span<const std::byte> texels, bool vectors) {
  for (int axis = 0; axis < 3; ++axis) {
    Stack& stack = stacks_[static_cast<size_t>(axis)];
    for (size_t i = 0; i < stack.pages.size(); ++i) {
      const StackPage& page = stack.layout.pages[i];
      std::vector<std::byte> data = page_texels(stack.layout, page, size, texels, texel_bytes(format));
      if (vectors) turn_vectors(data, texel_bytes(format), axis);
      TextureDesc desc;
      desc.label = fmt::format("{}, stack {}, slices {} to {}", label, "ijk"[axis], page.first, page.last);
      desc.format = format;
      desc.width = stack.layout.extent(page).x;
      desc.height = stack.layout.extent(page).y;
      desc.data = data;
      stack.pages[i].push_back(create(desc));
    }
  }
}

SliceStacks::~SliceStacks() { release(); }

void SliceStacks::release() {
  for (Stack& stack : stacks_)
    for (const std::vector<Texture>& page : stack.pages)
      for (const Texture texture : page) device_.destroy(texture);
  if (transfer_) device_.destroy(transfer_);
}

Texture SliceStacks::create(const TextureDesc& desc) {
  const Texture texture = device_.create_texture(desc);
  texture_bytes_ += static_cast<size_t>(desc.width) * static_cast<size_t>(desc.height) * texel_bytes(desc.format);
  return texture;
}

std::vector<BindingDecl> SliceStacks::declarations(int textures) {
  std::vector<BindingDecl> slots = {{0, BindingKind::Uniform, 0}, {2, BindingKind::Sampled, 1}};
  for (int i = 0; i < textures; ++i) slots.push_back({static_cast<uint32_t>(4 + i), BindingKind::Sampled, 2});
  return slots;
}

std::vector<Binding> SliceStacks::bindings(int axis, int page, const Binding& uniforms) const {
  std::vector<Binding> slots = {uniforms,
                                bind_sampled(2, transfer_, {Filter::Nearest, Wrap::Clamp})};  // read by texelFetch
  const std::vector<Texture>& textures = stacks_[static_cast<size_t>(axis)].pages[static_cast<size_t>(page)];
  const size_t count = std::max(textures.size(), static_cast<size_t>(slots_));
  for (size_t i = 0; i < count; ++i) {
    const Texture texture = textures[std::min(i, textures.size() - 1)];
    slots.push_back(bind_sampled(static_cast<uint32_t>(4 + i), texture, {Filter::Linear, Wrap::Clamp}));
  }
  return slots;
}

void SliceStacks::fill(VolumeUniforms& uniforms) const {
  uniforms.value = {value_origin_, value_scale_, static_cast<float>(table_size_ - 1), 0};
  uniforms.texel = {vector_scale_, vector_offset_, normals_ ? 1.F : 0.F, 0};
}

std::optional<std::string> stacks_unsupported(const Scene& scene, const VolumeSettings& settings,
                                              const BackendInfo& backend) {
  if (scene.volume) {
    const glm::ivec3 size = scene.volume->size;
    for (int axis = 0; axis < 3; ++axis) {
      if (!stack_layout(size, axis, backend.limits.texture_2d)) {
        return fmt::format("the volume is {}x{}x{}: three slices of stack {} need more than the {} texels a side of {}",
                           size.x, size.y, size.z, "ijk"[axis], backend.limits.texture_2d, backend.id);
      }
    }
  }
  if (settings.table_size > backend.limits.texture_1d) {
    return fmt::format("table_size is {}, 1D textures of {} go to {}", settings.table_size, backend.id,
                       backend.limits.texture_1d);
  }
  if (scene.effects.clip_planes.size() > kMaxClipPlanes) {
    return fmt::format("{} clip planes, at most {} are simulated", scene.effects.clip_planes.size(), kMaxClipPlanes);
  }
  return std::nullopt;
}

}  // namespace volumark
