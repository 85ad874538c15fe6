/// Rendered runs as measurement logs, to be replayed later or read by other people's programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "harness/types.h"

namespace stereobench::harness {

/// A time as logs write it: seconds with nine digits behind the point.
std::string seconds_of(std::int64_t stamp_ns);

/// Writes a log as `odometry.csv`, `observations.csv`, `landmarks.csv`, `groundtruth.csv` and
/// `instants.csv` (the stamps of all steps, also of those at which nothing was seen), each atomically.
/// Numbers are as short as they can be and still be read back exactly; stamps are exact nanoseconds.
/// @param folder an existing folder
/// @param log its odometry must fill the time between its steps, to a microsecond, and it must start where a
///   reader starts: at the first step's truth, or at the origin where that is unknown
/// @throws std::invalid_argument when it does not so; std::runtime_error when a file cannot be written
void write_log(const std::filesystem::path& folder, const MeasurementLog& log);

}  // namespace stereobench::harness
