/// Recordings of the Robot Operating System: one container in a folder.
#pragma once

#include <filesystem>

#include "harness/logs/recorded_streams.h"
#include "harness/verify/dataset_view.h"
#include "harness/verify/readers/recording/recording.h"

namespace stereobench::harness {

/// A kind of container.
struct RecordingKind {
  const char* format;  ///< its name
  const char* ending;  ///< of the container's file
  RecordedFile (*read)(const std::filesystem::path& file);
};

inline constexpr RecordingKind kRosbagKind = {"rosbag", ".bag", read_bag},
                               kMcapKind = {"mcap", ".mcap", read_mcap};

bool looks_like_recording(const std::filesystem::path& folder, const RecordingKind& kind);

/// Pictures are messages: `.../left/image_raw` and `.../right/image_raw`, with camera_info; their ChannelFile
/// is named CONTAINER/TOPIC. Poses are those of /ground_truth/pose.
/// @throws std::runtime_error, one line, for a folder of none or of several containers, and for one that
///   cannot be read to its end (recording.h)
DatasetView read_recording_view(const std::filesystem::path& folder, const RecordingKind& kind);

/// @throws std::runtime_error as read_recording_view
RecordedStreams read_recording_log(const std::filesystem::path& folder, const RecordingKind& kind);

}  // namespace stereobench::harness
