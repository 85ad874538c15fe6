/// Colours: what balls are painted with, and how colours are drawn.
#pragma once

#include <string>

#include "worlds/generate/keyed_sampler.h"
#include "worlds/types.h"

namespace stereobench::worlds {

/// A colour of the palette under full light, in [0, 1].
Eigen::Vector3d palette_rgb(int colour);

/// What a ball is painted with.
Eigen::Vector3d paint_of(const Ball& ball);

/// shade x the palette's colour + tint in each channel, within [0, 1]. Draws name.shade, .red, .green, .blue.
Eigen::Vector3d draw_paint(KeyedSampler& draws, const std::string& name, int colour, const Range& shade,
                           const Range& tint);

/// shade x (1 + tint) in each channel. Draws name.shade, .red, .green, .blue.
Eigen::Vector3d draw_tint(KeyedSampler& draws, const std::string& name, const SurfaceLooks& looks);

/// Draws name.material, one of those that have no texture.
Material draw_material(KeyedSampler& draws, const std::string& name, const SurfaceLooks& looks);

/// Draws name.material: a material, or a texture by the name of its file.
void draw_surface(KeyedSampler& draws, const std::string& name, const SurfaceLooks& looks, Material& material,
                  SurfaceTexture& texture);

/// One of these. @param key of the draw
MeshShape draw_shape(KeyedSampler& draws, const std::string& key, const std::vector<MeshShape>& shapes);

}  // namespace stereobench::worlds
