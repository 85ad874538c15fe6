/// The page of an attribution.
#pragma once

#include <span>
#include <string>

#include "harness/attribution/attribution.h"
#include "harness/page/page.h"

namespace stereobench::harness {

/// The shares of each filter's errors: a chart of all filters by metric, and a table a metric.
/// @param words of the command line, but for the seeds; empty: none is shown
Page attribution_page(const Attribution& attribution, std::span<const std::string> words);

}  // namespace stereobench::harness
