#include "backends/gl/gl_caches.h"

namespace volumark {

GLuint GlCaches::sampler(const Sampler& sampler) {
  GLuint& name = samplers_[static_cast<size_t>(sampler.filter)][static_cast<size_t>(sampler.wrap)];
  if (name) return name;
  gl_.CreateSamplers(1, &name);
  const GLint filter = static_cast<GLint>(gl_filter(sampler.filter));
  const GLint wrap = static_cast<GLint>(gl_wrap(sampler.wrap));
  gl_.SamplerParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
  gl_.SamplerParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    gl_.SamplerParameteri(name, axis, wrap);
  }
  const std::array<GLfloat, 4> transparent_black{};
  gl_.SamplerParameterfv(name, GL_TEXTURE_BORDER_COLOR, transparent_black.data());
  return name;
}

GLuint GlCaches::framebuffer(const GlTexture& colour, const GlTexture* depth_stencil, const std::string& label) {
  const std::pair key{colour.serial, depth_stencil ? depth_stencil->serial : 0};
  if (const auto found = framebuffers_.find(key); found != framebuffers_.end()) return found->second;
  GLuint name = 0;
  gl_.CreateFramebuffers(1, &name);
  gl_.NamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, colour.name, 0);
  if (depth_stencil) gl_.NamedFramebufferTexture(name, GL_DEPTH_STENCIL_ATTACHMENT, depth_stencil->name, 0);
  const GLenum status = gl_.CheckNamedFramebufferStatus(name, GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    gl_.DeleteFramebuffers(1, &name);
    throw DeviceError(DeviceErrorKind::MissingCapability, "begin_pass", label,
                      std::string("the driver cannot draw to ") + to_string(colour.format) +
                          (depth_stencil ? " with D32FS8" : "") + " (status " + std::to_string(status) + ")");
  }
  framebuffers_.emplace(key, name);
  return name;
}

bool GlCaches::forget_texture(uint64_t serial) {
  return std::erase_if(framebuffers_, [&](const auto& entry) {
           const auto& [colour, depth_stencil] = entry.first;
           if (colour != serial && depth_stencil != serial) return false;
           gl_.DeleteFramebuffers(1, &entry.second);
           return true;
         }) > 0;
}

}  // namespace volumark
