/// Rendered stereo pairs with their truth, as a plain folder that any program can read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/drive/recording.h"
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
///     reads
///     dataset.json            written last: where it is, the folder is complete; what was rendered, which
///                             frames there are, how coarse their blur is, and size and SHA-256 of each file
///
/// Frames are named by their step; groundtruth.csv has one line for each.
class RenderedDataset {
 public:
  /// Takes up a folder where one that was interrupted lies. Nothing is created before the first frame is
  /// written: whatever fails until then leaves nothing behind.
  /// Files of a finished data set that are missing, or do not hold what they held, are removed; they are
  /// written again with the frames that they belong to.
  /// @param identity of what is rendered, an object: scenario, overrides, seed, version
  /// @throws std::runtime_error when the folder cannot be written, or holds another rendering
  RenderedDataset(std::filesystem::path folder, nlohmann::ordered_json identity);

  /// Whether all of it is there, as it was written.
  bool is_complete() const { return is_finished_ && spoilt_.empty(); }

  /// The files that were removed because they were not as they had been written.
  const std::vector<std::string>& spoilt() const { return spoilt_; }

  /// Writes a step's pictures that are not there yet.
  void write(const FrameEvent& event) const;

  /// Writes calibration (as it is believed, and as it is), balls and the log, and last of all dataset.json.
  /// @param blur of all its pictures
  void finish(const worlds::World& world, const vision::StereoRig& rig, const vision::StereoRig& believed_rig,
              const MeasurementLog& log, const CoarseBlur& blur) const;

 private:
  void begin() const;
  void find_spoilt(const std::filesystem::path& marker);

  std::filesystem::path folder_;
  nlohmann::ordered_json identity_;
  bool is_finished_ = false;
  std::vector<std::string> spoilt_;
};

/// Makes sure that a folder holds no other rendering, finished or not, than the one that is asked for. What
/// was begun and has no file yet is none.
/// @param identity as of RenderedDataset
/// @throws std::runtime_error, one line that names the keys of the identity that differ
void require_same_rendering(const std::filesystem::path& folder, const nlohmann::ordered_json& identity);

/// Whether a folder holds a rendering, finished or not.
bool holds_rendering(const std::filesystem::path& folder);

/// The balls as CSV: ball_id, colour, its RGB, centre and radius.
std::string balls_csv(const worlds::World& world);

}  // namespace stereobench::harness
