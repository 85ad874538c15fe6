#include "renderer/gl/context_osmesa.h"

#include <array>
#include <stdexcept>

#include <GL/osmesa.h>
#include <dlfcn.h>
#include <fmt/core.h>

namespace stereobench::renderer {
namespace {

constexpr int kWindow_px = 4;  // OSMesa demands a window to draw to; pictures go to framebuffer objects

/// The functions of OSMesa that are called, named as there without their "OSMesa". The library is never
/// unloaded.
struct Osmesa {
  /// @throws std::runtime_error when there is no OSMesa, or one that lacks a function
  Osmesa();

  decltype(&OSMesaCreateContextAttribs) CreateContextAttribs;
  decltype(&OSMesaDestroyContext) DestroyContext;
  decltype(&OSMesaMakeCurrent) MakeCurrent;
  decltype(&OSMesaGetProcAddress) GetProcAddress;
};

template <typename Function>
void fetch(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(fmt::format("renderer: this OSMesa has no {}", name));
}

Osmesa::Osmesa() {
  void* const library = ::dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    throw std::runtime_error(fmt::format(
        "renderer: there is no OSMesa here: {}; install libosmesa6 or render with egl", ::dlerror()));
  }
  fetch(library, "OSMesaCreateContextAttribs", CreateContextAttribs);
  fetch(library, "OSMesaDestroyContext", DestroyContext);
  fetch(library, "OSMesaMakeCurrent", MakeCurrent);
  fetch(library, "OSMesaGetProcAddress", GetProcAddress);
}

const Osmesa& osmesa() {
  static const Osmesa functions;
  return functions;
}

OSMesaContext create_handle() {
  constexpr std::array<int, 13> kAttributes = {OSMESA_FORMAT,
                                               OSMESA_RGBA,
                                               OSMESA_DEPTH_BITS,
                                               0,
                                               OSMESA_PROFILE,
                                               OSMESA_CORE_PROFILE,
                                               OSMESA_CONTEXT_MAJOR_VERSION,
                                               4,
                                               OSMESA_CONTEXT_MINOR_VERSION,
                                               5,
                                               0,
                                               0,
                                               0};
  return osmesa().CreateContextAttribs(kAttributes.data(), nullptr);
}

class OsmesaContext final : public Context {
 public:
  OsmesaContext() : handle_(create_handle()) {
    if (handle_ == nullptr) {
      throw std::runtime_error(
          "renderer: OSMesa has no OpenGL 4.5 core profile; install libosmesa6 22.3 or newer");
    }
  }
  ~OsmesaContext() override {
    leave();
    osmesa().DestroyContext(handle_);
  }

 private:
  bool bind() const override {
    return osmesa().MakeCurrent(handle_, window_.data(), GL_UNSIGNED_BYTE, kWindow_px, kWindow_px) == GL_TRUE;
  }
  void unbind() const override { osmesa().MakeCurrent(nullptr, nullptr, 0, 0, 0); }
  Procedure find(const char* name) const override { return osmesa().GetProcAddress(name); }

  OSMesaContext handle_;
  mutable std::array<unsigned char, std::size_t{kWindow_px} * kWindow_px * 4> window_{};
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace stereobench::renderer
