// Plain value types of the Device: handles, formats and descriptors. No graphics header is included here.
// Conventions, the same on every backend: NDC +y is up and row 0 of every image is the top row; depth 0..1; pixel
// centres at +0.5; counter-clockwise (as seen) triangles are front faces; colours are premultiplied linear RGB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace volumark {

// An index with a generation; a zero-initialised handle is invalid. Handles of a Device are valid in that Device only.
template <class Tag>
struct Handle {
  uint32_t index = 0;
  uint32_t generation = 0;
  explicit operator bool() const { return generation != 0; }
  friend bool operator==(Handle, Handle) = default;
};
using Buffer = Handle<struct BufferTag>;
using Texture = Handle<struct TextureTag>;
using Program = Handle<struct ProgramTag>;
using Pipeline = Handle<struct PipelineTag>;

enum class Format : uint8_t { R8, R16, R16F, R32F, RG8, RGBA8, RGBA16F, RGBA32F, D32FS8 };

// Bytes of one texel as uploaded and read back (D32FS8: 8, float depth then stencil in the low byte of a uint32).
size_t texel_bytes(Format format);
int channel_count(Format format);
const char* to_string(Format format);
bool is_depth_stencil(Format format);

enum class Filter : uint8_t { Nearest, Linear };
enum class Wrap : uint8_t { Clamp, Border, Repeat };  // Border: transparent black (0, 0, 0, 0)
struct Sampler {
  Filter filter = Filter::Linear;
  Wrap wrap = Wrap::Clamp;  // on every axis
  friend bool operator==(const Sampler&, const Sampler&) = default;
};

struct BufferDesc {
  std::string label;
  size_t size = 0;                  // bytes, > 0
  std::span<const std::byte> data;  // empty (contents are then zero), or exactly `size` bytes
};

struct TextureDesc {
  std::string label;
  int dimension = 2;  // 1, 2 or 3
  Format format = Format::RGBA32F;
  int width = 1, height = 1, depth = 1;  // height = depth = 1 in 1D, depth = 1 in 2D
  bool target = false;                   // colour or depth/stencil attachment of a pass (2D only)
  bool storage = false;                  // image store in compute (R32F, RGBA16F, RGBA32F)
  std::span<const std::byte> data;       // empty (contents are then zero), or width*height*depth*texel_bytes, tight,
                                         // x fastest, then y, then z
};

// ---- Programs -------------------------------------------------------------------------------------------------------

enum class Stage : uint8_t { Vertex, Geometry, Fragment, Compute };

// One stage as cmake/programs.cmake embeds it: GLSL 4.50 text (with the common header) and its SPIR-V.
struct ShaderText {
  const char* name = nullptr;
  Stage stage = Stage::Vertex;
  const char* glsl = nullptr;
  std::span<const uint32_t> spirv;
};

enum class BindingKind : uint8_t { Uniform, Storage, Sampled, Image };
struct BindingDecl {
  uint32_t slot = 0;  // layout(binding = slot); unique in a program across all kinds, 0..15
  BindingKind kind = BindingKind::Uniform;
  int dimension = 0;  // of the texture, for Sampled and Image
};

// An effect or variant switch, fixed when the program is made: VM_SPEC(id, name, default) in the GLSL, a value seen by
// CpuProgram::specialise in the twin. `id` counts from 0 without gaps in a program.
struct SpecConstant {
  std::string name;
  int32_t value = 0;
  friend bool operator==(const SpecConstant&, const SpecConstant&) = default;
};

struct CpuProgram;  // backends/cpu/cpu_program.h

struct ProgramDesc {
  std::string label;
  std::vector<const ShaderText*> stages;  // vertex + fragment [+ geometry], or compute alone
  std::vector<BindingDecl> bindings;
  std::vector<SpecConstant> constants;
  const CpuProgram* cpu = nullptr;  // the twin; null: the cpu backend refuses the program
};

// What is known of a program that was made: enough to say what it costs. Stages are those of the description, embedded
// in the program: they live as long as the process.
struct ProgramRecord {
  std::string label;
  std::vector<const ShaderText*> stages;
  std::vector<SpecConstant> constants;
};

// ---- Pipelines ------------------------------------------------------------------------------------------------------

enum class Topology : uint8_t { Points, Lines, Triangles, TriangleStrip };
// Over: back to front, premultiplied: C = S + (1 - Sa) D. Under: front to back: C = D + (1 - Da) S. Add: C = D + S.
enum class Blend : uint8_t { Opaque, Over, Under, Add };
enum class Compare : uint8_t { Never, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always };
enum class StencilOp : uint8_t {
  Keep,
  Zero,
  Replace,
  IncrementClamp,
  DecrementClamp,
  Invert,
  IncrementWrap,
  DecrementWrap
};
enum class Cull : uint8_t { None, Front, Back };

struct StencilFace {
  Compare compare = Compare::Always;
  StencilOp fail = StencilOp::Keep, depth_fail = StencilOp::Keep, pass = StencilOp::Keep;
};

struct VertexAttribute {
  uint32_t location = 0;
  int components = 4;   // 1..4 floats
  uint32_t offset = 0;  // bytes from the start of the vertex
};
struct VertexLayout {
  uint32_t stride = 0;
  bool per_instance = false;
  std::vector<VertexAttribute> attributes;
};

struct PipelineDesc {
  std::string label;
  Program program;
  std::vector<VertexLayout> vertex_layouts;  // one a vertex buffer, at most 4
  Topology topology = Topology::Triangles;
  Blend blend = Blend::Opaque;
  bool colour_write = true;
  Format colour_format = Format::RGBA32F;
  bool has_depth_stencil = false;  // the pass has a D32FS8 attachment
  bool depth_test = false;
  bool depth_write = false;
  Compare depth_compare = Compare::Less;
  bool stencil_test = false;
  StencilFace stencil_front, stencil_back;
  uint8_t stencil_read_mask = 0xff, stencil_write_mask = 0xff, stencil_reference = 0;
  Cull cull = Cull::None;
};

// ---- Work -----------------------------------------------------------------------------------------------------------

struct PassDesc {
  std::string label;
  Texture colour;         // required
  Texture depth_stencil;  // optional
  bool clear_colour = true;
  std::array<float, 4> colour_value{0, 0, 0, 0};
  bool clear_depth_stencil = true;
  float depth_value = 1;
  uint8_t stencil_value = 0;
};

struct Binding {
  uint32_t slot = 0;
  BindingKind kind = BindingKind::Uniform;
  Buffer buffer;
  size_t offset = 0, size = 0;  // bytes of the buffer; offset a multiple of 256, size 0 = the rest
  Texture texture;
  Sampler sampler;
};
inline Binding bind_uniform(uint32_t slot, Buffer buffer, size_t offset = 0, size_t size = 0) {
  return {slot, BindingKind::Uniform, buffer, offset, size, {}, {}};
}
inline Binding bind_storage(uint32_t slot, Buffer buffer, size_t offset = 0, size_t size = 0) {
  return {slot, BindingKind::Storage, buffer, offset, size, {}, {}};
}
inline Binding bind_sampled(uint32_t slot, Texture texture, Sampler sampler = {}) {
  return {slot, BindingKind::Sampled, {}, 0, 0, texture, sampler};
}
inline Binding bind_image(uint32_t slot, Texture texture) { return {slot, BindingKind::Image, {}, 0, 0, texture, {}}; }

struct DrawDesc {
  Pipeline pipeline;
  std::vector<Buffer> vertex_buffers;  // one a vertex layout
  Buffer index_buffer;                 // uint32 indices; invalid handle = not indexed
  std::vector<Binding> bindings;       // exactly the program's declared slots
  uint32_t first = 0;                  // first vertex, or first index
  uint32_t count = 0;                  // vertices or indices; 0 draws nothing
  uint32_t instances = 1;
};

struct DispatchDesc {
  Program program;
  std::vector<Binding> bindings;
  std::array<uint32_t, 3> groups{1, 1, 1};
};

// ---- What a backend is ----------------------------------------------------------------------------------------------

enum class Capability : uint8_t { GeometryStage, Compute, StorageImages, GpuTimers, Float64 };
inline constexpr std::array kAllCapabilities = {Capability::GeometryStage, Capability::Compute,
                                                Capability::StorageImages, Capability::GpuTimers, Capability::Float64};
const char* to_string(Capability capability);

struct Limits {
  int texture_1d = 0, texture_2d = 0, texture_3d = 0;  // largest extent
  size_t storage_buffer_bytes = 0;
};

// What is recorded with every result: strings as the driver gives them.
struct BackendInfo {
  std::string id;   // gl, vulkan, cpu, null
  std::string api;  // "OpenGL 4.5 core (OSMesa)", "Vulkan 1.3", ...
  std::string vendor, renderer, version, driver, llvm;
  int simd_bits = 0;
  int threads = 0;
  bool software = true;
  Limits limits;
  std::vector<Capability> capabilities;
  // Capability -> reason for those that are absent ("geometry stage: the cpu twin has no geometry program").
  std::vector<std::pair<Capability, std::string>> absent;
  std::vector<std::string> workarounds;  // named driver workarounds that are on
};

struct ZoneTime {
  std::string name;
  double seconds = 0;  // wall time between begin and end, as far as the backend can attribute it
};

}  // namespace volumark
