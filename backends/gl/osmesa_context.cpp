// OSMesa: Mesa's off-screen platform, llvmpipe inside; needs neither display nor GPU.
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>

#include "backends/device.h"
#include "backends/gl/gl_context.h"

namespace volumark {

namespace {

struct OsmesaLibrary {
  decltype(&OSMesaCreateContextAttribs) create = nullptr;
  decltype(&OSMesaDestroyContext) destroy = nullptr;
  decltype(&OSMesaMakeCurrent) make_current = nullptr;
  decltype(&OSMesaGetProcAddress) function = nullptr;
};

[[noreturn]] void refuse(const std::string& message) {
  throw DeviceError(DeviceErrorKind::MissingCapability, "make_device", "gl",
                    message + "; install libosmesa6, or use a GPU with the gl platform 'egl'");
}

template <class F>
void load(void* library, const char* name, F& out) {
  out = reinterpret_cast<F>(dlsym(library, name));
  if (!out) refuse(std::string("libOSMesa has no function ") + name);
}

const OsmesaLibrary& osmesa() {
  static const OsmesaLibrary loaded = [] {
    std::string tried;
    void* library = open_library({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"}, tried);
    if (!library) refuse("OSMesa is not installed (" + tried + ")");
    OsmesaLibrary result;
    load(library, "OSMesaCreateContextAttribs", result.create);
    load(library, "OSMesaDestroyContext", result.destroy);
    load(library, "OSMesaMakeCurrent", result.make_current);
    load(library, "OSMesaGetProcAddress", result.function);
    return result;
  }();
  return loaded;
}

class OsmesaContext final : public GlContext {
 public:
  OsmesaContext() {
    const std::array<int, 15> attributes = {OSMESA_FORMAT,
                                            OSMESA_RGBA,
                                            OSMESA_DEPTH_BITS,
                                            0,
                                            OSMESA_STENCIL_BITS,
                                            0,
                                            OSMESA_ACCUM_BITS,
                                            0,
                                            OSMESA_PROFILE,
                                            OSMESA_CORE_PROFILE,
                                            OSMESA_CONTEXT_MAJOR_VERSION,
                                            4,
                                            OSMESA_CONTEXT_MINOR_VERSION,
                                            5,
                                            0};
    context_ = osmesa().create(attributes.data(), nullptr);
    if (!context_) refuse("this OSMesa gives no OpenGL 4.5 core context");
  }
  ~OsmesaContext() override {
    release_if_current();
    osmesa().destroy(context_);
  }

  const char* platform() const override { return "OSMesa"; }
  void* function(const char* name) const override { return reinterpret_cast<void*>(osmesa().function(name)); }

 private:
  bool bind() override { return osmesa().make_current(context_, dummy_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_TRUE; }
  Release release_function() const override {
    return [] { osmesa().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); };
  }

  OSMesaContext context_ = nullptr;
  // A context without a buffer cannot be made current; all drawing goes to textures.
  alignas(16) std::array<unsigned char, 64> dummy_{};
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context() { return std::make_unique<OsmesaContext>(); }

}  // namespace volumark
