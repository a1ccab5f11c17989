#include "backends/gl/gl_error.h"

#include <fstream>

namespace volumark {

const char* gl_error_name(GLenum error) {
  switch (error) {
    case GL_NO_ERROR:
      return "GL_NO_ERROR";
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
      return "GL_CONTEXT_LOST";
    default:
      return "an unknown GL error";
  }
}

GLenum GlErrors::take() {
  const GLenum first = gl_.GetError();
  // A driver keeps one flag a kind of error; a lost context returns its error for ever.
  for (int i = 0; i < 8 && gl_.GetError() != GL_NO_ERROR; ++i) {
  }
  return first;
}

void GlErrors::keep_pending() {
  const GLenum error = take();
  if (pending_ == GL_NO_ERROR) pending_ = error;
}

void GlErrors::throw_pending(std::string_view call, std::string_view label) {
  keep_pending();
  if (pending_ == GL_NO_ERROR) return;
  const GLenum error = pending_;
  pending_ = GL_NO_ERROR;
  const auto kind = error == GL_OUT_OF_MEMORY ? DeviceErrorKind::OutOfMemory : DeviceErrorKind::DeviceLost;
  throw DeviceError(kind, call, label, std::string("the driver reports ") + gl_error_name(error));
}

void require_host_memory(size_t bytes, std::string_view call, std::string_view label) {
  constexpr size_t kSmall = size_t{64} << 20;  // not worth opening a file for
  if (bytes < kSmall) return;
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  size_t kibibytes = 0;
  while (file >> key >> kibibytes) {
    if (key == "MemAvailable:" && bytes / 1024 > kibibytes) {
      throw DeviceError(
          DeviceErrorKind::OutOfMemory, call, label,
          std::to_string(bytes) + " bytes asked for, the host has " + std::to_string(kibibytes) + " KiB available");
    }
    std::getline(file, unit);
  }
}

}  // namespace volumark
