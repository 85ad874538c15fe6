/// Where a detector's results changed: which balls, in which camera, in which frames.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "harness/regression/detected_balls.h"
#include "harness/regression/slice.h"
#include "harness/regression/verdict.h"
#include "harness/statistics/paired.h"

namespace stereobench::harness {

/// By how much the centres of balls that both found moved in a camera, px: mean and its standard error.
struct CentreShift {
  Eigen::Vector2d mean_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d standard_error_px = Eigen::Vector2d::Zero();
};

/// Balls of one colour that were taken for another.
struct Confusion {
  int colour = 0;
  int taken_for = 0;
  long balls = 0;  ///< by the second detector, and not by the first
};

/// A stereo pair in which balls were lost or misplaced.
struct ChangedFrame {
  std::uint64_t seed = 0;
  int frame = 0;
  long lost = 0;          ///< balls that the first alone found, or named right
  double worse_m2 = 0.0;  ///< by how much squared range errors grew, summed
};

/// What changed from one detector to another on the same balls.
struct DetectionChanges {
  long required = 0;              ///< balls that had to be found
  PairedCount found;              ///< of these
  PairedCount named;              ///< of the balls that both saw: whose colour is right
  std::optional<Slice> lost;      ///< what lost balls have in common, among those that had to be found
  std::optional<Slice> misnamed;  ///< what misnamed balls have in common, among those that both saw
  std::optional<Slice>
      misplaced;  ///< the same of balls that make up nine tenths of the growth of range errors
  std::vector<Confusion> confusions;  ///< the most frequent first
  long found_by_both = 0;
  CentreShift left;
  CentreShift right;
  std::vector<ChangedFrame> frames;  ///< the ten that changed most, if as many did
};

DetectionChanges detection_changes(std::span<const PairedBall> balls);

/// Its counts, by the metrics that they are of.
PairedCounts counts_of(const DetectionChanges& changes);

/// Some lines for people; empty where nothing changed.
std::string changes_text(const DetectionChanges& changes);

}  // namespace stereobench::harness
