/// What a page says of the filters of a run.
#pragma once

#include <vector>

#include "harness/page/page.h"
#include "harness/run/run_curves.h"
#include "harness/run/run_result.h"

namespace stereobench::harness {

/// "0.228 +- 0.049", sorted by the mean.
PageCell summary_cell(const Summary& summary);

/// A whole number.
PageCell count_cell(long count);

/// Sorted by its value.
PageCell number_cell(double value);

/// Each filter's errors beside the bounds, and what it says of its own errors.
std::vector<Block> filter_tables(const RunResult& result);

/// The error of each filter on each seed, and each filter beside those before it.
std::vector<Block> seed_blocks(const RunResult& result);

/// Error, NEES and NIS over time.
/// @param curves of the same run
std::vector<Block> time_blocks(const RunResult& result, const RunCurves& curves);

}  // namespace stereobench::harness
