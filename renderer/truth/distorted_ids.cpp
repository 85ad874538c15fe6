#include "renderer/truth/distorted_ids.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vision/camera/rig.h"

namespace stereobench::renderer {
namespace {

/// How far a ray goes at most to what pixels around its place see.
double farthest_m(const SceneGeometry& scene, const std::array<int, 4>& around, const Ray& ray) {
  constexpr double kRoom = 1.01;  // for slivers that are farther than what is beside them
  double farthest = 0.0;
  for (const int primitive : around) {
    if (primitive == kNoPrimitive) return std::numeric_limits<double>::infinity();
    const Eigen::Vector3d way = scene.seen(primitive, ray).on_ray - ray.origin_m;
    farthest = std::max(farthest, way.dot(ray.direction) / ray.direction.squaredNorm());
  }
  return kRoom * farthest;
}

/// The primitive that a ray meets first. Where it meets none it looks into the open, or through a crack that
/// the rasteriser has closed by snapping corners. Primitives thinner than a pixel may be seen by none of four
/// pixels.
/// @param around the primitives of pixels around its place
/// @param nearest that of the nearest one
int first_met(const SceneGeometry& scene, const std::array<int, 4>& around, int nearest, const Ray& ray) {
  if (std::all_of(around.begin(), around.end(), [&](int primitive) { return primitive == nearest; }))
    return nearest;
  int first = kNoPrimitive;
  double first_m = std::numeric_limits<double>::infinity();
  for (const int primitive : around) {
    const double there_m = primitive == kNoPrimitive ? first_m : scene.enter(primitive, ray);
    if (!(there_m < first_m)) continue;
    first = primitive;
    first_m = there_m;
  }
  if (first == kNoPrimitive) first_m = farthest_m(scene, around, ray);
  if (const int flat = scene.first_flat(ray, kNear_m, first_m); flat != kNoPrimitive) return flat;
  const bool is_open = std::find(around.begin(), around.end(), kNoPrimitive) != around.end();
  return first == kNoPrimitive && !is_open ? nearest : first;
}

int nearest_of(const cv::Mat& primitives, const Eigen::Vector2d& place_px) {
  const int u = std::clamp(static_cast<int>(std::lround(place_px.x())), 0, primitives.cols - 1);
  const int v = std::clamp(static_cast<int>(std::lround(place_px.y())), 0, primitives.rows - 1);
  return primitives.at<int>(v, u);
}

}  // namespace

IdBuffer distorted_ids(const SceneGeometry& scene, const IdBuffer& undistorted,
                       const vision::StereoRig& rig) {
  IdBuffer distorted{undistorted.view, cv::Mat(rig.intrinsics.height_px, rig.intrinsics.width_px, CV_32SC1)};
  distorted.view.intrinsics = rig.intrinsics;
  distorted.view.lens = rig.distortion;
  const PixelRays lines(distorted.view);
  const Eigen::Matrix3d turn = distorted.view.camera_from_world.linear();
  for (int v = 0; v < distorted.primitive.rows; ++v) {
    for (int u = 0; u < distorted.primitive.cols; ++u) {
      const Ray line = lines(u, v);
      const Eigen::Vector2d place = vision::project(undistorted.view.intrinsics, turn * line.direction);
      distorted.primitive.at<int>(v, u) = first_met(scene, primitives_around(undistorted.primitive, place),
                                                    nearest_of(undistorted.primitive, place), line);
    }
  }
  return distorted;
}

}  // namespace stereobench::renderer
