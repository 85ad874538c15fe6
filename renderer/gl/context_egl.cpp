#include "renderer/gl/context_egl.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#define EGL_EGL_PROTOTYPES 0  // nothing of EGL is linked
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <fmt/core.h>

#include "renderer/gl/gl.h"

namespace stereobench::renderer {
namespace {

/// The functions of EGL that are called, named as in its specification without their "egl". The library is
/// never unloaded, and its displays are never terminated: other contexts of the process may be using them.
struct Egl {
  /// @throws std::runtime_error when there is no libEGL, or it is older than EGL 1.5
  Egl();

  PFNEGLGETPROCADDRESSPROC GetProcAddress;
  PFNEGLQUERYDEVICESEXTPROC QueryDevicesEXT;
  PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceStringEXT;  ///< null where there is no driver, thus no device
  PFNEGLGETPLATFORMDISPLAYPROC GetPlatformDisplay;
  PFNEGLINITIALIZEPROC Initialize;
  PFNEGLBINDAPIPROC BindAPI;
  PFNEGLCREATECONTEXTPROC CreateContext;
  PFNEGLDESTROYCONTEXTPROC DestroyContext;
  PFNEGLMAKECURRENTPROC MakeCurrent;

 private:
  template <typename Function>
  void find(const char* name, Function& function) const {
    function = reinterpret_cast<Function>(GetProcAddress(name));
  }
  template <typename Function>
  void fetch(const char* name, Function& function) const {
    find(name, function);
    if (function == nullptr) throw std::runtime_error(fmt::format("renderer: this EGL has no {}", name));
  }
};

Egl::Egl() {
  void* const library = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw std::runtime_error(
        fmt::format("renderer: there is no EGL here: {}; install it (Debian: libegl1) or render with osmesa",
                    ::dlerror()));
  }
  GetProcAddress = reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(::dlsym(library, "eglGetProcAddress"));
  if (GetProcAddress == nullptr) throw std::runtime_error("renderer: this EGL has no eglGetProcAddress");
  fetch("eglQueryDevicesEXT", QueryDevicesEXT);
  find("eglQueryDeviceStringEXT", QueryDeviceStringEXT);
  fetch("eglGetPlatformDisplay", GetPlatformDisplay);
  fetch("eglInitialize", Initialize);
  fetch("eglBindAPI", BindAPI);
  fetch("eglCreateContext", CreateContext);
  fetch("eglDestroyContext", DestroyContext);
  fetch("eglMakeCurrent", MakeCurrent);
}

const Egl& egl() {
  static const Egl functions;
  return functions;
}

class EglContext final : public Context {
 public:
  EglContext(EGLDisplay display, EGLContext handle) : display_(display), handle_(handle) {}
  ~EglContext() override {
    leave();
    egl().DestroyContext(display_, handle_);
  }

 private:
  bool bind() const override {
    return egl().MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, handle_) == EGL_TRUE;
  }
  void unbind() const override {
    egl().MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  Procedure find(const char* name) const override { return egl().GetProcAddress(name); }

  EGLDisplay display_;
  EGLContext handle_;
};

std::vector<EGLDeviceEXT> all_devices() {
  EGLint count = 0;
  if (egl().QueryDevicesEXT(0, nullptr, &count) != EGL_TRUE) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (egl().QueryDevicesEXT(count, devices.data(), &count) != EGL_TRUE) return {};
  return devices;
}

EglDevice kind_of(EGLDeviceEXT device) {
  const char* const extensions = egl().QueryDeviceStringEXT(device, EGL_EXTENSIONS);
  const bool in_software =
      extensions != nullptr && std::string(extensions).find("EGL_MESA_device_software") != std::string::npos;
  return in_software ? EglDevice::kSoftware : EglDevice::kGraphicsCard;
}

/// Null where this process gets no OpenGL 4.5 from the device.
std::unique_ptr<Context> context_on(EGLDeviceEXT device) {
  constexpr std::array<EGLint, 7> kAttributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                 4,
                                                 EGL_CONTEXT_MINOR_VERSION,
                                                 5,
                                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                 EGL_NONE};
  const EGLDisplay display = egl().GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
  if (display == EGL_NO_DISPLAY || egl().Initialize(display, nullptr, nullptr) != EGL_TRUE) return nullptr;
  if (egl().BindAPI(EGL_OPENGL_API) != EGL_TRUE) return nullptr;
  const EGLContext handle =
      egl().CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
  return handle == EGL_NO_CONTEXT ? nullptr : std::make_unique<EglContext>(display, handle);
}

/// What a device says of itself is not all: a driver may fall back on another rasteriser.
bool is_drawn_by(const Context& context, EglDevice wanted) {
  context.make_current();
  const std::string drawer = gl_string(Gl(context), GL_RENDERER);
  return wanted == EglDevice::kSoftware ? drawer.starts_with("llvmpipe")
                                        : drawer.find("llvmpipe") == std::string::npos;
}

}  // namespace

std::unique_ptr<Context> create_egl_context(EglDevice wanted) {
  const std::vector<EGLDeviceEXT> devices = all_devices();
  for (const EGLDeviceEXT device : devices) {
    if (kind_of(device) != wanted) continue;
    std::unique_ptr<Context> context = context_on(device);
    if (context != nullptr && is_drawn_by(*context, wanted)) return context;
  }
  throw std::runtime_error(
      wanted == EglDevice::kSoftware
          ? "renderer: EGL has no OpenGL 4.5 by llvmpipe here; install Mesa's (Debian: libegl-mesa0, "
            "libgl1-mesa-dri) or render with osmesa"
          : fmt::format("renderer: none of EGL's {} devices is a graphics card with OpenGL 4.5 that may be "
                        "used; render with osmesa or egl",
                        devices.size()));
}

}  // namespace stereobench::renderer
