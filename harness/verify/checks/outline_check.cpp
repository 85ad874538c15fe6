#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "harness/verify/checks/checks.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

/// The least and the greatest column and row of an outline, px.
struct Extent {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d most = -least;
};

/// Where a camera shows the outline of a sphere: the circle in which rays touch it.
/// @return empty where a part of it is behind the camera, or the camera is in the sphere
std::optional<Extent> outline_of(const ViewCamera& camera, const Eigen::Vector3d& centre_m, double radius_m) {
  constexpr int kPoints = 180;
  const double distance_m = centre_m.norm();
  if (!(distance_m > radius_m)) return std::nullopt;
  const double sine = radius_m / distance_m;
  const Eigen::Vector3d middle_m = (1.0 - sine * sine) * centre_m;
  const double circle_m = radius_m * std::sqrt(1.0 - sine * sine);
  const Eigen::Vector3d across = centre_m.unitOrthogonal(), along = centre_m.normalized().cross(across);
  Extent extent;
  for (int i = 0; i < kPoints; ++i) {
    const auto [sine_of, cosine_of] = slam::sine_cosine(2.0 * std::numbers::pi * i / kPoints);
    const auto pixel = pixel_of(camera, middle_m + circle_m * (cosine_of * across + sine_of * along));
    if (!pixel) return std::nullopt;
    extent.least = extent.least.cwiseMin(*pixel);
    extent.most = extent.most.cwiseMax(*pixel);
  }
  return extent;
}

}  // namespace

std::vector<Fault> check_outlines(const DatasetView& view, const ViewFrame& frame, Margins& margins) {
  constexpr double kBeside_px = 1.0;  // pixels of a lens are remapped, and circles have 180 points here
  std::vector<Fault> faults;
  if (view.rows_look_apart) return faults;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!frame.balls[side]) continue;
    for (const ViewBallTruth& said : frame.balls[side]->balls) {
      if (said.bbox_visib.empty() || said.ball < 0 || said.ball >= static_cast<int>(view.balls.size()))
        continue;
      const double radius_m = view.balls[static_cast<std::size_t>(said.ball)].radius_m;
      if (!(radius_m > 0.0)) continue;
      const auto outline = outline_of(frame.cameras[side], said.centre_in_camera_m, radius_m);
      if (!outline) continue;
      const cv::Rect& box = said.bbox_visib;
      const Eigen::Vector2d first(box.x, box.y), last(box.x + box.width - 1, box.y + box.height - 1);
      const double beyond_px =
          std::max((outline->least - first).maxCoeff(), (last - outline->most).maxCoeff());
      if (margins.is_beyond("box beyond an outline", beyond_px, kBeside_px + said.box_slack_px))
        faults.push_back(
            {frame.balls[side]->file, frame.name,
             fmt::format("ball {}: its {} bbox_visib [{}, {}, {}, {}] is {:.3g} px beyond the outline of a "
                         "ball at its centre_in_camera_m",
                         said.ball, side == 0 ? "left" : "right", box.x, box.y, box.width, box.height,
                         beyond_px)});
    }
  }
  return faults;
}

}  // namespace stereobench::harness
