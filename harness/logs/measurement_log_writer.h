/// Rendered runs as measurement logs, to be replayed later or read by other people's programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/logs/recorded_streams.h"
#include "harness/types.h"

namespace stereobench::harness {

/// A time as logs write it: seconds with nine digits behind the point.
std::string seconds_of(std::int64_t stamp_ns);

/// The odometry as logs have it: a reading for each control, stamped with the whole nanosecond from which on
/// it holds. A log of one step has a reading of a robot that stands.
/// @param log as of log_files
/// @throws std::invalid_argument as log_files
std::vector<OdometryReading> odometry_readings(const MeasurementLog& log);

/// A file of a log.
struct LogFile {
  std::string name;
  std::string text;
};

/// A log as `odometry.csv`, `observations.csv`, `landmarks.csv`, `groundtruth.csv` and `instants.csv` (the
/// stamps of all steps, also of those at which nothing was seen).
/// Numbers are as short as they can be and still be read back exactly; stamps are exact nanoseconds.
/// @param log its odometry must fill the time between its steps, to a microsecond, and it must start where a
///   reader starts: at the first step's truth, or at the origin where that is unknown
/// @throws std::invalid_argument when it does not so
std::vector<LogFile> log_files(const MeasurementLog& log);

/// The same of streams that were recorded.
/// @param streams with odometry of wheels, which slides nowhere, and without covariances
/// @throws std::invalid_argument for other odometry
std::vector<LogFile> log_files(const RecordedStreams& streams);

/// What is known of a log without odometry: `groundtruth.csv` and `instants.csv`, as above.
std::vector<LogFile> time_files(const MeasurementLog& log);

}  // namespace stereobench::harness
