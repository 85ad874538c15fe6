/// What a recorded log is found to hold and to lack, and what is assumed of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slam/diagnosis/lasting_errors.h"
#include "slam/diagnosis/sensor_sector.h"

namespace stereobench::harness {

/// Where the odometry's delay comes from.
enum class DelaySource {
  kStated,        ///< by the caller
  kFound,         ///< in the log
  kNoneBetter,    ///< 0: no delay explains the sightings better than none, beyond chance
  kNoIdentities,  ///< 0: no sighting says of which landmark it is
  kFewPairs,      ///< 0: too few landmarks are seen twice within a second
};

/// What the reader counted, corrected and left out.
struct LogFacts {
  double odometry_delay_s = 0.0;  ///< by which the odometry was moved
  DelaySource delay_source = DelaySource::kStated;
  slam::FoundSector sector;            ///< that filters are told; none where all sightings have identities
  bool sector_is_found = false;        ///< in the log: nobody states it
  slam::LastingErrors lasting_errors;  ///< for which sightings in close order count for less
  long robot_sightings = 0;            ///< MRCLAM: of the other robots, which are no landmarks; left out
  long unknown_barcodes = 0;           ///< MRCLAM: of a barcode that `Barcodes.dat` does not name; left out
  long repeated_sightings = 0;         ///< that stood in the log already; left out
  long concurrent_sightings = 0;  ///< of a landmark that another sighting of the same instant is of; kept
  bool noise_is_assumed = false;  ///< some sightings state no covariance
  bool odometry_states_noise = false;
  bool has_truth = false;       ///< of the path, at any step
  double truth_starts_s = 0.0;  ///< after the first step
  long steps = 0;
  long steps_without_truth = 0;
};

/// What the caller has said of the log, so that nothing of it is assumed.
struct StatedNoise {
  bool sensor = false;    ///< of sightings without covariances, or of all
  bool odometry = false;  ///< any of it
};

/// One line for each assumption that results rest on: what was assumed, and what to do about it.
std::vector<std::string> assumptions_of(const LogFacts& facts, const StatedNoise& stated);

}  // namespace stereobench::harness
