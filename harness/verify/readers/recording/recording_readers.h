/// Recordings of the Robot Operating System: one container in a folder.
#pragma once

#include <filesystem>

#include "harness/logs/recorded_streams.h"
#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

/// Pictures are messages: `.../left/image_raw` and `.../right/image_raw`, with camera_info; their ChannelFile
/// is named CONTAINER/TOPIC. Poses are those of /ground_truth/pose.
/// @throws std::runtime_error, one line, for a folder of none or of several containers, and for one that
///   cannot be read to its end (recording.h)
bool looks_like_rosbag(const std::filesystem::path& folder);
DatasetView read_rosbag_view(const std::filesystem::path& folder);
RecordedStreams read_rosbag_log(const std::filesystem::path& folder);

bool looks_like_mcap(const std::filesystem::path& folder);
DatasetView read_mcap_view(const std::filesystem::path& folder);
RecordedStreams read_mcap_log(const std::filesystem::path& folder);

}  // namespace stereobench::harness
