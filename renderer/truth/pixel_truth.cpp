#include "renderer/truth/pixel_truth.h"

#include <limits>

namespace stereobench::renderer {
namespace {

constexpr float kNothing_m = std::numeric_limits<float>::infinity();

cv::Vec3f vec(const Eigen::Vector3d& v) {
  const Eigen::Vector3f narrow = v.cast<float>();
  return {narrow.x(), narrow.y(), narrow.z()};
}

}  // namespace

PixelTruth pixel_truth(const SceneGeometry& scene, const IdBuffer& ids) {
  const cv::Size size = ids.primitive.size();
  PixelTruth truth{cv::Mat(size, CV_32SC1, cv::Scalar(0)), cv::Mat(size, CV_32FC1, cv::Scalar(kNothing_m)),
                   cv::Mat(size, CV_32FC3, cv::Scalar::all(0.0))};
  const Eigen::Matrix3d turn = ids.view.camera_from_world.linear();
  const PixelRays lines(ids.view);
  for (int v = 0; v < size.height; ++v) {
    const int* primitives = ids.primitive.ptr<int>(v);
    auto* surfaces = truth.surface.ptr<int>(v);
    auto* ranges_m = truth.range_m.ptr<float>(v);
    auto* normals = truth.normal.ptr<cv::Vec3f>(v);
    for (int u = 0; u < size.width; ++u) {
      const int primitive = primitives[u];
      if (primitive == kNoPrimitive) continue;
      const Ray line = lines(u, v);
      const SceneGeometry::Seen seen = scene.seen(primitive, line);
      const Eigen::Vector3d normal = scene.normal(primitive, seen.on_primitive);
      surfaces[u] = scene.surface(primitive);
      ranges_m[u] = static_cast<float>((seen.on_ray - line.origin_m).norm());
      normals[u] = vec(turn * (normal.dot(line.direction) > 0.0 ? -normal : normal));
    }
  }
  return truth;
}

}  // namespace stereobench::renderer
