#include "harness/scoring/vision_score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "slam/motion.h"
#include "vision/rig.h"
#include "vision/sphere.h"

namespace stereobench::harness {

namespace {

using vision::Eye;
using vision::OutlineEllipse;

constexpr double kSmallestRadius_px = 3.0;
constexpr double kVisibleFraction = 0.95;

/// A ball as both eyes would see it with nothing in its way.
struct BallOutline {
  int ball = 0;
  Eigen::Vector3d centre_in_robot = Eigen::Vector3d::Zero();
  OutlineEllipse left;
  OutlineEllipse right;
};

Eigen::Vector3d in_robot(const slam::Pose& world_from_robot, const Eigen::Vector3d& point_in_world) {
  const double dx = point_in_world.x() - world_from_robot.x_m;
  const double dy = point_in_world.y() - world_from_robot.y_m;
  const double c = std::cos(world_from_robot.heading_rad);
  const double s = std::sin(world_from_robot.heading_rad);
  return {c * dx + s * dy, c * dy - s * dx, point_in_world.z()};
}

std::vector<BallOutline> outlines(const VisionTruth& truth) {
  const Eigen::Isometry3d camera_from_robot = vision::robot_from_camera(truth.rig).inverse();
  std::vector<BallOutline> result;
  for (std::size_t i = 0; i < truth.world.balls.size(); ++i) {
    const worlds::Ball& ball = truth.world.balls[i];
    const Eigen::Vector3d ball_in_robot = in_robot(truth.world_from_robot, ball.centre_m);
    const Eigen::Vector3d in_left = camera_from_robot * ball_in_robot;
    const Eigen::Vector3d in_right = vision::point_in_eye(truth.rig, in_left, Eye::kRight);
    const auto left = vision::sphere_outline(truth.rig.camera, in_left, ball.radius_m);
    const auto right = vision::sphere_outline(truth.rig.camera, in_right, ball.radius_m);
    if (left && right) result.push_back({static_cast<int>(i), ball_in_robot, *left, *right});
  }
  return result;
}

/// Half the width (axis 0) or height (axis 1) of an ellipse's bounding box.
double half_extent_px(const OutlineEllipse& ellipse, int axis) {
  const double c = std::cos(ellipse.angle_rad);
  const double s = std::sin(ellipse.angle_rad);
  return axis == 0 ? std::hypot(ellipse.semi_major_px * c, ellipse.semi_minor_px * s)
                   : std::hypot(ellipse.semi_major_px * s, ellipse.semi_minor_px * c);
}

/// Whether an outline lies within the area of the image's pixels.
bool lies_inside(const vision::Intrinsics& camera, const OutlineEllipse& ellipse) {
  const Eigen::Vector2d half(half_extent_px(ellipse, 0), half_extent_px(ellipse, 1));
  const Eigen::Vector2d low = ellipse.centre_px - half;
  const Eigen::Vector2d high = ellipse.centre_px + half;
  return low.minCoeff() >= -0.5 && high.x() <= camera.width_px - 0.5 && high.y() <= camera.height_px - 0.5;
}

bool contains(const OutlineEllipse& ellipse, const Eigen::Vector2d& pixel_px) {
  const Eigen::Vector2d offset = pixel_px - ellipse.centre_px;
  const double c = std::cos(ellipse.angle_rad);
  const double s = std::sin(ellipse.angle_rad);
  const double along = (c * offset.x() + s * offset.y()) / ellipse.semi_major_px;
  const double across = (c * offset.y() - s * offset.x()) / ellipse.semi_minor_px;
  return along * along + across * across <= 1.0;
}

double whole_area_px(const OutlineEllipse& ellipse) {
  return std::numbers::pi * ellipse.semi_major_px * ellipse.semi_minor_px;
}

/// Pixels of each identity; index 0 is no ball.
std::array<long, 256> count_ids(const cv::Mat& ball_id) {
  std::array<long, 256> counts{};
  for (int row = 0; row < ball_id.rows; ++row) {
    const auto* ids = ball_id.ptr<std::uint8_t>(row);
    for (int column = 0; column < ball_id.cols; ++column) ++counts[ids[column]];
  }
  return counts;
}

BallVisibility visibility(const VisionTruth& truth, const BallOutline& outline,
                          const std::array<long, 256>& left_ids, const std::array<long, 256>& right_ids) {
  const std::size_t id = static_cast<std::size_t>(outline.ball) + 1;
  BallVisibility seen;
  seen.ball = outline.ball;
  seen.left_fraction = static_cast<double>(left_ids.at(id)) / whole_area_px(outline.left);
  seen.right_fraction = static_cast<double>(right_ids.at(id)) / whole_area_px(outline.right);
  seen.smaller_radius_px = std::min(outline.left.radius_px(), outline.right.radius_px());
  seen.inside_both =
      lies_inside(truth.rig.camera, outline.left) && lies_inside(truth.rig.camera, outline.right);
  return seen;
}

std::vector<BallVisibility> visibilities(const VisionTruth& truth, const std::vector<BallOutline>& balls) {
  const std::array<long, 256> left_ids = count_ids(truth.frame.left.ball_id);
  const std::array<long, 256> right_ids = count_ids(truth.frame.right.ball_id);
  std::vector<BallVisibility> result;
  for (const BallOutline& ball : balls) result.push_back(visibility(truth, ball, left_ids, right_ids));
  return result;
}

/// A ball has to be found when it is whole, not tiny and hardly hidden.
bool must_be_found(const BallVisibility& seen) {
  return seen.inside_both && seen.smaller_radius_px >= kSmallestRadius_px &&
         std::min(seen.left_fraction, seen.right_fraction) >= kVisibleFraction;
}

/// The ball under an observation: one of its colour if there is one, else any that is not wholly hidden.
std::optional<std::size_t> ball_under(const VisionTruth& truth, const std::vector<BallOutline>& balls,
                                      const std::vector<BallVisibility>& seen,
                                      const vision::BallObservation& observation) {
  std::optional<std::size_t> under;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const bool hidden = seen[i].left_fraction <= 0.0 || seen[i].right_fraction <= 0.0;
    if (hidden || !contains(balls[i].left, observation.left_px)) continue;
    if (!contains(balls[i].right, observation.right_px)) continue;
    const std::size_t ball = static_cast<std::size_t>(balls[i].ball);
    if (truth.world.balls[ball].colour == observation.colour) return i;
    if (!under) under = i;
  }
  return under;
}

void add_errors(const BallOutline& ball, const vision::BallObservation& observation, VisionScore& score) {
  const Eigen::Vector2d true_position = ball.centre_in_robot.head<2>();
  const slam::RangeBearing& measured = observation.range_bearing;
  const double true_bearing_rad = std::atan2(true_position.y(), true_position.x());
  const Eigen::Vector2d error(measured.range_m - true_position.norm(),
                              slam::wrap_angle(measured.bearing_rad - true_bearing_rad));
  score.range_errors_m.push_back(error.x());
  score.bearing_errors_rad.push_back(error.y());
  const double disparity_px = observation.left_px.x() - observation.right_px.x();
  score.disparity_errors_px.push_back(disparity_px - (ball.left.centre_px.x() - ball.right.centre_px.x()));
  const double squared = error.dot(measured.covariance.inverse() * error);
  if (std::isfinite(squared)) score.normalised_errors.push_back(squared / 2.0);
}

double sorted_sum(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

/// Summed in order of size, so that it does not depend on the order in which scores were merged.
double mean(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return sorted_sum(values) / static_cast<double>(values.size());
}

double rms(const std::vector<double>& errors) {
  std::vector<double> squares;
  for (const double error : errors) squares.push_back(error * error);
  return std::sqrt(mean(squares));
}

double ratio(long part, long whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(part) / static_cast<double>(whole);
}

void append(std::vector<double>& values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

double VisionScore::recall() const {
  return ratio(found, visible);
}
double VisionScore::precision() const {
  return ratio(right, observations);
}
double VisionScore::range_rms_m() const {
  return rms(range_errors_m);
}
double VisionScore::bearing_rms_rad() const {
  return rms(bearing_errors_rad);
}
double VisionScore::disparity_rms_px() const {
  return rms(disparity_errors_px);
}
double VisionScore::mean_normalised_error() const {
  return mean(normalised_errors);
}

VisionScore& VisionScore::operator+=(const VisionScore& other) {
  visible += other.visible;
  found += other.found;
  observations += other.observations;
  right += other.right;
  misidentified += other.misidentified;
  spurious += other.spurious;
  repeated += other.repeated;
  flagged += other.flagged;
  append(range_errors_m, other.range_errors_m);
  append(bearing_errors_rad, other.bearing_errors_rad);
  append(disparity_errors_px, other.disparity_errors_px);
  append(normalised_errors, other.normalised_errors);
  return *this;
}

std::vector<BallVisibility> ball_visibility(const VisionTruth& truth) {
  return visibilities(truth, outlines(truth));
}

VisionScore score_observations(const VisionTruth& truth,
                               std::span<const vision::BallObservation> observations) {
  const std::vector<BallOutline> balls = outlines(truth);
  const std::vector<BallVisibility> seen = visibilities(truth, balls);
  std::vector<bool> found(balls.size(), false);
  VisionScore score;
  for (const vision::BallObservation& observation : observations) {
    if (!observation.whole()) {
      ++score.flagged;
      continue;
    }
    ++score.observations;
    const auto under = ball_under(truth, balls, seen, observation);
    const bool same_colour =
        under && truth.world.balls[static_cast<std::size_t>(balls[*under].ball)].colour == observation.colour;
    if (!under) {
      ++score.spurious;
    } else if (!same_colour) {
      ++score.misidentified;
    } else if (found[*under]) {
      ++score.repeated;
    } else {
      found[*under] = true;
      ++score.right;
      add_errors(balls[*under], observation, score);
    }
  }
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!must_be_found(seen[i])) continue;
    ++score.visible;
    score.found += found[i] ? 1 : 0;
  }
  return score;
}

}  // namespace stereobench::harness
