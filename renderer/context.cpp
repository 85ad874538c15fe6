#include "renderer/context.h"

#include <array>
#include <cstdlib>
#include <stdexcept>

#include <GL/osmesa.h>
#include <fmt/core.h>

namespace stereobench::renderer {
namespace {

constexpr int kWindow_px = 4;  // OSMesa demands a window to draw to; pictures go to framebuffer objects
constexpr long kWidestVector_bits = 256;

void refuse_wide_vectors() {
  const char* asked = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (asked == nullptr || std::strtol(asked, nullptr, 10) <= kWidestVector_bits) return;
  throw std::runtime_error(fmt::format(
      "renderer: LP_NATIVE_VECTOR_WIDTH={}: vectors wider than {} bits crash Mesa's software rasteriser; "
      "unset the variable or set it to 128 or 256",
      asked, kWidestVector_bits));
}

OSMesaContext create_context() {
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

}  // namespace

struct Context::Handle {
  OSMesaContext context = nullptr;
  std::array<unsigned char, std::size_t{kWindow_px} * kWindow_px * 4> window{};
};

void Context::Destroy::operator()(Handle* handle) const {
  if (handle->context != nullptr) OSMesaDestroyContext(handle->context);
  delete handle;
}

Context::Context() {
  refuse_wide_vectors();
  handle_.reset(new Handle);
  handle_->context = create_context();
  if (handle_->context == nullptr) {
    throw std::runtime_error(
        "renderer: OSMesa has no OpenGL 4.5 core profile; install libosmesa6 22.3 or newer");
  }
  make_current();
}

void Context::make_current() const {
  if (OSMesaMakeCurrent(handle_->context, handle_->window.data(), GL_UNSIGNED_BYTE, kWindow_px, kWindow_px) !=
      GL_TRUE) {
    throw std::runtime_error("renderer: OSMesa cannot make its context current");
  }
}

Context::Procedure Context::procedure(const char* name) const {
  const Procedure found = OSMesaGetProcAddress(name);
  if (found == nullptr) throw std::runtime_error(fmt::format("renderer: this OpenGL has no {}", name));
  return found;
}

}  // namespace stereobench::renderer
