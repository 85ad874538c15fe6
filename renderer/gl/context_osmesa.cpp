#include "renderer/gl/context_osmesa.h"

#include <array>
#include <stdexcept>

#include <dlfcn.h>
#include <fmt/core.h>

#include "renderer/gl/gl.h"
#include "renderer/gl/idle_code.h"

namespace stereobench::renderer {
namespace {

constexpr int kWindow_px = 4;  // OSMesa demands a window to draw to; pictures go to framebuffer objects

using OsmesaHandle = struct OsmesaState*;

/// The functions of OSMesa that are called. They are declared here, as are the numbers below: Mesa 25.1
/// dropped the header with the library, and what is built without them runs with a library of before.
struct Osmesa {
  /// @throws std::runtime_error when there is no OSMesa, or one that lacks a function
  Osmesa();

  OsmesaHandle (*create)(const int* attributes, OsmesaHandle sharer);
  void (*destroy)(OsmesaHandle handle);
  GLboolean (*make_current)(OsmesaHandle handle, void* window, GLenum type, GLsizei width_px,
                            GLsizei height_px);
  Context::Procedure (*procedure)(const char* name);
};

template <typename Function>
void fetch(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(fmt::format("renderer: this OSMesa has no {}", name));
}

/// Null where there is none: `dlerror` then says why.
void* open_osmesa() {
  return ::dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
}

Osmesa::Osmesa() {
  void* const library = open_osmesa();
  if (library == nullptr) {
    throw std::runtime_error(fmt::format(
        "renderer: there is no OSMesa here: {}; install it (Debian: libosmesa6) or render with egl",
        ::dlerror()));
  }
  fetch(library, "OSMesaCreateContextAttribs", create);
  fetch(library, "OSMesaDestroyContext", destroy);
  fetch(library, "OSMesaMakeCurrent", make_current);
  fetch(library, "OSMesaGetProcAddress", procedure);
}

const Osmesa& osmesa() {
  static const Osmesa functions;
  return functions;
}

OsmesaHandle create_handle() {
  constexpr int kFormat = 0x22, kDepthBits = 0x30, kProfile = 0x33, kMajorVersion = 0x36,
                kMinorVersion = 0x37;
  constexpr int kCoreProfile = 0x34;
  constexpr std::array<int, 11> kAttributes = {
      kFormat, GL_RGBA, kDepthBits, 0, kProfile, kCoreProfile, kMajorVersion, 4, kMinorVersion, 5, 0};
  return osmesa().create(kAttributes.data(), nullptr);
}

class OsmesaContext final : public Context {
 public:
  OsmesaContext() : handle_(create_handle()) {
    if (handle_ == nullptr) {
      throw std::runtime_error("renderer: OSMesa has no OpenGL 4.5 core profile; install Mesa 22.3 or newer");
    }
  }
  ~OsmesaContext() override {
    leave();
    osmesa().destroy(handle_);
  }

 private:
  bool bind() const override {
    return osmesa().make_current(handle_, window_.data(), GL_UNSIGNED_BYTE, kWindow_px, kWindow_px) ==
           GL_TRUE;
  }
  void unbind() const override { osmesa().make_current(nullptr, nullptr, 0, 0, 0); }
  Procedure find(const char* name) const override { return osmesa().procedure(name); }

  OsmesaHandle handle_;
  mutable std::array<unsigned char, std::size_t{kWindow_px} * kWindow_px * 4> window_{};
};

}  // namespace

bool has_osmesa() {
  const bool opens = open_osmesa() != nullptr;
  release_code(kCompiler);
  return opens;
}

std::unique_ptr<Context> create_osmesa_context() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace stereobench::renderer
