#include "harness/drive/picture_motion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/camera/camera_view.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

constexpr int kGrid_px = 8;
constexpr double kFar_m = 1e6;          // of the sky
constexpr double kMoment = 1.0 / 64.0;  // share of the exposure over which a speed is measured

/// A point that a pixel shows.
struct SeenPoint {
  Eigen::Vector3d in_camera;
  Eigen::Vector2d place_px;
};

std::vector<SeenPoint> seen_points(const renderer::RenderedImage& frame, const renderer::CameraView& view) {
  std::vector<SeenPoint> points;
  for (int v = 0; v < frame.depth_m.rows; v += kGrid_px)
    for (int u = 0; u < frame.depth_m.cols; u += kGrid_px) {
      const double depth_m = std::min(kFar_m, double{frame.depth_m.at<float>(v, u)});
      const Eigen::Vector2d place(u, v);
      points.push_back({depth_m * renderer::line_of_sight(view, place), place});
    }
  return points;
}

renderer::CameraView view_at(const vision::StereoRig& rig, vision::Side side, const slam::Pose& pose) {
  renderer::CameraView view = renderer::camera_view(rig, side, pose);
  view.lens = rig.distortion;
  return view;
}

/// The longest way of points that one camera sees, from where it is to a place nearby.
double longest_way_to(const std::vector<SeenPoint>& points, const renderer::CameraView& here,
                      const renderer::CameraView& there) {
  if (there.camera_from_world.matrix() == here.camera_from_world.matrix()) return 0.0;
  const Eigen::Isometry3d moved = there.camera_from_world * here.camera_from_world.inverse();
  double longest_px = 0.0;
  for (const SeenPoint& point : points) {
    const Eigen::Vector3d in_camera = moved * point.in_camera;
    if (!(in_camera.z() > renderer::kNear_m)) continue;
    longest_px = std::max(longest_px, (renderer::shown_at(there, in_camera) - point.place_px).norm());
  }
  return longest_px;
}

}  // namespace

double longest_way_px(const renderer::StereoFrame& middle, const vision::StereoRig& rig,
                      const Exposure& exposure) {
  const double moment_s = kMoment * exposure.open_s;
  double longest_px = 0.0;
  for (const vision::Side side : {vision::Side::kLeft, vision::Side::kRight}) {
    const bool is_left = side == vision::Side::kLeft;
    const double delay_s = is_left ? 0.0 : exposure.right_delay_s;
    const auto view = [&](double offset_s) {
      const double at_s = exposure.middle_s + delay_s + offset_s;
      return view_at(rig, side, worlds::pose_near(exposure.path, exposure.index, at_s));
    };
    const std::vector<SeenPoint> points = seen_points(is_left ? middle.left : middle.right, view(0.0));
    for (const double share : {-0.5, 0.0, 0.5})
      for (const double onwards_s : {-moment_s, moment_s}) {  // it may set off or stop at that time
        if (share * onwards_s > 0.0) continue;                // no longer open
        const double offset_s = share * exposure.open_s;
        longest_px = std::max(longest_px, longest_way_to(points, view(offset_s), view(offset_s + onwards_s)));
      }
  }
  return longest_px / kMoment;
}

}  // namespace stereobench::harness
