/// A result's table of detections, line by line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "harness/regression/detected_balls.h"

namespace stereobench::harness {

/// A line of detections.csv: a detection, or a ball that had to be found and was not. Pixels are where a rig
/// without distortion has them. What the line leaves empty is NaN, or none.
struct DetectionRow {
  std::uint64_t seed = 0;
  std::size_t frame = 0;
  std::string outcome;  ///< as text_of(DetectionOutcome), or kMiss
  std::optional<int> ball;
  bool is_required = false;
  std::optional<int> colour;
  double true_range_m = 0.0;
  double true_bearing_rad = 0.0;
  Eigen::Vector2d true_left_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d true_right_px = Eigen::Vector2d::Zero();
  double true_radius_px = 0.0;
  std::optional<int> detected_colour;
  double range_m = 0.0;
  double bearing_rad = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (range m, bearing rad), as stated
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();

  double range_error_m() const { return range_m - true_range_m; }
};

/// Reads a detections.csv or detections.csv.gz.
/// @throws std::runtime_error "file:line: what was expected"
std::vector<DetectionRow> read_detection_rows(const std::filesystem::path& file);

/// What a detector once made of the balls of a result, as rows: its findings beside the result's truth.
/// @param findings of the same inputs, e.g. of a baseline. Of a detection they know the error of the range
/// and of the centres; its bearing and its covariance are NaN
/// @param rows of the result. Balls that are not among them are left out
std::vector<DetectionRow> rows_of_findings(const DetectedBalls& findings, std::span<const DetectionRow> rows);

}  // namespace stereobench::harness
