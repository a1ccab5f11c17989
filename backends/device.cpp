#include "backends/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "backends/backend.h"
#include "backends/slot_table.h"

namespace volumark {

using Kind = DeviceErrorKind;

const char* to_string(DeviceErrorKind kind) {
  constexpr const char* kNames[] = {"invalid handle",     "bad argument",   "size mismatch", "out of range",
                                    "missing capability", "limit exceeded", "wrong state",   "out of memory",
                                    "compile failed",     "device lost"};
  return kNames[static_cast<size_t>(kind)];
}

DeviceError::DeviceError(DeviceErrorKind error_kind, std::string_view error_call, std::string_view error_label,
                         std::string_view message)
    : std::runtime_error(fmt::format("{}('{}'): {}: {}", error_call, error_label, to_string(error_kind), message)),
      kind(error_kind),
      call(error_call),
      label(error_label) {}

namespace {

// The call and the label that every refusal of it names.
struct Call {
  std::string_view name;
  std::string_view label;
  template <class... Args>
  void require(bool holds, Kind kind, fmt::format_string<Args...> format, Args&&... args) const {
    if (!holds) throw DeviceError(kind, name, label, fmt::format(format, std::forward<Args>(args)...));
  }
};

struct BufferSlot {
  std::string label;
  size_t size;
};
struct ProgramSlot {
  ProgramDesc desc;
  bool compute;
};
struct PipelineSlot {
  PipelineDesc desc;
  ProgramDesc program_desc;
};

size_t texture_bytes(const TextureDesc& desc) {
  return static_cast<size_t>(desc.width) * static_cast<size_t>(desc.height) * static_cast<size_t>(desc.depth) *
         texel_bytes(desc.format);
}

constexpr uint32_t kSlots = 16;

}  // namespace

struct Device::State {
  std::unique_ptr<Backend> backend;
  SlotTable<Buffer, BufferSlot> buffers;
  SlotTable<Texture, TextureDesc> textures;
  SlotTable<Program, ProgramSlot> programs;
  SlotTable<Pipeline, PipelineSlot> pipelines;
  std::optional<PassDesc> pass;
  int open_zones = 0;
  size_t live = 0, peak = 0;
  std::vector<ProgramRecord> records;

  void record(const ProgramDesc& desc) {
    const auto same = [&](const ProgramRecord& known) {
      return known.label == desc.label && known.stages == desc.stages && known.constants == desc.constants;
    };
    if (std::ranges::none_of(records, same)) records.push_back({desc.label, desc.stages, desc.constants});
  }
  void count(size_t bytes) {
    live += bytes;
    peak = std::max(peak, live);
  }
  void outside_pass(const Call& call) const {
    call.require(!pass, Kind::WrongState, "not allowed inside pass '{}'", pass ? pass->label : "");
  }
  template <class Table, class H>
  static auto& resolve(Table& table, H handle, const Call& call, std::string_view what) {
    auto* slot = table.find(handle);
    call.require(slot != nullptr, Kind::InvalidHandle, "the {} handle ({}, generation {}) does not exist{}", what,
                 handle.index, handle.generation, handle ? " any more" : " (it is empty)");
    return *slot;
  }
  std::vector<BoundResource> resolve_bindings(const Call& call, const ProgramDesc& program,
                                              std::span<const Binding> bindings);
  BoundResource resolve_binding(const Call& call, const ProgramDesc& program, const BindingDecl& decl,
                                const Binding& binding);
  void check_program(const Call& call, const ProgramDesc& desc) const;
  void check_pipeline(const Call& call, const PipelineDesc& desc, const ProgramDesc& program) const;
  bool has(Capability capability) const {
    return std::ranges::find(backend->info().capabilities, capability) != backend->info().capabilities.end();
  }
  void require_capability(const Call& call, Capability capability) const {
    if (has(capability)) return;
    std::string reason = "not stated";
    for (const auto& [absent, why] : backend->info().absent) {
      if (absent == capability) reason = why;
    }
    throw DeviceError(Kind::MissingCapability, call.name, call.label,
                      fmt::format("backend {} has no {}: {}", backend->info().id, to_string(capability), reason));
  }
};

Device::Device(std::unique_ptr<Backend> backend) : state_(std::make_unique<State>()) {
  state_->backend = std::move(backend);
}
Device::~Device() = default;
Device::Device(Device&&) noexcept = default;

const BackendInfo& Device::info() const { return state_->backend->info(); }
bool Device::has(Capability capability) const { return state_->has(capability); }
size_t Device::live_bytes() const { return state_->live; }
size_t Device::peak_bytes() const { return state_->peak; }
std::span<const ProgramRecord> Device::programs() const { return state_->records; }

// ---- Objects --------------------------------------------------------------------------------------------------------

Buffer Device::create_buffer(const BufferDesc& desc) {
  const Call call{"create_buffer", desc.label};
  call.require(desc.size > 0, Kind::BadArgument, "size is 0");
  call.require(desc.data.empty() || desc.data.size() == desc.size, Kind::SizeMismatch,
               "size is {} bytes, but {} bytes of data are given", desc.size, desc.data.size());
  return state_->buffers.insert({desc.label, desc.size}, [&](uint32_t id) {
    state_->backend->create_buffer(id, desc);
    state_->count(desc.size);
  });
}

namespace {

void check_extent(const Call& call, const TextureDesc& desc, const Limits& limits) {
  call.require(desc.dimension >= 1 && desc.dimension <= 3, Kind::BadArgument, "dimension {} is not 1, 2 or 3",
               desc.dimension);
  const int extents[3] = {desc.width, desc.height, desc.depth};
  const int largest[3] = {limits.texture_1d, limits.texture_2d, limits.texture_3d};
  for (int axis = 0; axis < 3; ++axis) {
    const int extent = extents[axis];
    call.require(extent >= 1, Kind::BadArgument, "extent {} along axis {} is not positive", extent, axis);
    call.require(axis < desc.dimension || extent == 1, Kind::BadArgument, "a {}D texture has extent {} along axis {}",
                 desc.dimension, extent, axis);
    call.require(extent <= largest[desc.dimension - 1], Kind::LimitExceeded,
                 "extent {} along axis {} exceeds this backend's {} for {}D textures", extent, axis,
                 largest[desc.dimension - 1], desc.dimension);
  }
}

}  // namespace

Texture Device::create_texture(const TextureDesc& desc) {
  const Call call{"create_texture", desc.label};
  check_extent(call, desc, info().limits);
  call.require(!(desc.target && desc.dimension != 2), Kind::BadArgument, "only 2D textures are targets");
  call.require(!is_depth_stencil(desc.format) || (desc.target && desc.data.empty() && !desc.storage), Kind::BadArgument,
               "a depth/stencil texture is a target, without data and storage");
  call.require(desc.data.empty() || desc.data.size() == texture_bytes(desc), Kind::SizeMismatch,
               "{}x{}x{} {} takes {} bytes, but {} bytes of data are given", desc.width, desc.height, desc.depth,
               to_string(desc.format), texture_bytes(desc), desc.data.size());
  if (desc.storage) {
    state_->require_capability(call, Capability::StorageImages);
    call.require(desc.format == Format::R32F || desc.format == Format::RGBA16F || desc.format == Format::RGBA32F,
                 Kind::BadArgument, "{} is not a storage format (r32f, rgba16f, rgba32f)", to_string(desc.format));
  }
  TextureDesc kept = desc;
  kept.data = {};
  return state_->textures.insert(std::move(kept), [&](uint32_t id) {
    state_->backend->create_texture(id, desc);
    state_->count(texture_bytes(desc));
  });
}

void Device::State::check_program(const Call& call, const ProgramDesc& desc) const {
  int stages[4] = {};
  for (const ShaderText* text : desc.stages) {
    call.require(text != nullptr, Kind::BadArgument, "a stage is null");
    ++stages[static_cast<size_t>(text->stage)];
  }
  const bool compute = stages[3] == 1 && desc.stages.size() == 1;
  const bool raster = stages[0] == 1 && stages[2] == 1 && stages[1] <= 1 && stages[3] == 0;
  call.require(
      compute || raster, Kind::BadArgument,
      "a program is vertex + fragment [+ geometry], or one compute stage; given are {} vertex, {} geometry, {} "
      "fragment, {} compute",
      stages[0], stages[1], stages[2], stages[3]);
  if (compute) require_capability(call, Capability::Compute);
  if (stages[1]) require_capability(call, Capability::GeometryStage);
  uint32_t used = 0;
  for (const BindingDecl& decl : desc.bindings) {
    call.require(decl.slot < kSlots, Kind::OutOfRange, "binding {} is not below {}", decl.slot, kSlots);
    call.require(!(used >> decl.slot & 1u), Kind::BadArgument, "binding {} is declared twice", decl.slot);
    const bool texture = decl.kind == BindingKind::Sampled || decl.kind == BindingKind::Image;
    call.require(!texture || (decl.dimension >= 1 && decl.dimension <= 3), Kind::BadArgument,
                 "binding {}: texture dimension {} is not 1, 2 or 3", decl.slot, decl.dimension);
    used |= 1u << decl.slot;
  }
}

Program Device::create_program(const ProgramDesc& desc) {
  const Call call{"create_program", desc.label};
  state_->check_program(call, desc);
  const bool compute = desc.stages.front()->stage == Stage::Compute;
  return state_->programs.insert({desc, compute}, [&](uint32_t id) {
    state_->backend->create_program(id, desc);
    state_->record(desc);
  });
}

void Device::State::check_pipeline(const Call& call, const PipelineDesc& desc, const ProgramDesc& program) const {
  call.require(program.stages.front()->stage != Stage::Compute, Kind::BadArgument, "program '{}' is a compute program",
               program.label);
  call.require(!is_depth_stencil(desc.colour_format), Kind::BadArgument, "{} is not a colour format",
               to_string(desc.colour_format));
  call.require(desc.has_depth_stencil || !(desc.depth_test || desc.depth_write || desc.stencil_test), Kind::BadArgument,
               "depth or stencil is used, but has_depth_stencil is false");
  call.require(desc.vertex_layouts.size() <= 4, Kind::LimitExceeded, "{} vertex layouts, at most 4",
               desc.vertex_layouts.size());
  uint32_t used = 0;
  for (const VertexLayout& layout : desc.vertex_layouts) {
    for (const VertexAttribute& attribute : layout.attributes) {
      call.require(attribute.location < 8, Kind::OutOfRange, "attribute location {} is not below 8",
                   attribute.location);
      call.require(!(used >> attribute.location & 1u), Kind::BadArgument, "attribute location {} is given twice",
                   attribute.location);
      used |= 1u << attribute.location;
      call.require(attribute.components >= 1 && attribute.components <= 4, Kind::BadArgument,
                   "attribute {} has {} components", attribute.location, attribute.components);
      const size_t end = attribute.offset + 4 * static_cast<size_t>(attribute.components);
      call.require(attribute.offset % 4 == 0 && layout.stride % 4 == 0 && end <= layout.stride, Kind::OutOfRange,
                   "attribute {} ends at byte {} of a vertex of {} bytes (offsets and strides are multiples of 4)",
                   attribute.location, end, layout.stride);
    }
  }
}

Pipeline Device::create_pipeline(const PipelineDesc& desc) {
  const Call call{"create_pipeline", desc.label};
  const ProgramSlot& program = State::resolve(state_->programs, desc.program, call, "program");
  state_->check_pipeline(call, desc, program.desc);
  return state_->pipelines.insert({desc, program.desc}, [&](uint32_t id) {
    state_->backend->create_pipeline(id, desc.program.index, desc, program.desc);
  });
}

void Device::destroy(Buffer buffer) {
  const Call call{"destroy", "buffer"};
  state_->outside_pass(call);
  state_->live -= State::resolve(state_->buffers, buffer, call, "buffer").size;
  state_->backend->destroy_buffer(buffer.index);
  state_->buffers.erase(buffer);
}
void Device::destroy(Texture texture) {
  const Call call{"destroy", "texture"};
  state_->outside_pass(call);
  state_->live -= texture_bytes(State::resolve(state_->textures, texture, call, "texture"));
  state_->backend->destroy_texture(texture.index);
  state_->textures.erase(texture);
}
void Device::destroy(Program program) {
  const Call call{"destroy", "program"};
  state_->outside_pass(call);
  State::resolve(state_->programs, program, call, "program");
  for (const PipelineSlot* user : state_->pipelines.all()) {
    call.require(user->desc.program != program, Kind::WrongState, "pipeline '{}' still uses it", user->desc.label);
  }
  state_->backend->destroy_program(program.index);
  state_->programs.erase(program);
}
void Device::destroy(Pipeline pipeline) {
  const Call call{"destroy", "pipeline"};
  state_->outside_pass(call);
  State::resolve(state_->pipelines, pipeline, call, "pipeline");
  state_->backend->destroy_pipeline(pipeline.index);
  state_->pipelines.erase(pipeline);
}

const TextureDesc& Device::desc(Texture texture) const {
  return State::resolve(state_->textures, texture, {"desc", "texture"}, "texture");
}

void Device::update_buffer(Buffer buffer, size_t offset, std::span<const std::byte> data) {
  const BufferSlot& slot = State::resolve(state_->buffers, buffer, {"update_buffer", ""}, "buffer");
  const Call call{"update_buffer", slot.label};
  state_->outside_pass(call);
  call.require(offset <= slot.size && data.size() <= slot.size - offset, Kind::OutOfRange,
               "bytes {} to {} of a buffer of {}", offset, offset + data.size(), slot.size);
  if (!data.empty()) state_->backend->update_buffer(buffer.index, offset, data);
}

// ---- Work -----------------------------------------------------------------------------------------------------------

void Device::begin_pass(const PassDesc& desc) {
  const Call call{"begin_pass", desc.label};
  state_->outside_pass(call);
  const TextureDesc& colour = State::resolve(state_->textures, desc.colour, call, "colour texture");
  call.require(colour.target && !is_depth_stencil(colour.format), Kind::BadArgument,
               "texture '{}' was not made as a colour target", colour.label);
  ResolvedPass pass{desc.colour.index, false, 0, colour.width, colour.height, nullptr};
  if (desc.depth_stencil) {
    const TextureDesc& depth = State::resolve(state_->textures, desc.depth_stencil, call, "depth/stencil texture");
    call.require(is_depth_stencil(depth.format), Kind::BadArgument, "texture '{}' is {}, not a depth/stencil format",
                 depth.label, to_string(depth.format));
    call.require(depth.width == colour.width && depth.height == colour.height, Kind::SizeMismatch,
                 "colour is {}x{}, depth/stencil {}x{}", colour.width, colour.height, depth.width, depth.height);
    pass.has_depth_stencil = true;
    pass.depth_stencil = desc.depth_stencil.index;
  }
  call.require(desc.depth_value >= 0 && desc.depth_value <= 1, Kind::BadArgument, "depth clear value {} not in [0, 1]",
               desc.depth_value);
  state_->pass = desc;
  pass.desc = &*state_->pass;
  try {
    state_->backend->begin_pass(pass);
  } catch (...) {
    state_->pass.reset();
    throw;
  }
}

BoundResource Device::State::resolve_binding(const Call& call, const ProgramDesc& program, const BindingDecl& decl,
                                             const Binding& binding) {
  call.require(binding.kind == decl.kind, Kind::BadArgument, "binding {}: program '{}' declares another kind",
               decl.slot, program.label);
  BoundResource out{decl.slot, decl.kind, 0, 0, 0, binding.sampler};
  if (decl.kind == BindingKind::Uniform || decl.kind == BindingKind::Storage) {
    const BufferSlot& buffer = resolve(buffers, binding.buffer, call, "bound buffer");
    call.require(binding.offset % 256 == 0 && binding.offset < buffer.size, Kind::OutOfRange,
                 "binding {}: offset {} into '{}' of {} bytes (a multiple of 256 is wanted)", decl.slot, binding.offset,
                 buffer.label, buffer.size);
    out.object = binding.buffer.index;
    out.offset = binding.offset;
    out.size = binding.size ? binding.size : buffer.size - binding.offset;
    call.require(out.size <= buffer.size - binding.offset, Kind::OutOfRange,
                 "binding {}: {} bytes at {} of '{}', which has {}", decl.slot, out.size, binding.offset, buffer.label,
                 buffer.size);
    call.require(out.size <= backend->info().limits.storage_buffer_bytes, Kind::LimitExceeded,
                 "binding {}: {} bytes exceed this backend's {}", decl.slot, out.size,
                 backend->info().limits.storage_buffer_bytes);
    return out;
  }
  const TextureDesc& texture = resolve(textures, binding.texture, call, "bound texture");
  call.require(texture.dimension == decl.dimension, Kind::BadArgument, "binding {}: '{}' is {}D, the program wants {}D",
               decl.slot, texture.label, texture.dimension, decl.dimension);
  call.require(!is_depth_stencil(texture.format), Kind::BadArgument, "binding {}: '{}' is a depth/stencil texture",
               decl.slot, texture.label);
  call.require(decl.kind == BindingKind::Sampled || texture.storage, Kind::BadArgument,
               "binding {}: '{}' was not made with storage", decl.slot, texture.label);
  call.require(!pass || pass->colour != binding.texture, Kind::WrongState,
               "binding {}: '{}' is the target of this pass", decl.slot, texture.label);
  out.object = binding.texture.index;
  return out;
}

std::vector<BoundResource> Device::State::resolve_bindings(const Call& call, const ProgramDesc& program,
                                                           std::span<const Binding> bindings) {
  call.require(bindings.size() == program.bindings.size(), Kind::BadArgument,
               "{} bindings are given, program '{}' declares {}", bindings.size(), program.label,
               program.bindings.size());
  std::vector<BoundResource> out;
  out.reserve(bindings.size());
  for (const BindingDecl& decl : program.bindings) {
    const auto binding =
        std::ranges::find_if(bindings, [&](const Binding& candidate) { return candidate.slot == decl.slot; });
    call.require(binding != bindings.end(), Kind::BadArgument, "binding {} of program '{}' is missing", decl.slot,
                 program.label);
    out.push_back(resolve_binding(call, program, decl, *binding));
  }
  std::ranges::sort(out, {}, &BoundResource::slot);
  return out;
}

namespace {

// The vertex attributes of a draw must lie inside their buffers; indices are the caller's to keep in range.
void check_vertices(const Call& call, const PipelineDesc& pipeline, const DrawDesc& desc, size_t layout,
                    const BufferSlot& buffer) {
  const VertexLayout& vertex = pipeline.vertex_layouts[layout];
  const size_t last = vertex.per_instance ? desc.instances : size_t{desc.first} + desc.count;
  if (desc.index_buffer && !vertex.per_instance) return;
  call.require(last * vertex.stride <= buffer.size, Kind::OutOfRange,
               "vertex buffer '{}' has {} bytes, the draw reads {} x {}", buffer.label, buffer.size, last,
               vertex.stride);
}

}  // namespace

void Device::draw(const DrawDesc& desc) {
  const PipelineSlot& pipeline = State::resolve(state_->pipelines, desc.pipeline, {"draw", "pipeline"}, "pipeline");
  const Call call{"draw", pipeline.desc.label};
  call.require(state_->pass.has_value(), Kind::WrongState, "outside a pass");
  const TextureDesc& colour = State::resolve(state_->textures, state_->pass->colour, call, "target");
  call.require(colour.format == pipeline.desc.colour_format, Kind::BadArgument,
               "the pipeline writes {}, the target '{}' is {}", to_string(pipeline.desc.colour_format), colour.label,
               to_string(colour.format));
  call.require(static_cast<bool>(state_->pass->depth_stencil) == pipeline.desc.has_depth_stencil, Kind::BadArgument,
               "the pipeline {} a depth/stencil attachment, the pass {} one",
               pipeline.desc.has_depth_stencil ? "wants" : "has not", state_->pass->depth_stencil ? "has" : "has not");
  call.require(desc.vertex_buffers.size() == pipeline.desc.vertex_layouts.size(), Kind::BadArgument,
               "{} vertex buffers are given, the pipeline has {} layouts", desc.vertex_buffers.size(),
               pipeline.desc.vertex_layouts.size());
  ResolvedDraw draw;
  draw.pipeline = desc.pipeline.index;
  for (size_t i = 0; i < desc.vertex_buffers.size(); ++i) {
    const BufferSlot& buffer = State::resolve(state_->buffers, desc.vertex_buffers[i], call, "vertex buffer");
    check_vertices(call, pipeline.desc, desc, i, buffer);
    draw.vertex_buffers.push_back(desc.vertex_buffers[i].index);
  }
  if (desc.index_buffer) {
    const BufferSlot& buffer = State::resolve(state_->buffers, desc.index_buffer, call, "index buffer");
    call.require((size_t{desc.first} + desc.count) * 4 <= buffer.size, Kind::OutOfRange,
                 "index buffer '{}' has {} bytes, the draw reads indices {} to {}", buffer.label, buffer.size,
                 desc.first, size_t{desc.first} + desc.count);
    draw.indexed = true;
    draw.index_buffer = desc.index_buffer.index;
  }
  draw.bindings = state_->resolve_bindings(call, pipeline.program_desc, desc.bindings);
  draw.first = desc.first;
  draw.count = desc.count;
  draw.instances = desc.instances;
  if (desc.count > 0 && desc.instances > 0) state_->backend->draw(draw);
}

void Device::end_pass() {
  const Call call{"end_pass", ""};
  call.require(state_->pass.has_value(), Kind::WrongState, "no pass is open");
  // The backend may still read the pass's description; it is closed even where the backend throws.
  struct Close {
    std::optional<PassDesc>& pass;
    ~Close() { pass.reset(); }
  } close{state_->pass};
  state_->backend->end_pass();
}

void Device::abandon() noexcept {
  try {
    if (state_->pass) end_pass();
    while (state_->open_zones > 0) end_zone();
    state_->backend->submit_and_wait();
  } catch (const std::exception&) {  // what was thrown first is what the caller reports
  }
  state_->pass.reset();
  state_->open_zones = 0;
}

void Device::dispatch(const DispatchDesc& desc) {
  const ProgramSlot& program = State::resolve(state_->programs, desc.program, {"dispatch", "program"}, "program");
  const Call call{"dispatch", program.desc.label};
  state_->outside_pass(call);
  call.require(program.compute, Kind::BadArgument, "not a compute program");
  for (const uint32_t groups : desc.groups) {
    call.require(groups <= 65535, Kind::LimitExceeded, "{} groups along an axis, at most 65535", groups);
  }
  const auto bindings = state_->resolve_bindings(call, program.desc, desc.bindings);
  if (desc.groups[0] && desc.groups[1] && desc.groups[2]) {
    state_->backend->dispatch(desc.program.index, bindings, desc.groups);
  }
}

void Device::begin_zone(std::string_view name) {
  const Call call{"begin_zone", name};
  call.require(!name.empty(), Kind::BadArgument, "a zone needs a name");
  state_->outside_pass(call);
  ++state_->open_zones;
  state_->backend->begin_zone(std::string(name));
}

void Device::end_zone() {
  const Call call{"end_zone", ""};
  call.require(state_->open_zones > 0, Kind::WrongState, "no zone is open");
  state_->outside_pass(call);
  --state_->open_zones;
  state_->backend->end_zone();
}

std::vector<ZoneTime> Device::submit_and_wait() {
  const Call call{"submit_and_wait", ""};
  state_->outside_pass(call);
  call.require(state_->open_zones == 0, Kind::WrongState, "{} zones are open", state_->open_zones);
  return state_->backend->submit_and_wait();
}

std::vector<std::byte> Device::read_texture(Texture texture) {
  const TextureDesc& desc = State::resolve(state_->textures, texture, {"read_texture", "texture"}, "texture");
  state_->outside_pass({"read_texture", desc.label});
  std::vector<std::byte> out(texture_bytes(desc));
  state_->backend->read_texture(texture.index, out);
  return out;
}

std::vector<std::byte> Device::read_buffer(Buffer buffer, size_t offset, size_t size) {
  const BufferSlot& slot = State::resolve(state_->buffers, buffer, {"read_buffer", "buffer"}, "buffer");
  const Call call{"read_buffer", slot.label};
  state_->outside_pass(call);
  call.require(offset <= slot.size && size <= slot.size - offset, Kind::OutOfRange, "bytes {} to {} of a buffer of {}",
               offset, offset + size, slot.size);
  std::vector<std::byte> out(size);
  if (size > 0) state_->backend->read_buffer(buffer.index, offset, out);
  return out;
}

}  // namespace volumark
