#include "backends/gl/gl_info.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <thread>

namespace volumark {

namespace {

struct Workaround {
  const char *name, *value;
};
constexpr Workaround kWorkarounds[] = {
    // Without it llvmpipe filters R8 and RGBA8 textures in 8-bit integers, off by up to 1/255.
    {"GALLIVM_PERF", "no_aos_sampling"},
    // A warm disk cache makes the same command measure differently the second time.
    {"MESA_SHADER_CACHE_DISABLE", "true"},
};

std::string text(const GlFunctions& gl, GLenum name) {
  const GLubyte* value = gl.GetString(name);
  return value ? reinterpret_cast<const char*>(value) : "";
}

GLint integer(const GlFunctions& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

bool contains(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

// "llvmpipe (LLVM 15.0.6, 512 bits)"
void parse_renderer(const std::string& renderer, BackendInfo& info) {
  if (const size_t at = renderer.find("LLVM "); at != renderer.npos) {
    const size_t begin = at + 5;
    info.llvm = renderer.substr(begin, renderer.find_first_of(",)", begin) - begin);
  }
  if (const size_t end = renderer.find(" bits"); end != renderer.npos) {
    const size_t begin = renderer.find_last_not_of("0123456789", end - 1) + 1;
    std::from_chars(renderer.data() + begin, renderer.data() + end, info.simd_bits);
  }
}

// "4.5 (Core Profile) Mesa 22.3.6" -> "Mesa 22.3.6"; "4.5.0 NVIDIA 535.86" -> "NVIDIA 535.86".
std::string parse_driver(const std::string& version) {
  for (const char* maker : {"Mesa", "NVIDIA"}) {
    if (const size_t at = version.find(maker); at != version.npos) return version.substr(at);
  }
  const size_t blank = version.find(' ');
  return blank == version.npos ? "" : version.substr(blank + 1);
}

int llvmpipe_threads() {
  int threads = static_cast<int>(std::thread::hardware_concurrency());
  if (const char* set = std::getenv("LP_NUM_THREADS")) threads = std::atoi(set);
  return std::max(threads, 1);  // 0: it rasterises in the thread that calls
}

Limits query_limits(const GlFunctions& gl) {
  Limits limits;
  GLint viewport[2] = {0, 0};
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  limits.texture_1d = integer(gl, GL_MAX_TEXTURE_SIZE);
  // A 2D texture may be a target.
  limits.texture_2d = std::min({limits.texture_1d, viewport[0], viewport[1]});
  limits.texture_3d = integer(gl, GL_MAX_3D_TEXTURE_SIZE);
  GLint64 bytes = 0;
  gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  limits.storage_buffer_bytes = static_cast<size_t>(std::max<GLint64>(bytes, 0));
  return limits;
}

// Why it is absent; nothing where it is there.
std::optional<std::string> why_absent(const GlFunctions& gl, Capability capability, bool software) {
  switch (capability) {
    case Capability::GeometryStage:
      if (integer(gl, GL_MAX_GEOMETRY_OUTPUT_VERTICES) > 0) return std::nullopt;
      return "the driver runs no geometry programs";
    case Capability::Compute:
      if (integer(gl, GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS) > 0) return std::nullopt;
      return "the driver runs no compute programs";
    case Capability::StorageImages:
      if (integer(gl, GL_MAX_COMPUTE_IMAGE_UNIFORMS) > 0) return std::nullopt;
      return "the driver stores to no images in compute programs";
    case Capability::GpuTimers: {
      if (software) return "a software renderer's GL timers are unusable; zones use the wall clock around glFinish";
      GLint bits = 0;
      gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
      if (bits > 0) return std::nullopt;
      return "the driver's timestamp counter has no bits";
    }
    case Capability::Float64:
      return std::nullopt;  // core since OpenGL 4.0
  }
  return "unknown to the gl backend";
}

}  // namespace

void set_driver_environment() {
  for (const Workaround& workaround : kWorkarounds) setenv(workaround.name, workaround.value, 0);
}

BackendInfo query_gl_info(const GlFunctions& gl, const GlContext& context) {
  BackendInfo info;
  info.id = "gl";
  info.api = std::string("OpenGL 4.5 core (") + context.platform() + ")";
  info.vendor = text(gl, GL_VENDOR);
  info.renderer = text(gl, GL_RENDERER);
  info.version = text(gl, GL_VERSION);
  info.driver = parse_driver(info.version);
  parse_renderer(info.renderer, info);
  const bool llvmpipe = contains(info.renderer, "llvmpipe");
  info.software = llvmpipe || contains(info.renderer, "softpipe") || contains(info.renderer, "swrast") ||
                  contains(info.renderer, "Software Rasterizer");
  if (info.software) info.threads = llvmpipe ? llvmpipe_threads() : 1;
  info.limits = query_limits(gl);
  for (const Capability capability : kAllCapabilities) {
    if (auto reason = why_absent(gl, capability, info.software)) {
      info.absent.emplace_back(capability, std::move(*reason));
    } else {
      info.capabilities.push_back(capability);
    }
  }
  for (const Workaround& workaround : kWorkarounds) {
    const char* value = std::getenv(workaround.name);
    const bool on = value && contains(value, workaround.value);
    if (on && contains(info.driver, "Mesa")) info.workarounds.push_back(std::string(workaround.name) + "=" + value);
  }
  return info;
}

}  // namespace volumark
