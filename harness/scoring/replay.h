/// Filters driven over a log.
#pragma once

#include <cstdint>
#include <string>

#include "harness/types.h"
#include "slam/filter_registry.h"

namespace stereobench::harness {

/// Drives one filter over a log, from the log's start to its last step.
/// @param log what the robot measured; its truth is for scores alone
/// @param filter one of slam::filter_names()
/// @param config the filter's settings; reports of its updates are always asked for
/// @param seed of the filter's own random stream
/// @return its estimate after every step. `failed` when the filter threw or its estimate was not finite; then
///   the steps before that are kept
/// @throws std::invalid_argument when there is no such filter, or a setting or the start is out of range
FilterRun replay(const MeasurementLog& log, const std::string& filter, slam::FilterConfig config,
                 std::uint64_t seed);

}  // namespace stereobench::harness
