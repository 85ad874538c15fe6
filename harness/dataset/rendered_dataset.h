/// Rendered stereo pairs with their truth, as a plain folder that any program can read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/run/recording.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// A folder of stereo pairs:
///
///     left/000000.png         right/000000.png        what the sensor saw, 8-bit BGR
///     left_id/000000.png      right_id/000000.png     0 = no ball, k = ball_id k - 1 of balls.csv
///     left_depth/000000.pfm   right_depth/000000.pfm  planar Z in metres, +inf = nothing
///     calibration.yaml        true_calibration.yaml   the rig as it is believed to be, and as it is
///     balls.csv
///     odometry.csv observations.csv landmarks.csv groundtruth.csv instants.csv   what `stereobench slam`
///     reads dataset.json            written last: where it is, the folder is complete; what was rendered,
///     and size and
///                             SHA-256 of each file
///
/// Frames are named by their step; groundtruth.csv has one line for each.
class RenderedDataset {
 public:
  /// Prepares the folder, or takes up one that was interrupted.
  /// Files of a finished data set that are missing, or do not hold what they held, are removed; they are
  /// written again with the frames that they belong to.
  /// @param identity of what is rendered, an object: scenario, overrides, seed, version
  /// @throws std::runtime_error when the folder cannot be written, or holds another rendering
  RenderedDataset(std::filesystem::path folder, nlohmann::ordered_json identity);

  /// The files that were removed because they were not as they had been written.
  const std::vector<std::string>& spoilt() const { return spoilt_; }

  /// Writes a step's pictures that are not there yet.
  void write(const Look& look) const;

  /// Writes calibration (as it is believed, and as it is), balls and the log, and last of all dataset.json.
  void finish(const worlds::World& world, const vision::StereoRig& rig, const vision::StereoRig& believed_rig,
              const MeasurementLog& log) const;

 private:
  void take_up(const std::filesystem::path& marker);

  std::filesystem::path folder_;
  nlohmann::ordered_json identity_;
  std::vector<std::string> spoilt_;
};

/// The balls as CSV: ball_id, colour, its RGB, centre and radius.
std::string balls_csv(const worlds::World& world);

}  // namespace stereobench::harness
