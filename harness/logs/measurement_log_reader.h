/// Logs recorded by real robots, or written by write_log, read into what the filters are replayed on.
#pragma once

#include <filesystem>
#include <optional>

#include "harness/logs/log_facts.h"
#include "harness/types.h"

namespace stereobench::harness {

/// What the reader tells the filters of a sensor whose log carries no covariances.
struct SensorNoise {
  double range_sd_m = 0.17;
  double bearing_sd_rad = 0.0125;
};

/// What a log does not say of itself.
struct LogAssumptions {
  SensorNoise noise;  ///< of sightings whose file states no covariance
  /// By how much the motion follows the odometry's stamps; empty = estimated from the log (odometry_delay.h).
  std::optional<double> odometry_delay_s;
};

/// A log together with what was found of it.
struct RecordedLog {
  MeasurementLog log;
  LogFacts facts;
};

/// Reads a recorded log: `odometry.csv`, `observations.csv` and, where they exist, `landmarks.csv` (also
/// in the parent folder), `groundtruth.csv` and `instants.csv`; or UTIAS MRCLAM's `Barcodes.dat`,
/// `Landmark_Groundtruth.dat` and `Robot<k>_{Odometry,Measurement,Groundtruth}.dat`. Every file may be
/// plain or gzip-compressed with `.gz` added to its name. How streams become steps: see log_steps.h.
///
/// A sighting that stands in it twice, with the same instant, landmark, range and bearing, is read once.
/// The stamps of `.dat` files count from the whole second of the first odometry reading.
/// @param folder_or_file the folder, or one of its files (which picks the robot among MRCLAM's)
/// @param assumptions standard deviations > 0, a delay within a minute
/// @return at least one step, in order of time
/// @throws std::runtime_error `file:line: column: what was expected` for whatever cannot be read exactly
RecordedLog read_log(const std::filesystem::path& folder_or_file, const LogAssumptions& assumptions);

}  // namespace stereobench::harness
