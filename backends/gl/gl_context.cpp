#include "backends/gl/gl_context.h"

#include <dlfcn.h>

#include <atomic>

#include "backends/device.h"

namespace volumark {

namespace {
std::atomic<uint64_t> last_serial{0};
}

thread_local GlContext::Current GlContext::current_;

GlContext::GlContext() : serial_(++last_serial) {}

void GlContext::switch_to() {
  if (current_.release) current_.release();
  current_ = {};
  if (!bind()) {
    throw DeviceError(DeviceErrorKind::DeviceLost, "make_current", platform(),
                      "the platform refused to make the GL context current (is it current in another thread?)");
  }
  current_ = {serial_, release_function()};
}

void GlContext::release_if_current() {
  if (current_.serial != serial_) return;
  current_.release();
  current_ = {};
}

void* open_library(std::initializer_list<const char*> names, std::string& tried) {
  for (const char* name : names) {
    // RTLD_LOCAL: the libraries export functions of the same names. Never closed: LLVM and the GL dispatch keep
    // thread-local state in them.
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
    const char* reason = dlerror();
    if (!tried.empty()) tried += "; ";
    tried += reason ? reason : name;
  }
  return nullptr;
}

}  // namespace volumark
