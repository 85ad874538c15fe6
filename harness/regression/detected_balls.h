/// What two detectors made of the same balls in the same stereo pairs.
#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace stereobench::harness {

/// A ball in a stereo pair of a run.
struct BallKey {
  std::uint64_t seed = 0;
  int frame = 0;
  int ball = 0;
  auto operator<=>(const BallKey&) const = default;
};

/// The truth of a ball in a pair. Pixels are where a rig without distortion has them.
struct BallTruth {
  bool is_required = false;  ///< it had to be found
  int colour = 0;
  double range_m = 0.0;
  double bearing_rad = 0.0;
  double radius_px = 0.0;
  double fraction = 0.0;  ///< that is seen, in the camera that sees less
  double border_px = 0.0;
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();
};

/// What a detector made of a ball.
struct BallFinding {
  bool is_found = false;            ///< with its colour, or none
  std::optional<int> wrong_colour;  ///< that it was taken for, besides or in place of being found
  double range_error_m = 0.0;       ///< of what was found, measured minus true, and so below
  Eigen::Vector2d left_error_px = Eigen::Vector2d::Zero();  ///< NaN without pixels
  Eigen::Vector2d right_error_px = Eigen::Vector2d::Zero();
};

struct DetectedBall {
  BallTruth truth;
  BallFinding finding;
};

/// The balls of a run that had to be found or were.
using DetectedBalls = std::map<BallKey, DetectedBall>;

/// Reads a detections.csv or detections.csv.gz. Detections of no ball, duplicates and flagged ones are left
/// out.
/// @throws std::runtime_error "file:line: what was expected"
DetectedBalls read_detected_balls(const std::filesystem::path& file);

/// A ball that both runs have.
struct PairedBall {
  BallKey key;
  BallTruth truth;
  BallFinding first;
  BallFinding second;
};

/// The balls of two runs beside each other.
struct PairedBalls {
  /// Those that were in the same place, in order of their keys. One that did not have to be found, and that
  /// one run alone has, is one that the other one did not find.
  std::vector<PairedBall> balls;
  long unpaired = 0;  ///< that had to be found in one run, and in the other one were not there or elsewhere
};

/// Pairs the balls of the seeds that both runs have.
PairedBalls pair_balls(const DetectedBalls& first, const DetectedBalls& second);

}  // namespace stereobench::harness
