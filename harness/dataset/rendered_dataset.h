/// Rendered stereo pairs with their truth, as a plain folder that any program can read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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
///     reads dataset.json            written last: where it is, the folder is complete
///
/// Frames are named by their step; groundtruth.csv has one line for each.
class RenderedDataset {
 public:
  /// Prepares the folder, or takes up one that was interrupted.
  /// @param identity of what is rendered: scenario, overrides, seed, version
  /// @throws std::runtime_error when the folder cannot be written, or holds another rendering
  RenderedDataset(std::filesystem::path folder, std::string identity);

  /// Writes a step's pictures that are not there yet.
  void write(const Look& look) const;

  /// Writes calibration (as it is believed, and as it is), balls and the log, and last of all dataset.json.
  void finish(const worlds::World& world, const vision::StereoRig& rig, const vision::StereoRig& believed_rig,
              const MeasurementLog& log) const;

 private:
  std::filesystem::path folder_;
  std::string identity_;
};

/// The balls as CSV: ball_id, colour, its RGB, centre and radius.
std::string balls_csv(const worlds::World& world);

}  // namespace stereobench::harness
