/// What a detector made of each ball, as lines of text that version control can tell apart. What the balls
/// are is not in it: runs of the same inputs see the same balls.
#pragma once

#include <filesystem>
#include <string>

#include "harness/regression/detected_balls.h"

namespace stereobench::harness {

/// One line a ball that had to be found or was: seed, frame, ball, whether it had to be found and was (0 or
/// 1), the colour that it was taken for, error of the range (rounded to 1e-7 m), errors of the centres (to
/// 1e-4 px). What does not exist is empty.
std::string findings_csv(const DetectedBalls& balls);

/// @return of each ball's truth only whether it had to be found
/// @throws std::runtime_error "file:line: what was expected"
DetectedBalls read_findings(const std::filesystem::path& file);

/// Findings beside others of the same inputs.
/// @param first as of read_findings
/// @param second whose balls say what was there
/// @return as of pair_balls, with both rounded alike; a ball that `second` has not is unpaired if it had to
/// be found, else left out
PairedBalls pair_findings(const DetectedBalls& first, const DetectedBalls& second);

}  // namespace stereobench::harness
