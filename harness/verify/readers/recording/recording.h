/// What a container holds, of whichever kind: messages with topic, type and time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/dataset/formats/container/ros_message.h"

namespace stereobench::harness {

struct RecordedTopic {
  std::string name;  ///< "/odom"
  std::string type;  ///< "nav_msgs/Odometry", of ROS 2 as well; empty where it is of no encoding that is read
  RosVersion version = RosVersion::kOne;  ///< of the encoding
};

/// A message, whose bytes are one piece of the file.
struct RecordedMessage {
  std::size_t topic = 0;                  ///< index into RecordedFile::topics
  std::int64_t stamp_ns = 0;              ///< when it was recorded
  std::uint64_t at = 0;                   ///< its first byte in the file
  std::uint64_t size = 0;                 ///< bytes
  std::optional<std::uint32_t> sequence;  ///< counts a topic's messages, where the container says it
};

struct RecordedFile {
  std::filesystem::path file;
  std::vector<RecordedTopic> topics;
  std::vector<RecordedMessage> messages;  ///< in the order of the file
  std::vector<std::string> faults;        ///< what the container says twice and differently
  std::vector<std::string> checked;       ///< what was compared
};

/// Reads a bag of ROS 1 (wiki.ros.org/Bags/Format/2.0) from its first record to its last one; each entry of
/// its indices is held against the messages.
/// @throws std::runtime_error, one line, for a file that is none, is cut short, was not closed, or has
///   compressed chunks
RecordedFile read_bag(const std::filesystem::path& file);

/// Reads an MCAP file (mcap.dev/spec), with chunks or without, from its first record to its footer; its
/// checksums and counts are held against the data.
/// @throws std::runtime_error, one line, for a file that is none, is cut short, or has compressed chunks
RecordedFile read_mcap(const std::filesystem::path& file);

/// The bytes of a message. @param most only so many, from the first one on
/// @throws std::runtime_error, one line, where they cannot be read
std::string message_bytes(const RecordedFile& recording, const RecordedMessage& message,
                          std::uint64_t most = std::uint64_t(-1));

}  // namespace stereobench::harness
