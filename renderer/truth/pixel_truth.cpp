#include "renderer/truth/pixel_truth.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "renderer/truth/flat_row.h"

namespace stereobench::renderer {
namespace {

constexpr float kNothing_m = std::numeric_limits<float>::infinity();

cv::Vec3f vec(const Eigen::Vector3d& v) {
  const Eigen::Vector3f narrow = v.cast<float>();
  return {narrow.x(), narrow.y(), narrow.z()};
}

/// One row of a picture's truth.
struct TruthRow {
  int* surfaces;
  float* ranges_m;
  cv::Vec3f* normals;
};

template <class Rays>
class PixelLooker {
 public:
  PixelLooker(const SceneGeometry& scene, const CameraView& view)
      : scene_(scene), camera_(view), lines_(view) {}

  /// Looks at the pixels of a row that see one primitive.
  void look(int primitive, int v, int begin, int end, const TruthRow& row) const {
    if (primitive == kNoPrimitive) return;
    std::fill(row.surfaces + begin, row.surfaces + end, scene_.surface(primitive));
    if (is_ball(primitive)) return look_at_ball(primitive, v, begin, end, row);
    cv::Range swept(begin, begin);
    if constexpr (std::is_same_v<Rays, PinholeRays>) swept = sweep_flat(primitive, v, {begin, end}, row);
    if (swept.start > begin) look_at_flat(primitive, v, begin, swept.start, row);
    if (swept.end < end) look_at_flat(primitive, v, swept.end, end, row);
  }

 private:
  void look_at_ball(int primitive, int v, int begin, int end, const TruthRow& row) const {
    for (int u = begin; u < end; ++u) {
      const Ray line = lines_(u, v);
      const SceneGeometry::Seen seen = scene_.seen(primitive, line);
      const Eigen::Vector3d normal = scene_.normal(primitive, seen.on_primitive);
      row.ranges_m[u] = static_cast<float>((seen.on_ray - line.origin_m).norm());
      row.normals[u] = vec(camera_.turn * (normal.dot(line.direction) > 0.0 ? -normal : normal));
    }
  }

  /// Looks at all that meet the primitive, in the same steps. @return which these are
  cv::Range sweep_flat(int primitive, int v, const cv::Range& columns, const TruthRow& row) const {
    const SceneGeometry::FlatRow flat(scene_, primitive, camera_, v);
    const cv::Range met = flat.columns_on_it(columns);
    if (met.empty()) return met;
    const vision::Intrinsics& pinhole = camera_.intrinsics;
    const AlongRow x(Eigen::Vector3d::UnitX(), pinhole, v), inverse_depth = flat.inverse_depth();
    const double y = (v - pinhole.cy_px) / pinhole.focal_px, rest = y * y + 1.0;
    for (int u = met.start; u < met.end; ++u)
      row.ranges_m[u] = static_cast<float>(std::sqrt(x(u) * x(u) + rest) / inverse_depth(u));
    const Eigen::Vector3d normal = scene_.normal(primitive, {});
    const bool is_front = normal.dot(lines_(met.start, v).direction) <= 0.0;
    std::fill(row.normals + met.start, row.normals + met.end,
              vec(camera_.turn * (is_front ? normal : -normal)));
    return met;
  }

  void look_at_flat(int primitive, int v, int begin, int end, const TruthRow& row) const {
    const SceneGeometry::FlatLook look(scene_, primitive, camera_.centre_m);
    const Eigen::Vector3d normal = look.normal();
    const cv::Vec3f one_way = vec(camera_.turn * normal), other_way = vec(camera_.turn * -normal);
    for (int u = begin; u < end; ++u) {
      const Ray line = lines_(u, v);
      row.ranges_m[u] = static_cast<float>((look.seen(line).on_ray - line.origin_m).norm());
      row.normals[u] = normal.dot(line.direction) > 0.0 ? other_way : one_way;
    }
  }

  const SceneGeometry& scene_;
  PinholeLook camera_;
  Rays lines_;
};

template <class Rays>
void look_at_all(const SceneGeometry& scene, const IdBuffer& ids, PixelTruth& truth) {
  const PixelLooker<Rays> looker(scene, ids.view);
  for (int v = 0; v < ids.primitive.rows; ++v) {
    const TruthRow row = {truth.surface.ptr<int>(v), truth.range_m.ptr<float>(v),
                          truth.normal.ptr<cv::Vec3f>(v)};
    for_runs(ids.primitive.ptr<int>(v), ids.primitive.cols,
             [&](int primitive, int begin, int end) { looker.look(primitive, v, begin, end, row); });
  }
}

}  // namespace

PixelTruth pixel_truth(const SceneGeometry& scene, const IdBuffer& ids) {
  const cv::Size size = ids.primitive.size();
  PixelTruth truth{cv::Mat(size, CV_32SC1, cv::Scalar(0)), cv::Mat(size, CV_32FC1, cv::Scalar(kNothing_m)),
                   cv::Mat(size, CV_32FC3, cv::Scalar::all(0.0))};
  if (is_straight(ids.view))
    look_at_all<PinholeRays>(scene, ids, truth);
  else
    look_at_all<PixelRays>(scene, ids, truth);
  return truth;
}

}  // namespace stereobench::renderer
