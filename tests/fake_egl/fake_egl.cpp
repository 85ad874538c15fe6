/// A libEGL.so.1 for machines without a graphics card: the real one, whose software device is listed three
/// times: as a card that does not start, as a card that does, and as itself. A program finds it by
/// LD_LIBRARY_PATH. What draws calls itself what FAKE_EGL_RENDERER says; without that, cards are not to be
/// touched.
#include <cstdlib>
#include <cstring>

#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <dlfcn.h>

namespace {

using Procedure = __eglMustCastToProperFunctionPointerType;

char broken_card, card;  // their addresses are the handles

Procedure real(const char* name) {
  static void* const library = ::dlopen(STEREOBENCH_REAL_EGL, RTLD_NOW | RTLD_LOCAL);
  static const auto get = reinterpret_cast<PFNEGLGETPROCADDRESSPROC>(::dlsym(library, "eglGetProcAddress"));
  return get(name);
}

EGLDeviceEXT software_device() {
  EGLDeviceEXT device = nullptr;
  EGLint count = 0;
  reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(real("eglQueryDevicesEXT"))(1, &device, &count);
  return device;
}

EGLBoolean query_devices(EGLint room, EGLDeviceEXT* devices, EGLint* count) {
  *count = 3;
  if (room >= 3) devices[0] = &broken_card, devices[1] = &card, devices[2] = software_device();
  return EGL_TRUE;
}

const char* query_device_string(EGLDeviceEXT device, EGLint name) {
  if (device == &broken_card || device == &card) return "EGL_EXT_device_drm";
  return reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(real("eglQueryDeviceStringEXT"))(device, name);
}

EGLDisplay get_platform_display(EGLenum platform, void* device, const EGLAttrib* attributes) {
  if ((device == &broken_card || device == &card) && std::getenv("FAKE_EGL_RENDERER") == nullptr)
    std::abort();
  if (device == &broken_card) return &broken_card;
  return reinterpret_cast<PFNEGLGETPLATFORMDISPLAYPROC>(real("eglGetPlatformDisplay"))(
      platform, device == &card ? software_device() : device, attributes);
}

EGLBoolean initialize(EGLDisplay display, EGLint* major, EGLint* minor) {
  if (display == &broken_card) return EGL_FALSE;
  return reinterpret_cast<PFNEGLINITIALIZEPROC>(real("eglInitialize"))(display, major, minor);
}

const GLubyte* get_string(GLenum name) {
  const char* const renderer = std::getenv("FAKE_EGL_RENDERER");
  if (name == GL_RENDERER && renderer != nullptr) return reinterpret_cast<const GLubyte*>(renderer);
  return reinterpret_cast<PFNGLGETSTRINGPROC>(real("glGetString"))(name);
}

}  // namespace

extern "C" Procedure eglGetProcAddress(const char* name) {
  if (std::strcmp(name, "eglQueryDevicesEXT") == 0) return reinterpret_cast<Procedure>(query_devices);
  if (std::strcmp(name, "eglQueryDeviceStringEXT") == 0)
    return reinterpret_cast<Procedure>(query_device_string);
  if (std::strcmp(name, "eglGetPlatformDisplay") == 0)
    return reinterpret_cast<Procedure>(get_platform_display);
  if (std::strcmp(name, "eglInitialize") == 0) return reinterpret_cast<Procedure>(initialize);
  if (std::strcmp(name, "glGetString") == 0) return reinterpret_cast<Procedure>(get_string);
  return real(name);
}
