/// What is fed with bytes that anybody may have made up. Each ends in a result that holds what it promises,
/// or in an error of one line; anything else ends the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace stereobench::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// One way in.
struct Entry {
  const char* name;
  void (*check)(Bytes bytes);
  std::vector<std::string> (*seeds)();  ///< good inputs to begin with
};

/// A pair of pictures that bytes tell how to draw, observed by both cameras.
void check_scene(Bytes bytes);
/// The bytes of a picture's file, read and looked at.
void check_picture(Bytes bytes);
/// The text of a calibration.
void check_calibration(Bytes bytes);
/// A line of detections.
void check_detections(Bytes bytes);
/// The text of a palette.
void check_palette(Bytes bytes);

/// The text of a scenario.
void check_scenario(Bytes bytes);
std::vector<std::string> scenario_seeds();
/// The files of a log: each begins with a line "=== NAME".
void check_log(Bytes bytes);
std::vector<std::string> log_seeds();
/// The text of a trajectory, TUM's or ours.
void check_trajectory(Bytes bytes);
std::vector<std::string> trajectory_seeds();
/// The text of a trajectory in space, of any format.
void check_poses(Bytes bytes);
std::vector<std::string> pose_seeds();
/// The text of a file of marks, beside a picture a.png.
void check_marks(Bytes bytes);
std::vector<std::string> mark_seeds();
/// A mesh file; the first byte says of which format.
void check_mesh(Bytes bytes);
std::vector<std::string> mesh_seeds();
/// The text of a run.json, compared with itself.
void check_result(Bytes bytes);
std::vector<std::string> result_seeds();

/// The text of a suite.
void check_suite(Bytes bytes);
std::vector<std::string> suite_seeds();
/// The text of a case's baseline.
void check_baseline(Bytes bytes);
std::vector<std::string> baseline_seeds();

/// A bag of ROS 1, an MCAP file, and an archive of WebDataset, each alone in a folder: the data set with its
/// pictures, and the log.
void check_bag(Bytes bytes);
std::vector<std::string> bag_seeds();
void check_mcap(Bytes bytes);
std::vector<std::string> mcap_seeds();
void check_shards(Bytes bytes);
std::vector<std::string> shard_seeds();
/// The bytes of truth as floats, TIFF or PFM.
void check_float_picture(Bytes bytes);
std::vector<std::string> float_picture_seeds();
/// What dataset.json says of a drive.
void check_drive(Bytes bytes);
std::vector<std::string> drive_seeds();
/// The list of a data set's files.
void check_manifest(Bytes bytes);
std::vector<std::string> manifest_seeds();
/// The list of a collection's data sets.
void check_collection(Bytes bytes);
std::vector<std::string> collection_seeds();

/// All of them.
std::span<const Entry> entries();

}  // namespace stereobench::fuzz
