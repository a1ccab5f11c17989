#include "backends/gl/gl_functions.h"

#include "backends/device.h"
#include "backends/gl/gl_context.h"

namespace volumark {

namespace {

template <class F>
void load(const GlContext& context, const char* name, F& out) {
  out = reinterpret_cast<F>(context.function(name));
  if (!out) {
    throw DeviceError(DeviceErrorKind::MissingCapability, "make_device", "gl",
                      std::string("the driver has no function ") + name + " of OpenGL 4.5");
  }
}

}  // namespace

GlFunctions load_gl_functions(const GlContext& context) {
  GlFunctions result;
#define VM_GL_LOAD(type, name) load(context, "gl" #name, result.name);
  VM_GL_FUNCTIONS(VM_GL_LOAD)
#undef VM_GL_LOAD
  return result;
}

}  // namespace volumark
