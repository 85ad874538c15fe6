#include "vision/rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace stereobench::vision {
namespace {

constexpr double kArcLength_px = 3.0;
constexpr double kRingWidth_px = 2.0;
constexpr double kNoBall_px = 1.71;  // outside of an outline that may yet move by a pixel
constexpr double kPi = 3.14159265358979323846;

// Angle in turns, [0, 1), to 0.001 turns: arithmetic only, so that every machine agrees on it.
double turns(const Eigen::Vector2d& direction) {
  const double ax = std::abs(direction.x());
  const double ay = std::abs(direction.y());
  if (ax + ay == 0.0) return 0.0;
  const double z = std::min(ax, ay) / std::max(ax, ay);
  double angle = z * (0.125 + 0.0434 * (1.0 - z));  // first octant
  if (ay > ax) angle = 0.25 - angle;
  if (direction.x() < 0.0) angle = 0.5 - angle;
  if (direction.y() < 0.0) angle = 1.0 - angle;
  return angle >= 1.0 ? 0.0 : angle;
}

// Which of so many arcs a direction from the centre lies in.
std::size_t arc_towards(const Eigen::Vector2d& direction, std::size_t arcs) {
  return static_cast<std::size_t>(turns(direction) * static_cast<double>(arcs));
}

}  // namespace

Eigen::Matrix3d BackgroundSums::scatter() const {
  Eigen::Matrix3d sums;
  sums << squares[0], crosses[0], crosses[2],  //
      crosses[0], squares[1], crosses[1],      //
      crosses[2], crosses[1], squares[2];
  return sums - colour * colour.transpose() / count;
}

Rim collect_rim(const cv::Mat& image, const OutlineModel& outline, double gap_px,
                const std::optional<Shading>& shading) {
  Rim rim;
  rim.has_shades = shading.has_value();
  rim.arcs.resize(
      static_cast<std::size_t>(std::clamp(2.0 * kPi * outline.radius_px() / kArcLength_px, 9.0, 96.0)));
  const double near_px = std::max(gap_px, kCrossed_px);
  const double reach_px = gap_px + kRingWidth_px;
  const double relative_reach = reach_px / outline.semi_minor_px();
  const double extent = outline.semi_major_px() * (1.0 + relative_reach);
  const Eigen::Vector2d centre = outline.centre_px();
  rim.pixels.reserve(static_cast<std::size_t>(4.0 * kPi * near_px * (outline.semi_major_px() + near_px)));
  const int first_y = std::max(0, static_cast<int>(std::ceil(centre.y() - extent)));
  const int last_y = std::min(image.rows - 1, static_cast<int>(std::floor(centre.y() + extent)));
  for (int y = first_y; y <= last_y; ++y) {
    const auto* row = image.ptr<std::uint8_t>(y);
    const ColumnSpan outer = outline.columns_within(1.0 + relative_reach, y);
    const ColumnSpan inner = outline.columns_within(1.0 - relative_reach, y);
    const int last_x = std::min(image.cols - 1, outer.last);
    for (int x = std::max(0, outer.first); x <= last_x; ++x) {
      if (x == inner.first && inner.last > x) x = inner.last;  // the middle of the ball is not the rim
      const Eigen::Vector2d position(x, y);
      const double distance = outline.rim_point(position).distance_px;
      if (x > last_x || !(std::abs(distance) <= reach_px)) continue;
      const std::uint8_t* bytes = row + 3 * x;
      const Eigen::Vector3d bgr(bytes[0], bytes[1], bytes[2]);
      const std::size_t sector = arc_towards(position - centre, rim.arcs.size());
      RimArc& arc = rim.arcs[sector];
      if (distance >= gap_px) arc.outside.add(bgr);
      if (distance >= near_px) continue;
      const Eigen::Vector3d shade =
          shading && distance < kNoBall_px ? shading->at(position) : Eigen::Vector3d::Zero();
      if (distance < gap_px) (distance <= -gap_px ? arc.inside : arc.crossed).add(bgr, shade);
      if (distance > -near_px) rim.pixels.push_back({position, bgr, shade, distance, sector});
    }
  }
  return rim;
}

}  // namespace stereobench::vision
