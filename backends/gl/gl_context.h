// An OpenGL 4.5 core context without a window. All contexts of a thread, of whatever platform, share one current slot:
// make_current() releases the one that holds it first. No GL header is included here: <GL/osmesa.h> and
// <GL/glcorearb.h> do not go together.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace volumark {

class GlContext {
 public:
  GlContext();
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  virtual const char* platform() const = 0;  // as shown to the user: "OSMesa", "EGL, device", ...
  // The address of a GL function. OSMesa returns non-null for unknown names too.
  virtual void* function(const char* name) const = 0;

  // Cheap where it is current already. Throws DeviceError DeviceLost where the platform refuses.
  void make_current() {
    if (current_.serial != serial_) switch_to();
  }

 protected:
  using Release = void (*)();
  // To be called first in the destructor of the platform's class.
  void release_if_current();

 private:
  virtual bool bind() = 0;
  virtual Release release_function() const = 0;  // unbinds whatever this platform has bound in this thread
  void switch_to();

  struct Current {
    uint64_t serial = 0;
    Release release = nullptr;
  };
  static thread_local Current current_;
  uint64_t serial_;  // never used twice, unlike an address
};

// Both throw DeviceError with what was tried where there is no such library, display or context.
std::unique_ptr<GlContext> make_osmesa_context();
std::unique_ptr<GlContext> make_egl_context();

// Opens the first of the libraries that is there, for the life of the process; null with the reasons in `tried`.
void* open_library(std::initializer_list<const char*> names, std::string& tried);

}  // namespace volumark
