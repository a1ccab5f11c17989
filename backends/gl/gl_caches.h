// GL objects that the Device does not know: made on first use, kept until what they refer to goes.
#pragma once

#include <array>
#include <map>
#include <string>

#include "backends/gl/gl_texture.h"

namespace volumark {

class GlCaches {
 public:
  explicit GlCaches(const GlFunctions& gl) : gl_(gl) {}

  GLuint sampler(const Sampler& sampler);
  // `depth_stencil` may be null. Throws DeviceError MissingCapability where the driver cannot draw to the formats.
  GLuint framebuffer(const GlTexture& colour, const GlTexture* depth_stencil, const std::string& label);
  // Deletes the framebuffers that use the texture; true if there were any.
  bool forget_texture(uint64_t serial);

 private:
  const GlFunctions& gl_;
  std::array<std::array<GLuint, 3>, 2> samplers_{};               // by filter and wrap
  std::map<std::pair<uint64_t, uint64_t>, GLuint> framebuffers_;  // by the serials of colour and depth/stencil (or 0)
};

}  // namespace volumark
