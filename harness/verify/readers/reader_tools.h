/// What readers of data sets share.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "harness/io/number_table.h"
#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// Runs a part of reading; what it throws becomes a fault of the file.
void read_or_blame(DatasetView& view, const std::string& file, const std::function<void()>& read);

/// The names of the files of a folder without their ending: {"000000_10", ...}; empty without a folder.
/// @param ending ".png", "_10.png"
std::set<std::string> stems_in(const std::filesystem::path& folder, const std::string& ending);

/// Adds a file of a frame, where the folder has it.
void add_channel(DatasetView& view, ViewFrame& frame, vision::Side side, Channel channel,
                 const std::string& file, double step = 0.0);

/// Folders in which each frame has a file: {"image_2", "image_3", ...}. Those that are not there at all are
/// left out; a file that is missing in one and not in another is a fault.
/// @return the frames of all
std::set<std::string> complete_frames(DatasetView& view, const std::vector<std::string>& folders,
                                      const std::string& ending);

/// Twelve or sixteen numbers of a row, from a column on.
Eigen::Matrix4d matrix_in(const NumberTable& table, const TableRow& row, std::size_t column,
                          std::size_t count);

/// x y z and a quaternion, whose order is "xyzw" or "wxyz", as a pose.
ViewPose pose_in(const NumberTable& table, const TableRow& row, std::size_t column, bool w_is_first);

/// Half a unit of the last decimal that any of some cells has: how far off they may be.
double precision_of(const NumberTable& table, std::size_t first_column, std::size_t count);
/// The same of numbers as text: "1.25", "1e-3".
double precision_of(std::span<const std::string> numbers);

/// The pose of a time, between those that are listed. @return empty where they are too far apart, or end
std::optional<Eigen::Isometry3d> pose_at(const std::vector<ViewPose>& poses, std::int64_t stamp_ns);

/// A matrix that is meant to be rigid; checks look at how far it is from that.
Eigen::Isometry3d as_rigid(const Eigen::Matrix4d& matrix);

/// A number that dataset.json says of the shutter, "readout_s".
/// @return 0 where nothing says it: pictures are taken to be of one instant
/// @throws std::runtime_error, one line, where dataset.json cannot be read
double said_of_shutter(const std::filesystem::path& folder, std::string_view key);

/// "file: line" as messages name it.
std::string place_of(const ViewPose& pose);

}  // namespace stereobench::harness
