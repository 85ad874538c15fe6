/// The streams of a recorded log, each in order of time, before they are cut into steps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "harness/logs/measurement_log_reader.h"
#include "harness/types.h"

namespace stereobench::harness {

/// Of MRCLAM's data: subjects 1 to 5 drive, the others are landmarks.
inline constexpr int kMrclamRobots = 5;

struct OdometryReading {
  std::int64_t stamp_ns = 0;
  double v_mps = 0.0;
  double w_radps = 0.0;
  double lateral_mps = 0.0;
  std::optional<Eigen::Matrix3d>
      covariance;        ///< of (v, lateral, w) over all of `lasts_s`, where it is stated
  double lasts_s = 0.0;  ///< with a covariance: until the next reading
};

struct LoggedSighting {
  std::int64_t stamp_ns = 0;
  slam::RangeBearing measurement;
};

struct StampedPose {
  std::int64_t stamp_ns = 0;
  slam::Pose pose;
};

struct RecordedStreams {
  std::vector<OdometryReading> odometry;  ///< at least one
  std::vector<LoggedSighting> sightings;
  std::vector<StampedPose> truth;
  std::vector<LandmarkTruth> landmarks;
  std::optional<std::vector<std::int64_t>> instants_ns;  ///< the steps' stamps, where the log states them
  long robot_sightings = 0;
  long unknown_barcodes = 0;
  bool noise_is_assumed = false;  ///< the file of sightings has no covariances
  bool odometry_states_noise = false;
};

/// Sightings this close to the first of a step, and to a stated instant, belong to it: the logs' resolution.
inline constexpr std::int64_t kSameInstant_ns = 1'000'000;

/// Reads a folder of measurement-log CSVs.
/// @throws std::runtime_error as read_log
RecordedStreams read_csv_streams(const std::filesystem::path& folder, const SensorNoise& noise);

/// Reads one robot of a folder of UTIAS MRCLAM's own files (Leung et al., IJRR 2011).
/// @param robot its subject number, 1 to 5
/// @throws std::runtime_error as read_log
RecordedStreams read_mrclam_streams(const std::filesystem::path& folder, int robot, const SensorNoise& noise);

}  // namespace stereobench::harness
