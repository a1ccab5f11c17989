// glGetError as DeviceError. GL keeps errors until they are asked for: drain before a call to know that what comes
// after belongs to it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "backends/device.h"
#include "backends/gl/gl_functions.h"

namespace volumark {

class GlErrors {
 public:
  explicit GlErrors(const GlFunctions& gl) : gl_(gl) {}

  // Keeps what recorded work has left for the next throw_pending.
  void keep_pending();
  // Throws what was left by recorded work, as OutOfMemory or DeviceLost.
  void throw_pending(std::string_view call, std::string_view label);
  // The error since the last call of any of these; GL_NO_ERROR if none.
  GLenum take();

 private:
  const GlFunctions& gl_;
  GLenum pending_ = GL_NO_ERROR;
};

const char* gl_error_name(GLenum error);

// Of a software renderer, whose memory is the host's: throws OutOfMemory where `bytes` are more than the host has free.
// The kernel would promise them, and end the process on use.
void require_host_memory(size_t bytes, std::string_view call, std::string_view label);

}  // namespace volumark
