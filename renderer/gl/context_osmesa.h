/// OpenGL by OSMesa: Mesa's software rasteriser as a library, which is opened once somebody renders.
#pragma once

#include <memory>

#include "renderer/gl/context.h"

namespace stereobench::renderer {

/// Opens the library, if this machine has it; it is never closed.
bool has_osmesa();

/// @throws std::runtime_error when OSMesa has no OpenGL 4.5
std::unique_ptr<Context> create_osmesa_context();

}  // namespace stereobench::renderer
