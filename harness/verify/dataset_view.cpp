#include "harness/verify/dataset_view.h"

#include <algorithm>
#include <cmath>

#include "vision/camera/distortion.h"

namespace stereobench::harness {

const ChannelFile* find_channel(const ViewFrame& frame, vision::Side side, Channel channel) {
  const auto& channels = frame.channels[index_of(side)];
  const auto found = channels.find(channel);
  return found == channels.end() ? nullptr : &found->second;
}

std::optional<Eigen::Vector3d> ray_of(const ViewCamera& camera, const Eigen::Vector2d& pixel_px) {
  const vision::Intrinsics& pinhole = camera.pinhole;
  const Eigen::Vector2d place = (pixel_px - Eigen::Vector2d(pinhole.cx_px, pinhole.cy_px)) / pinhole.focal_px;
  const std::optional<Eigen::Vector2d> direction = vision::undistort(camera.lens, place);
  if (!direction) return std::nullopt;
  return Eigen::Vector3d(direction->x(), direction->y(), 1.0);
}

double depth_beside(const ViewCamera& camera, const cv::Mat& depth_m, const cv::Point& pixel) {
  if (camera.lens == vision::Distortion{}) return 0.0;
  constexpr double kBeside_px = 0.5;
  const cv::Rect area({}, depth_m.size());
  const double here_m = depth_m.at<float>(pixel);
  const auto slope_m = [&](const cv::Point& step) {
    double most_m = 0.0;
    for (const cv::Point& next : {pixel - step, pixel + step}) {
      const double there_m = area.contains(next) ? double{depth_m.at<float>(next)} : here_m;
      if (std::isfinite(there_m)) most_m = std::max(most_m, std::abs(there_m - here_m));
    }
    return most_m;
  };
  return kBeside_px * (slope_m({1, 0}) + slope_m({0, 1})) / here_m;
}

std::optional<Eigen::Vector2d> pixel_of(const ViewCamera& camera, const Eigen::Vector3d& point_m) {
  if (!(point_m.z() > 0.0)) return std::nullopt;
  const vision::Intrinsics& pinhole = camera.pinhole;
  const Eigen::Vector2d direction = point_m.head<2>() / point_m.z();
  return pinhole.focal_px * vision::distort(camera.lens, direction) +
         Eigen::Vector2d(pinhole.cx_px, pinhole.cy_px);
}

}  // namespace stereobench::harness
