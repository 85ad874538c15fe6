#include "renderer/textures/uv_transform.h"

#include "slam/math/elementary.h"

namespace stereobench::renderer {

UvTransform gltf_transform(const aiMaterial& material, aiTextureType type) {
  aiUVTransform given;
  if (aiGetMaterialUVTransform(&material, _AI_MATKEY_UVTRANSFORM_BASE, static_cast<unsigned>(type), 0,
                               &given) != aiReturn_SUCCESS)
    return {};
  const auto [s, c] = slam::sine_cosine(-double{given.mRotation});
  const Eigen::Vector2d scale(double{given.mScaling.x}, double{given.mScaling.y});
  UvTransform transform;
  transform.linear << c * scale.x(), s * scale.y(), -s * scale.x(), c * scale.y();
  // Assimp's translation is the file's offset and what takes its turn about the middle to the corner.
  transform.offset = {double{given.mTranslation.x} - 0.5 * scale.x() * (1.0 - c + s),
                      0.5 * scale.y() * (c + s - 1.0) + 1.0 - scale.y() - double{given.mTranslation.y}};
  return transform;
}

}  // namespace stereobench::renderer
