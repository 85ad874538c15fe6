#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <fmt/format.h>

#include "harness/verify/checks/checks.h"
#include "harness/verify/geometry/corner_match.h"
#include "harness/verify/geometry/link_statistics.h"

namespace stereobench::harness {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using vision::Side;

/// A pixel's point now and at the next instant, in the left camera's frame.
struct MovedPoint {
  Vector3d now_m, next_m;
  Vector3d next_px;  ///< where files say that it is: column, row, disparity
};

/// Two pictures of one rectified pair.
struct Pair {
  double focal_px = 0.0, cx_px = 0.0, cy_px = 0.0;
  double baseline_m = 0.0;
  double shift_px = 0.0;  ///< of the right principal point against the left one

  std::optional<Vector3d> point(double u, double v, double disparity_px) const {
    const double parallax_px = disparity_px + shift_px;
    if (!std::isfinite(parallax_px) || !(parallax_px > 0.0)) return std::nullopt;
    const double z_m = focal_px * baseline_m / parallax_px;
    return Vector3d(z_m * (u - cx_px) / focal_px, z_m * (v - cy_px) / focal_px, z_m);
  }
  Vector3d pixel(const Vector3d& point_m) const {
    return {cx_px + focal_px * point_m.x() / point_m.z(), cy_px + focal_px * point_m.y() / point_m.z(),
            focal_px * baseline_m / point_m.z() - shift_px};
  }
};

Pair pair_of(const ViewFrame& frame) {
  const vision::Intrinsics &left = frame.cameras[0].pinhole, &right = frame.cameras[1].pinhole;
  const double baseline_m =
      (frame.cameras[0].body_from_camera.inverse() * frame.cameras[1].body_from_camera).translation().x();
  return {left.focal_px, left.cx_px, left.cy_px, baseline_m, right.cx_px - left.cx_px};
}

std::vector<MovedPoint> moved_points(const Pair& pair, const LoadedFrame& loaded) {
  constexpr int kStride = 5;
  std::vector<MovedPoint> points;
  const cv::Mat &now = loaded.disparity_px[0], &next = loaded.next_disparity_px, &flow = loaded.flow_px[0];
  for (int v = 0; v < now.rows; v += kStride)
    for (int u = 0; u < now.cols; u += kStride) {
      const cv::Vec2f shift = flow.at<cv::Vec2f>(v, u);
      const Vector3d next_px(u + double{shift[0]}, v + double{shift[1]}, next.at<float>(v, u));
      const auto now_m = pair.point(u, v, now.at<float>(v, u));
      const auto next_m = pair.point(next_px.x(), next_px.y(), next_px.z());
      if (now_m && next_m && next_px.allFinite()) points.push_back({*now_m, *next_m, next_px});
    }
  return points;
}

/// The motion that moves points best; near ones count for more, since their depth is known better.
Eigen::Isometry3d motion_of(const std::vector<MovedPoint>& points) {
  Vector3d from = Vector3d::Zero(), to = Vector3d::Zero();
  double whole = 0.0;
  const auto weight = [](const MovedPoint& point) {
    const double square = point.now_m.z() * point.now_m.z();
    return 1.0 / (square * square);
  };
  for (const MovedPoint& point : points) {
    from += weight(point) * point.now_m, to += weight(point) * point.next_m;
    whole += weight(point);
  }
  from /= whole, to /= whole;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const MovedPoint& point : points)
    spread += weight(point) * (point.next_m - to) * (point.now_m - from).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double handed = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = svd.matrixU() * Vector3d(1.0, 1.0, handed).asDiagonal() * svd.matrixV().transpose();
  motion.translation() = to - motion.linear() * from;
  return motion;
}

double off_px(const Pair& pair, const Eigen::Isometry3d& motion, const MovedPoint& point) {
  const Vector3d next_m = motion * point.now_m;
  return next_m.z() > 0.0 ? (pair.pixel(next_m) - point.next_px).norm() : kMostResidual_px;
}

/// How far points are off the rigid motion that most of them share, in the middle; things may move.
double off_rigid_motion_px(const Pair& pair, std::vector<MovedPoint> points) {
  constexpr int kRounds = 6;
  constexpr double kKept = 0.7;
  const std::vector<MovedPoint> all = points;
  std::vector<double> off;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::Isometry3d motion = motion_of(points);
    off.clear();
    for (const MovedPoint& point : all) off.push_back(off_px(pair, motion, point));
    const double limit_px = quantile(off, kKept);
    points.clear();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (off[i] <= limit_px) points.push_back(all[i]);
  }
  return median(off);
}

/// How far corners of the left picture are found off where flow, and the next disparity, lead to.
/// @return the middle of all, px; empty where too few are found
std::optional<double> off_second_picture_px(const LoadedFrame& loaded, Side side) {
  constexpr std::size_t kMostCorners = 240, kFewest = 20;
  constexpr int kAcross = 4, kDown = 6;
  const cv::Mat &flow = loaded.flow_px[0], &next = loaded.next_disparity_px;
  const cv::Mat& second = loaded.next_picture[index_of(side)];
  if (loaded.picture[0].empty() || flow.size() != loaded.picture[0].size() || second.size() != flow.size())
    return std::nullopt;
  if (side == Side::kRight && next.size() != flow.size()) return std::nullopt;
  const cv::Mat from = grey_levels(loaded.picture[0]), to = grey_levels(second);
  std::vector<double> off;
  for (const cv::Point& corner : corners_in(from, kMostCorners)) {
    const cv::Vec2f shift = flow.at<cv::Vec2f>(corner);
    const double back_px = side == Side::kRight ? double{next.at<float>(corner)} : 0.0;
    const Vector2d said(corner.x + double{shift[0]} - back_px, corner.y + double{shift[1]});
    const auto found = said.allFinite() ? found_in(from, corner, to, {from.cols / kAcross, from.rows / kDown})
                                        : std::nullopt;
    if (found) off.push_back((*found - said).norm());
  }
  return off.size() < kFewest ? std::nullopt : std::optional(median(off));
}

}  // namespace

std::vector<Fault> check_next_instant(const DatasetView& view, const LoadedFrame& loaded, Margins& margins) {
  constexpr std::size_t kFewest = 50;
  constexpr double kRigid_px = 0.5;  // levels of KITTI's files are 1/64 px
  std::vector<Fault> faults;
  const ViewFrame& frame = view.frames[loaded.index];
  if (loaded.flow_px[0].empty() || frame.drive_goes_on) return faults;  // poses and the next frame say more
  const std::string& file = find_channel(frame, Side::kLeft, Channel::kFlow)->file;
  const cv::Size size = loaded.flow_px[0].size();
  const Pair pair = pair_of(frame);
  if (loaded.disparity_px[0].size() == size && loaded.next_disparity_px.size() == size &&
      pair.focal_px > 0.0 && pair.baseline_m > 0.0) {
    const std::vector<MovedPoint> points = moved_points(pair, loaded);
    const double off = points.size() < kFewest ? 0.0 : off_rigid_motion_px(pair, points);
    if (margins.is_beyond("rigid motion of flow and disparities", off, kRigid_px))
      faults.push_back({file, frame.name,
                        fmt::format("flow and both disparities are of no rigid motion: {:.3g} px off in the "
                                    "middle of {} points",
                                    off, points.size())});
  }
  for (const Side side : {Side::kLeft, Side::kRight})
    if (const auto off = off_second_picture_px(loaded, side);
        off && margins.is_beyond("corners of the second pair", *off, kGross_px))
      faults.push_back({find_channel(frame, side, Channel::kNextPicture)->file, frame.name,
                        fmt::format("corners of the first picture are {:.3g} px off where {} leads to", *off,
                                    side == Side::kLeft ? file : "flow and the next disparity")});
  return faults;
}

std::vector<Fault> check_parts(const DatasetView& view, const LoadedFrame& loaded) {
  std::vector<Fault> faults;
  const ViewFrame& frame = view.frames[loaded.index];
  for (const auto& [part_file, whole_file] : frame.parts) {
    cv::Mat part, whole;
    try {
      whole = whole_file.read();
      part = part_file.read();
    } catch (const std::runtime_error& error) {
      faults.push_back({part_file.file, frame.name, error.what()});
      continue;
    }
    if (part.size() != whole.size()) {
      faults.push_back({part_file.file, frame.name, fmt::format("expected the size of {}", whole_file.file)});
      continue;
    }
    std::size_t other = 0;
    for (int v = 0; v < part.rows; ++v)
      for (int i = 0; i < part.cols * part.channels(); ++i) {
        const float value = part.ptr<float>(v)[i];
        if (std::isfinite(value) && value != whole.ptr<float>(v)[i]) ++other;
      }
    if (other > 0)
      faults.push_back(
          {part_file.file, frame.name,
           fmt::format("{} values are not those of {}, of which it is a part", other, whole_file.file)});
  }
  return faults;
}

}  // namespace stereobench::harness
