#include "renderer/context_osmesa.h"

#include <array>
#include <stdexcept>

#include <GL/osmesa.h>

namespace stereobench::renderer {
namespace {

constexpr int kWindow_px = 4;  // OSMesa demands a window to draw to; pictures go to framebuffer objects

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
  return OSMesaCreateContextAttribs(kAttributes.data(), nullptr);
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
    OSMesaDestroyContext(handle_);
  }

 private:
  bool bind() const override {
    return OSMesaMakeCurrent(handle_, window_.data(), GL_UNSIGNED_BYTE, kWindow_px, kWindow_px) == GL_TRUE;
  }
  void unbind() const override { OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0); }
  Procedure find(const char* name) const override { return OSMesaGetProcAddress(name); }

  OSMesaContext handle_;
  mutable std::array<unsigned char, std::size_t{kWindow_px} * kWindow_px * 4> window_{};
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context() {
  return std::make_unique<OsmesaContext>();
}

}  // namespace stereobench::renderer
