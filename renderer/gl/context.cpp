#include "renderer/gl/context.h"

#include <cstdlib>
#include <stdexcept>

#include <fmt/core.h>

#include "renderer/gl/context_egl.h"
#include "renderer/gl/context_osmesa.h"
#include "renderer/gl/idle_code.h"

namespace stereobench::renderer {
namespace {

constexpr long kWidestVector_bits = 256;

/// Where this thread's GL calls go. Two copies of Mesa share one such pointer (in libglapi) without each
/// knowing of the other, so a context is unbound before another library's is bound.
thread_local const Context* current = nullptr;

void refuse_wide_vectors() {
  const char* asked = std::getenv("LP_NATIVE_VECTOR_WIDTH");
  if (asked == nullptr || std::strtol(asked, nullptr, 10) <= kWidestVector_bits) return;
  throw std::runtime_error(fmt::format(
      "renderer: LP_NATIVE_VECTOR_WIDTH={}: vectors wider than {} bits crash Mesa's software rasteriser; "
      "unset the variable or set it to 128 or 256",
      asked, kWidestVector_bits));
}

std::unique_ptr<Context> create_context(Backend backend) {
  switch (drawn_by(backend)) {
    case Backend::kOsmesa:
      return create_osmesa_context();
    case Backend::kEgl:
      return create_egl_context(EglDevice::kSoftware);
    case Backend::kEglGpu:
      return create_egl_context(EglDevice::kGraphicsCard);
    case Backend::kSoftware:
      break;  // is drawn by one of the others
  }
  throw std::invalid_argument("make_context: no such back end");
}

}  // namespace

void Context::make_current() const {
  if (current != nullptr && current != this) current->leave();
  current = this;
  if (!bind()) throw std::runtime_error("renderer: the OpenGL context cannot be made current");
}

void Context::leave() const {
  if (current != this) return;
  unbind();
  current = nullptr;
}

Context::Procedure Context::procedure(const char* name) const {
  const Procedure found = find(name);
  if (found == nullptr) throw std::runtime_error(fmt::format("renderer: this OpenGL has no {}", name));
  return found;
}

Backend drawn_by(Backend backend) {
  if (backend != Backend::kSoftware) return backend;
  static const Backend found = has_osmesa() ? Backend::kOsmesa : Backend::kEgl;
  return found;
}

std::unique_ptr<Context> make_context(Backend backend) {
  if (backend != Backend::kEglGpu) refuse_wide_vectors();
  std::unique_ptr<Context> context = create_context(backend);
  context->make_current();
  release_code(kCompiler);  // what it calls once, to set itself up, is 36 MB of it
  return context;
}

}  // namespace stereobench::renderer
