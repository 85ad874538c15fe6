#include "harness/vision_scoring/rig_check.h"

#include <cmath>

#include <fmt/format.h>

#include "slam/math/angles.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

constexpr double kOutline_px = 0.02;     // how well outlines are taken to be known
constexpr double kUnknownRadius = 1e12;  // variance of a disparity that no size is beside
constexpr double kUsualDisparity_px = 40.0;

struct Rows {
  double left_px = 0.0;
  double right_px = 0.0;
  double sd_px = 0.0;
};

Rows rows_of(const vision::Intrinsics& camera, const vision::RigBelief& belief) {
  const Eigen::Vector2d left(0.0, camera.cy_px), right(camera.width_px - 1.0, camera.cy_px);
  const double variance = std::max(belief.variances_px2(camera, left, kUsualDisparity_px).x(),
                                   belief.variances_px2(camera, right, kUsualDisparity_px).x());
  return {belief.rows_apart_px(camera, left), belief.rows_apart_px(camera, right), std::sqrt(variance)};
}

Eigen::Vector2d middle_of(const vision::Intrinsics& camera) {
  return {camera.cx_px, camera.cy_px};
}

double share_of(const vision::Intrinsics& camera, const vision::RigBelief& belief) {
  return belief.disparity_beyond_px(camera, middle_of(camera), kUsualDisparity_px) / kUsualDisparity_px;
}

vision::MeasuredOutline outline_at(const Eigen::Vector2d& centre_px, double radius_px) {
  vision::MeasuredOutline outline;
  outline.centre_px = centre_px;
  outline.radius_px = radius_px;
  return outline;
}

std::string rows_warning(const RigCheck& check, const vision::RigBelief& belief) {
  const Rows rows = rows_of(check.camera, belief);
  return fmt::format(
      "rows are {:.2f} px apart at the left, {:.2f} at the right: the right camera is turned by {:.3f} deg "
      "about "
      "x and {:.3f} deg about z beyond what is believed; calibrate the rig",
      rows.left_px, rows.right_px, slam::kDegreesPerRad * belief.fault[0],
      slam::kDegreesPerRad * belief.fault[2]);
}

std::string size_warning(const RigCheck& check, const vision::RigBelief& belief) {
  const double share = share_of(check.camera, belief);
  return fmt::format(
      "disparities of {:.0f} px are {:.1f} % {} than the sizes of balls say: the baseline is {:.4f} m in "
      "place "
      "of {:.4f}, and the right camera is turned by {:.3f} deg about y beyond what is believed, or balls are "
      "of another size, or lenses bend otherwise than believed, or the detector's radii are off; calibrate "
      "the "
      "rig where the radii can be trusted",
      kUsualDisparity_px, 100.0 * std::abs(share), share < 0.0 ? "smaller" : "larger",
      check.baseline_m * (1.0 + belief.fault[3]), check.baseline_m, slam::kDegreesPerRad * belief.fault[1]);
}

}  // namespace

RigCheck& RigCheck::operator+=(const RigCheck& other) {
  if (baseline_m <= 0.0) {
    camera = other.camera;
    baseline_m = other.baseline_m;
  }
  watch += other.watch;
  sized += other.sized;
  return *this;
}

RigCheck check_rig(const vision::StereoRig& believed, const vision::BallSize& size,
                   std::span<const vision::BallObservation> observations) {
  constexpr double kOfRows = 2.0 * kOutline_px * kOutline_px;
  RigCheck check{believed.intrinsics, believed.baseline_m};
  for (const vision::BallObservation& seen : observations) {
    if (!seen.trusted() || !seen.has_pixels) continue;
    const auto left_px = vision::rectified_point(believed, seen.left_px, vision::Side::kLeft);
    const auto right_px = vision::rectified_point(believed, seen.right_px, vision::Side::kRight);
    if (!left_px || !right_px) continue;
    vision::BallApart apart{*left_px, *right_px, kOfRows, left_px->x() - right_px->x(), kUnknownRadius};
    if (seen.has_radii && seen.left_radius_px > 0.0 && seen.right_radius_px > 0.0) {
      apart.disparity_by_size_px =
          vision::disparity_by_size_px(believed, outline_at(*left_px, seen.left_radius_px),
                                       outline_at(*right_px, seen.right_radius_px), size.radius_m);
      const double per_radius = apart.disparity_by_size_px / (seen.left_radius_px + seen.right_radius_px);
      const double made_px = apart.disparity_by_size_px * size.radius_sd_m / size.radius_m;
      apart.disparity_variance_px2 = kOfRows * (1.0 + per_radius * per_radius) + made_px * made_px;
      ++check.sized;
    }
    check.watch.add(believed.intrinsics, apart, {});
  }
  return check;
}

nlohmann::ordered_json rig_json(const RigCheck& check) {
  nlohmann::ordered_json json = {{"rows_off_px", {{"left", nullptr}, {"right", nullptr}, {"sd", nullptr}}},
                                 {"size_disagrees", {{"share", nullptr}, {"sd", nullptr}}}};
  if (check.watch.balls == 0) return json;
  const vision::RigBelief belief = check.watch.estimate();
  const Rows rows = rows_of(check.camera, belief);
  json["rows_off_px"] = {{"left", rows.left_px}, {"right", rows.right_px}, {"sd", rows.sd_px}};
  if (check.sized == 0) return json;
  const double variance = belief.variances_px2(check.camera, middle_of(check.camera), kUsualDisparity_px).y();
  json["size_disagrees"] = {{"share", share_of(check.camera, belief)},
                            {"sd", std::sqrt(variance) / kUsualDisparity_px}};
  return json;
}

std::vector<std::string> rig_warnings(const RigCheck& check) {
  std::vector<std::string> warnings;
  if (check.watch.balls == 0) return warnings;
  const vision::RigBelief belief = check.watch.belief(check.camera);
  if (belief.fault[0] != 0.0 || belief.fault[2] != 0.0) warnings.push_back(rows_warning(check, belief));
  if (belief.fault[1] != 0.0 || belief.fault[3] != 0.0) warnings.push_back(size_warning(check, belief));
  return warnings;
}

}  // namespace stereobench::harness
