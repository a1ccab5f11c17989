// The one thing methods draw with. A concrete front that checks every argument once and forwards to a Backend that only
// draws. Every refusal is a DeviceError that names the call and the object's label; a refused call changes nothing.
// Work is recorded in order and has taken place when submit_and_wait returns. Not thread-safe.
#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "backends/types.h"

namespace volumark {

class Backend;  // backends/backend.h

enum class DeviceErrorKind {
  InvalidHandle,      // never created here, or destroyed
  BadArgument,        // a value that no backend accepts
  SizeMismatch,       // bytes or extents that do not agree
  OutOfRange,         // reads or writes past the end of a resource
  MissingCapability,  // this backend cannot do it; the message says why
  LimitExceeded,      // larger than the backend's limits
  WrongState,         // not allowed now (a draw outside a pass, an update inside one)
  OutOfMemory,        // the driver or the host refused the allocation
  CompileFailed,      // the driver refused the program
  DeviceLost,         // the driver failed; the Device is unusable
};
const char* to_string(DeviceErrorKind kind);

class DeviceError : public std::runtime_error {
 public:
  DeviceError(DeviceErrorKind kind, std::string_view call, std::string_view label, std::string_view message);
  DeviceErrorKind kind;
  std::string call, label;
};

class Device {
 public:
  explicit Device(std::unique_ptr<Backend> backend);
  ~Device();
  Device(Device&&) noexcept;
  Device(const Device&) = delete;

  const BackendInfo& info() const;
  bool has(Capability capability) const;

  Buffer create_buffer(const BufferDesc& desc);
  Texture create_texture(const TextureDesc& desc);
  Program create_program(const ProgramDesc& desc);
  Pipeline create_pipeline(const PipelineDesc& desc);
  void destroy(Buffer buffer);
  void destroy(Texture texture);
  void destroy(Program program);
  void destroy(Pipeline pipeline);

  // Takes effect in order with the draws around it. Outside a pass only.
  void update_buffer(Buffer buffer, size_t offset, std::span<const std::byte> data);

  void begin_pass(const PassDesc& desc);
  void draw(const DrawDesc& desc);
  void end_pass();
  void dispatch(const DispatchDesc& desc);

  // After an exception during recording: closes the open pass and zones, so that objects can be destroyed. The target's
  // contents are undefined. Nothing where nothing is open.
  void abandon() noexcept;

  // Zones nest; `name` as in measurement.md: classify, upload, raster, shade.
  void begin_zone(std::string_view name);
  void end_zone();

  // Runs everything recorded to its end; returns the zones of this submission, in the order they began.
  std::vector<ZoneTime> submit_and_wait();

  // Tight rows, row 0 first; submits what is pending. Texels of texel_bytes(format) each.
  std::vector<std::byte> read_texture(Texture texture);
  std::vector<std::byte> read_buffer(Buffer buffer, size_t offset, size_t size);

  const TextureDesc& desc(Texture texture) const;  // `data` is empty
  size_t live_bytes() const;                       // of all buffers and textures alive, as asked for
  size_t peak_bytes() const;
  // Every different program that was made here, destroyed ones included, in the order in which they were made.
  std::span<const ProgramRecord> programs() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span<const T>(values));
}
template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span<const T, 1>(&value, 1));
}

// ---- Making one -----------------------------------------------------------------------------------------------------

struct DeviceOptions {
  std::string gl_platform = "osmesa";  // or "egl"
  std::string vk_device;               // index or part of the name; empty: lavapipe
  bool validation = false;             // Vulkan validation layers; any message fails the next submit_and_wait
  int threads = 0;                     // cpu backend; 0 = all hardware threads
};

// `id`: gl, vulkan, cpu or null. Throws std::invalid_argument for another id, DeviceError where it cannot be had.
Device make_device(std::string_view id, const DeviceOptions& options = {});

// Every backend this build knows: id and one line of description. The one list to add a backend to.
struct BackendEntry {
  const char* id;
  const char* title;
  std::unique_ptr<Backend> (*make)(const DeviceOptions&);
};
std::span<const BackendEntry> backend_list();

}  // namespace volumark
