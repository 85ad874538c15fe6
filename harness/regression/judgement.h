/// A comparison with all that it says: verdicts, and which detections changed.
#pragma once

#include <optional>
#include <string>

#include "harness/regression/detection_changes.h"
#include "harness/regression/verdict.h"

namespace stereobench::harness {

struct Judgement {
  ResultComparison comparison;
  std::optional<DetectionChanges> changes;  ///< empty where one of the results has no detections
  std::string detections;                   ///< lines for people, as of changes_text
};

/// The lines on detections, and the command that shows the frame that changed most.
/// @param result the folder of the second result; empty: it cannot be replayed
std::string detection_lines(const Judgement& judgement, const std::string& result);

/// Judges each metric, and says which detections changed.
/// @param balls of both results; empty where one of them has no detections
/// @throws std::runtime_error as compare_results
Judgement judge(const SeedTable& first, const SeedTable& second, const VerdictSettings& settings,
                const std::optional<PairedBalls>& balls);

}  // namespace stereobench::harness
