// EGL without a window system: reaches real GPUs. Displays are tried in this order: hardware devices, Mesa's
// surfaceless platform, software devices, the default display.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <string_view>
#include <vector>

#include "backends/device.h"
#include "backends/gl/gl_context.h"

namespace volumark {

namespace {

struct EglLibrary {
  PFNEGLGETPROCADDRESSPROC function = nullptr;
  PFNEGLQUERYSTRINGPROC query_string = nullptr;
  PFNEGLGETERRORPROC error = nullptr;
  PFNEGLGETDISPLAYPROC default_display = nullptr;
  PFNEGLINITIALIZEPROC initialize = nullptr;
  PFNEGLBINDAPIPROC bind_api = nullptr;
  PFNEGLCHOOSECONFIGPROC choose_config = nullptr;
  PFNEGLCREATECONTEXTPROC create_context = nullptr;
  PFNEGLDESTROYCONTEXTPROC destroy_context = nullptr;
  PFNEGLCREATEPBUFFERSURFACEPROC create_pbuffer = nullptr;
  PFNEGLDESTROYSURFACEPROC destroy_surface = nullptr;
  PFNEGLMAKECURRENTPROC make_current = nullptr;
  PFNEGLGETCURRENTDISPLAYPROC current_display = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display = nullptr;    // optional
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;             // optional
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;  // optional
};

[[noreturn]] void refuse(const std::string& message) {
  throw DeviceError(DeviceErrorKind::MissingCapability, "make_device", "gl",
                    message + "; the gl platform 'osmesa' needs no GPU");
}

template <class F>
void load(void* library, const char* name, F& out) {
  out = reinterpret_cast<F>(dlsym(library, name));
  if (!out) refuse(std::string("libEGL has no function ") + name);
}

const EglLibrary& egl() {
  static const EglLibrary loaded = [] {
    std::string tried;
    void* library = open_library({"libEGL.so.1", "libEGL.so"}, tried);
    if (!library) refuse("EGL is not installed (" + tried + ")");
    EglLibrary result;
    load(library, "eglGetProcAddress", result.function);
    load(library, "eglQueryString", result.query_string);
    load(library, "eglGetError", result.error);
    load(library, "eglGetDisplay", result.default_display);
    load(library, "eglInitialize", result.initialize);
    load(library, "eglBindAPI", result.bind_api);
    load(library, "eglChooseConfig", result.choose_config);
    load(library, "eglCreateContext", result.create_context);
    load(library, "eglDestroyContext", result.destroy_context);
    load(library, "eglCreatePbufferSurface", result.create_pbuffer);
    load(library, "eglDestroySurface", result.destroy_surface);
    load(library, "eglMakeCurrent", result.make_current);
    load(library, "eglGetCurrentDisplay", result.current_display);
    const auto optional = [&](const char* name, auto& out) {
      out = reinterpret_cast<std::remove_reference_t<decltype(out)>>(result.function(name));
    };
    optional("eglGetPlatformDisplayEXT", result.platform_display);
    optional("eglQueryDevicesEXT", result.query_devices);
    optional("eglQueryDeviceStringEXT", result.query_device_string);
    return result;
  }();
  return loaded;
}

// Whether `list`, names parted by blanks, holds `name`.
bool has_extension(const char* list, std::string_view name) {
  std::string_view rest = list ? list : "";
  while (!rest.empty()) {
    const size_t end = rest.find(' ');
    if (rest.substr(0, end) == name) return true;
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  return false;
}

struct Candidate {
  EGLDisplay display;
  const char* platform;
};

std::vector<Candidate> candidates() {
  const EglLibrary& e = egl();
  std::vector<Candidate> hardware, software;
  const char* client = e.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool can_choose = e.platform_display != nullptr;
  if (can_choose && e.query_devices && has_extension(client, "EGL_EXT_platform_device")) {
    EGLint count = 0;
    e.query_devices(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count > 0 ? count : 0));
    e.query_devices(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices) {
      const char* list = e.query_device_string ? e.query_device_string(device, EGL_EXTENSIONS) : nullptr;
      const bool is_software = has_extension(list, "EGL_MESA_device_software");
      const EGLDisplay display = e.platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
      if (is_software) {
        software.push_back({display, "EGL, software device"});
      } else {
        hardware.push_back({display, "EGL, device"});
      }
    }
  }
  std::vector<Candidate> all = hardware;
  if (can_choose && has_extension(client, "EGL_MESA_platform_surfaceless")) {
    all.push_back(
        {e.platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "EGL, surfaceless"});
  }
  all.insert(all.end(), software.begin(), software.end());
  all.push_back({e.default_display(EGL_DEFAULT_DISPLAY), "EGL, default display"});
  return all;
}

class EglContext final : public GlContext {
 public:
  // Leaves `reason` where the display gives no context.
  static std::unique_ptr<EglContext> try_display(const Candidate& candidate, std::string& reason);
  ~EglContext() override {
    release_if_current();
    if (surface_ != EGL_NO_SURFACE) egl().destroy_surface(display_, surface_);
    if (context_ != EGL_NO_CONTEXT) egl().destroy_context(display_, context_);
    // Displays are not terminated: another Device may use the same one, and EGL does not count.
  }

  const char* platform() const override { return platform_; }
  void* function(const char* name) const override { return reinterpret_cast<void*>(egl().function(name)); }

 private:
  bool bind() override {
    egl().bind_api(EGL_OPENGL_API);
    return egl().make_current(display_, surface_, surface_, context_) == EGL_TRUE;
  }
  Release release_function() const override {
    return [] { egl().make_current(egl().current_display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); };
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  EGLSurface surface_ = EGL_NO_SURFACE;
  const char* platform_ = "EGL";
};

std::unique_ptr<EglContext> EglContext::try_display(const Candidate& candidate, std::string& reason) {
  const EglLibrary& e = egl();
  const auto fail = [&](const char* what) {
    char code[16];
    std::snprintf(code, sizeof code, " (0x%x)", static_cast<unsigned>(e.error()));
    reason = std::string(candidate.platform) + ": " + what + code;
    return nullptr;
  };
  EGLint major = 0, minor = 0;
  if (candidate.display == EGL_NO_DISPLAY) return fail("no display");
  if (!e.initialize(candidate.display, &major, &minor)) return fail("eglInitialize failed");
  if (!e.bind_api(EGL_OPENGL_API)) return fail("no OpenGL, only OpenGL ES");

  const char* extensions = e.query_string(candidate.display, EGL_EXTENSIONS);
  const bool surfaceless = has_extension(extensions, "EGL_KHR_surfaceless_context");
  const EGLint wanted[] = {EGL_SURFACE_TYPE, surfaceless ? 0 : EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (!e.choose_config(candidate.display, wanted, &config, 1, &found) || found < 1) return fail("no configuration");

  auto result = std::make_unique<EglContext>();
  result->display_ = candidate.display;
  result->platform_ = candidate.platform;
  const EGLint version[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  result->context_ = e.create_context(candidate.display, config, EGL_NO_CONTEXT, version);
  if (result->context_ == EGL_NO_CONTEXT) return fail("no OpenGL 4.5 core context");
  if (!surfaceless) {
    const EGLint size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    result->surface_ = e.create_pbuffer(candidate.display, config, size);
    if (result->surface_ == EGL_NO_SURFACE) return fail("no pbuffer");
  }
  return result;
}

}  // namespace

std::unique_ptr<GlContext> make_egl_context() {
  std::string tried;
  for (const Candidate& candidate : candidates()) {
    std::string reason;
    if (auto context = EglContext::try_display(candidate, reason)) return context;
    if (!tried.empty()) tried += "; ";
    tried += reason;
  }
  refuse("no EGL display gives an OpenGL 4.5 core context: " + tried);
}

}  // namespace volumark
