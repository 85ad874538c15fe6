/// Where a detector's results changed: which balls, in which camera, in which frames.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "harness/regression/detected_balls.h"
#include "harness/regression/slice.h"
#include "harness/regression/verdict.h"
#include "harness/statistics/paired.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {

/// By how much the centres of balls that both found moved in a camera, px.
struct CentreShift {
  Summary x_px;
  Summary y_px;
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
  long balls = 0;         ///< that were lost or misidentified
  double worse_m2 = 0.0;  ///< by how much squared range errors grew, summed
};

/// What changed from one detector to another on the same balls.
struct DetectionChanges {
  long required = 0;  ///< balls that had to be found, in both results
  long unpaired = 0;  ///< balls that had to be found in one result, and in the other one are elsewhere
  PairedCount found;  ///< of the required: worse counts what the first alone found
  PairedCount misidentified;  ///< taken for another colour: worse counts what the second alone did
  long found_by_both = 0;

  // What balls have in common.
  std::optional<Slice> lost_slice;           ///< found by the first alone, of the required
  std::optional<Slice> misidentified_slice;  ///< taken for another colour by the second alone, of all
  /// That make up nine tenths of the growth of range errors; empty where all moved alike.
  std::optional<Slice> misplaced_slice;

  std::vector<Confusion> confusions;  ///< the most frequent first
  CentreShift left;                   ///< of the balls that both found
  CentreShift right;
  Summary range_growth;              ///< of the same balls, as a share of the true range
  std::vector<ChangedFrame> frames;  ///< the ten that changed most, if as many did
};

DetectionChanges detection_changes(const PairedBalls& balls);

/// Its counts, by the metrics that they are of; none where balls are not in both results.
PairedCounts counts_of(const DetectionChanges& changes);

/// Some lines for people; empty where nothing changed.
/// @param range_errors_grew significantly: then it is said where
std::string changes_text(const DetectionChanges& changes, bool range_errors_grew);

/// What lost and misidentified balls have in common, one line; empty where there are none.
std::string slices_text(const DetectionChanges& changes);

/// The command that renders a frame again.
/// @param result the folder of B
std::string replay_command(const ChangedFrame& frame, const std::string& result);

/// A line with the command of the frame that changed most; empty where none did.
/// @param result the folder of B; empty: it cannot be replayed, and there is no line
std::string replay_line(const DetectionChanges& changes, const std::string& result);

/// The same for programs.
nlohmann::ordered_json changes_json(const DetectionChanges& changes);

}  // namespace stereobench::harness
