/// The part of a surface's GLSL program that looks into a texture.
#pragma once

#include <string>

namespace stereobench::renderer {

/// The function `albedo` for places in texels: trilinear filtering of a texture's mip chain, between the two
/// levels whose texels are as wide as the pixel's longer side there. Done by hand from whole numbers:
/// samplers filter with another arithmetic on each machine, up to 7 levels of 255 apart.
std::string texture_albedo();

}  // namespace stereobench::renderer
