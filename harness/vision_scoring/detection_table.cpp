#include "harness/vision_scoring/detection_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/vision_scoring/detection_outcome.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

using vision::OutlineEllipse;

constexpr std::size_t kTruthColumns = 13;
constexpr std::size_t kDetectionColumns = 10;

void append(std::string& row, double value) {
  row += std::isfinite(value) ? fmt::format(",{}", value) : ",";
}

void append(std::string& row, const Eigen::Vector2d& pixel_px) {
  append(row, pixel_px.x());
  append(row, pixel_px.y());
}

/// How far an outline stays from the border of its picture; negative where it is cut.
double border_distance_px(const vision::Intrinsics& camera, const OutlineEllipse& outline) {
  constexpr double kHalfPixel = 0.5;
  const Eigen::Vector2d half = outline.half_extent_px();
  const Eigen::Vector2d low = outline.centre_px - half + Eigen::Vector2d::Constant(kHalfPixel);
  const Eigen::Vector2d high = Eigen::Vector2d(camera.width_px, camera.height_px) - low - 2.0 * half;
  return std::min(low.minCoeff(), high.minCoeff());
}

/// Ball, whether it must be found, its colour and true place; so many empty cells where there is no ball.
void append_truth(std::string& row, const PairOfRun& pair, const BallInPair* ball, bool is_required) {
  if (ball == nullptr) {
    row += std::string(kTruthColumns, ',');
    return;
  }
  const Eigen::Vector2d position = ball->ball_in_robot.head<2>();
  const vision::Intrinsics& camera = pair.rig.intrinsics;
  row += fmt::format(",{},{:d},{}", ball->ball, is_required,
                     pair.world.balls[static_cast<std::size_t>(ball->ball)].colour);
  append(row, position.norm());
  append(row, slam::arc_tangent(position.y(), position.x()));
  append(row, ball->left.centre_px);
  append(row, ball->right.centre_px);
  append(row, std::min(ball->left.radius_px(), ball->right.radius_px()));
  append(row, ball->left_fraction);
  append(row, ball->right_fraction);
  append(row, std::min(border_distance_px(camera, ball->left), border_distance_px(camera, ball->right)));
}

/// What was detected; so many empty cells where nothing was.
void append_detection(std::string& row, const vision::BallObservation* seen) {
  if (seen == nullptr) {
    row += std::string(kDetectionColumns, ',');
    return;
  }
  row += seen->colour == slam::kUnknown ? "," : fmt::format(",{}", seen->colour);
  const slam::RangeBearing& measured = seen->range_bearing;
  append(row, measured.range_m);
  append(row, measured.bearing_rad);
  append(row, measured.covariance(0, 0));
  append(row, measured.covariance(0, 1));
  append(row, measured.covariance(1, 1));
  const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::nan(""));
  append(row, seen->has_pixels ? seen->left_px : none);
  append(row, seen->has_pixels ? seen->right_px : none);
}

}  // namespace

std::string detections_csv_header() {
  return "seed,frame,outcome,ball,required,colour,true_range_m,true_bearing_rad,true_left_x_px,"
         "true_left_y_px,true_right_x_px,true_right_y_px,true_radius_px,left_fraction,right_fraction,"
         "border_px,detected_colour,range_m,bearing_rad,range_variance_m2,range_bearing_covariance_m_rad,"
         "bearing_variance_rad2,left_x_px,left_y_px,right_x_px,right_y_px\n";
}

std::string detection_rows(const PairOfRun& pair, const FrameMatch& match) {
  const PairOutcome outcome = judge_detections(match);
  const std::string begin = fmt::format("{},{},", pair.seed, pair.frame);
  std::string rows;
  for (std::size_t i = 0; i < match.observations.size(); ++i) {
    const MatchedObservation& seen = match.observations[i];
    rows += begin + text_of(outcome.detections[i]);
    append_truth(rows, pair, seen.outline ? &match.outlines[*seen.outline] : nullptr,
                 seen.outline && outcome.is_required[*seen.outline]);
    append_detection(rows, &seen.undistorted);
    rows += '\n';
  }
  for (std::size_t i = 0; i < match.outlines.size(); ++i) {
    if (!outcome.is_required[i] || outcome.is_found[i]) continue;
    rows += begin + kMiss;
    append_truth(rows, pair, &match.outlines[i], true);
    append_detection(rows, nullptr);
    rows += '\n';
  }
  return rows;
}

}  // namespace stereobench::harness
