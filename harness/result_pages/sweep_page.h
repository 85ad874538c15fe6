/// The page of a sweep.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/page/page.h"
#include "harness/sweep/sweep_result.h"

namespace stereobench::harness {

/// A table of the cells; errors of detections and filters against the first variation, with intervals, for
/// each combination of the others.
/// @param words of the command line, but for the seeds; empty: none is shown
/// @param gates a line for each broken gate, or one that says that all hold; may be empty
Page sweep_page(const SweepResult& sweep, std::span<const std::string> words, const std::string& gates);

}  // namespace stereobench::harness
