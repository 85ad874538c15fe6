/// OpenGL by EGL: a library that is looked for at run time, and whatever device it has.
#pragma once

#include <memory>

#include "renderer/gl/context.h"

namespace stereobench::renderer {

/// What draws: Mesa's llvmpipe, the rasteriser that OSMesa has too, or the first graphics card that can.
enum class EglDevice { kSoftware, kGraphicsCard };

/// Creates a context on a device of this kind. No display, window system or variable of the environment has a
/// part in the choice.
/// @throws std::runtime_error when there is no libEGL, or it has no such device with OpenGL 4.5
std::unique_ptr<Context> create_egl_context(EglDevice device);

}  // namespace stereobench::renderer
