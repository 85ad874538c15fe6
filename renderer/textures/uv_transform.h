/// Where a material lays its texture, beyond what its mesh says.
#pragma once

#include <Eigen/Core>
#include <assimp/material.h>

namespace stereobench::renderer {

/// Takes places on a texture, from its upper left corner and with the texture 1 wide and high, to others.
struct UvTransform {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();

  Eigen::Vector2d operator()(const Eigen::Vector2d& place) const { return linear * place + offset; }
};

/// glTF's KHR_texture_transform: scaled, then turned counter-clockwise (as seen on the texture, whose rows
/// run down) about the upper left corner, then moved. Assimp hands it on as a transform of its own kind,
/// which turns the other way and moves before it scales: the file's numbers are worked out of that again.
/// @return what changes nothing where the material says nothing
UvTransform gltf_transform(const aiMaterial& material, aiTextureType type);

}  // namespace stereobench::renderer
