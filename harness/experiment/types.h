/// What is run in a scenario: who looks, which filters, what they are told, with which seeds, within which
/// limits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "harness/experiment/detector_faults.h"
#include "slam/filter_config.h"
#include "slam/filter_registry.h"
#include "slam/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// A limit on a metric of run.json, e.g. {"filters.ufastslam.ate_rms_m.mean", <=, 0.05}.
struct Gate {
  std::string metric;
  enum class Relation { kAtMost, kAtLeast } relation = Relation::kAtMost;
  double limit = 0.0;
};

/// Somebody's program that finds the balls in the pictures.
struct DetectorProgram {
  std::string command;      ///< of the shell; empty: the vision stage looks itself
  double timeout_s = 30.0;  ///< for the answer to a frame
  double start_s = 90.0;    ///< so much longer the first answer may take: libraries and models load
};

/// What detections have of the truth, whatever the detector found: an oracle in its place.
struct PerfectDetections {
  bool places = false;  ///< centres, and which balls are found
  bool names = false;   ///< which ball each is; filters are told

  bool any() const { return places || names; }
  bool operator==(const PerfectDetections&) const = default;
};

/// What filters are told of odometry and sensor, where that is not what is so.
struct FilterBeliefs {
  std::optional<slam::OdometryNoise> odometry_noise;  ///< none: what the odometry really has
  std::optional<worlds::StartNoise> start_noise;      ///< none: what the start really has
  std::optional<slam::NoiseLaw> measurement_noise;    ///< none: each sighting states its own
  /// By how much (range, bearing) are worse than sightings state.
  Eigen::Vector2d stated_sd_scale = Eigen::Vector2d::Ones();
  /// Sector and rates of the oracle; none: what they are. A camera declares nothing.
  std::optional<slam::SensorSector> sector;
};

/// Everything that a run is made from.
struct Experiment {
  worlds::Scenario scenario;
  DetectorProgram detector;
  std::optional<DetectorFaults> detector_noise;  ///< none: nothing is counted either
  PerfectDetections perfect_detections;
  FilterBeliefs believed;
  slam::Association association = slam::Association::kJoint;
  std::vector<std::string> filters = slam::usual_filter_names();
  int particles = 100;
  int draw_every = slam::FilterConfig{}.draw_every;  ///< frames of a block at most
  std::vector<std::uint64_t> seeds = {0};
  std::vector<Gate> gates;
};

}  // namespace stereobench::harness
