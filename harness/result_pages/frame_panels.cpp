#include "harness/result_pages/frame_panels.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/vision_scoring/detection_outcome.h"
#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "vision/camera/distortion.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

constexpr int kCorners = 36;

bool is(const DetectionRow& row, DetectionOutcome outcome) {
  return row.outcome == text_of(outcome);
}

Fate fate_of_detection(const DetectionRow& row) {
  if (is(row, DetectionOutcome::kTruePositive)) return Fate::kFound;
  if (is(row, DetectionOutcome::kWrongIdentity)) return Fate::kWrong;
  return is(row, DetectionOutcome::kFalsePositive) ? Fate::kFalse : Fate::kOther;
}

std::string label_of_detection(const DetectionRow& row) {
  const std::string colour = row.detected_colour ? fmt::format("{}", *row.detected_colour) : "?";
  if (is(row, DetectionOutcome::kTruePositive))
    return fmt::format("{} mm", format_number(1e3 * row.range_error_m()));
  if (is(row, DetectionOutcome::kWrongIdentity)) return "taken for " + colour;
  std::string outcome = row.outcome;
  std::ranges::replace(outcome, '_', ' ');
  return outcome;
}

/// The truth of a ball in one camera, and what became of it in the pair.
struct BallInPicture {
  const DetectionRow* row = nullptr;
  bool is_found = false;
  bool is_wrong = false;
};

std::map<int, BallInPicture> balls_in(std::span<const DetectionRow> rows) {
  std::map<int, BallInPicture> balls;
  for (const DetectionRow& row : rows) {
    if (!row.ball) continue;
    BallInPicture& ball = balls[*row.ball];
    ball.row = &row;
    ball.is_found = ball.is_found || is(row, DetectionOutcome::kTruePositive);
    ball.is_wrong = ball.is_wrong || is(row, DetectionOutcome::kWrongIdentity);
  }
  return balls;
}

Fate fate_of_ball(const BallInPicture& ball) {
  if (ball.is_wrong) return Fate::kWrong;
  if (ball.is_found) return Fate::kFound;
  return ball.row->is_required ? Fate::kMissed : Fate::kOther;
}

std::string label_of_ball(const DetectionRow& row) {
  const std::string colour = row.colour ? fmt::format("{}", *row.colour) : "?";
  return fmt::format("colour {}, {} m", colour, format_number(row.true_range_m));
}

}  // namespace

Eigen::Vector2d taken_px(const vision::StereoRig& rig, const Eigen::Vector2d& undistorted_px) {
  return vision::image_point(rig, vision::pixel_ray(rig.intrinsics, undistorted_px));
}

std::vector<Eigen::Vector2d> outline_px(const vision::StereoRig& rig, const Eigen::Vector2d& centre_px,
                                        double radius_px) {
  const vision::Intrinsics& camera = rig.intrinsics;
  const Eigen::Vector2d off_axis = centre_px - Eigen::Vector2d(camera.cx_px, camera.cy_px);
  const double distance_px = off_axis.norm();
  const Eigen::Vector2d along =
      distance_px > 0.0 ? Eigen::Vector2d(off_axis / distance_px) : Eigen::Vector2d::UnitX();
  const Eigen::Vector2d across(-along.y(), along.x());
  // The half axes are as 1 to cos, the cosine of the angle between the ball and the optical axis.
  const double ray = Eigen::Vector2d(distance_px, camera.focal_px).norm();
  const double root_of_cosine = std::sqrt(camera.focal_px / ray);
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kCorners; ++i) {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * i / kCorners);
    const Eigen::Vector2d corner =
        centre_px + radius_px * (c / root_of_cosine * along + s * root_of_cosine * across);
    corners.push_back(taken_px(rig, corner));
  }
  return corners;
}

FramePanel panel_of(std::span<const DetectionRow> rows, const vision::StereoRig& rig, vision::Side side) {
  const bool is_left = side == vision::Side::kLeft;
  FramePanel panel{.title = is_left ? "left camera" : "right camera"};
  for (const auto& [index, ball] : balls_in(rows)) {
    const DetectionRow& row = *ball.row;
    const Eigen::Vector2d& centre_px = is_left ? row.true_left_px : row.true_right_px;
    panel.truth.push_back(
        {outline_px(rig, centre_px, row.true_radius_px), label_of_ball(row), fate_of_ball(ball)});
  }
  for (const DetectionRow& row : rows) {
    const Eigen::Vector2d& centre_px = is_left ? row.left_px : row.right_px;
    if (!centre_px.allFinite()) continue;
    panel.detections.push_back({taken_px(rig, centre_px), label_of_detection(row), fate_of_detection(row)});
  }
  return panel;
}

std::string faults_of(std::span<const DetectionRow> rows) {
  std::string text;
  const auto count = [&](const char* outcome, const char* what) {
    if (const auto number = std::ranges::count(rows, outcome, &DetectionRow::outcome); number > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, what);
  };
  count(kMiss, "missed");
  count(text_of(DetectionOutcome::kWrongIdentity), "misidentified");
  count(text_of(DetectionOutcome::kFalsePositive), "of no ball");
  count(text_of(DetectionOutcome::kDuplicate), "repeated");
  return text;
}

std::vector<DetectionRow> rows_of(std::span<const DetectionRow> rows, std::uint64_t seed, std::size_t frame) {
  std::vector<DetectionRow> found;
  std::ranges::copy_if(rows, std::back_inserter(found),
                       [&](const DetectionRow& row) { return row.seed == seed && row.frame == frame; });
  return found;
}

}  // namespace stereobench::harness
