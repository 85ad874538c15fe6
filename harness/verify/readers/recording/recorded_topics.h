/// What the topics of a recording are called, and their messages as values.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "harness/verify/dataset_view.h"
#include "harness/verify/readers/recording/recording.h"
#include "harness/verify/readers/recording/ros_values.h"

namespace stereobench::harness {

/// A recording, and what is said of it.
struct OpenRecording {
  RecordedFile recording;
  std::string name;                    ///< of the file in its folder
  std::array<std::string, 2> cameras;  ///< by vision::Side: "/stereo/left/" before image_raw and camera_info
  std::string odometry;                ///< its topic; empty where there is none
  std::string body = "base_link";      ///< the frame that odometry is of
  std::vector<Fault> faults;

  /// "drive.bag/odom", as messages name it.
  std::string place_of(const std::string& topic) const { return name + topic; }
  RosVersion version_of(const RecordedMessage& message) const {
    return recording.topics[message.topic].version;
  }
};

/// Finds the cameras and the odometry.
/// @throws std::runtime_error, one line that lists the topics, where there are no pictures of a left and a
///   right camera
OpenRecording opened(RecordedFile recording);

/// The messages of a topic, also where several programs sent them. Empty where there are none of the type.
std::vector<const RecordedMessage*> messages_of(const RecordedFile& recording, std::string_view topic,
                                                std::string_view type);

/// A message and its value.
template <class Value>
struct ReadMessage {
  const RecordedMessage* message = nullptr;
  Value value;
};

/// Reads all messages of a topic. One that cannot be read is a fault.
/// @param read a function of ros_values.h
/// @param most bytes of a message that are looked at
template <class Read>
auto read_messages(OpenRecording& from, const std::string& topic, std::string_view type, const Read& read,
                   std::uint64_t most = std::uint64_t(-1)) {
  using Value = decltype(read(RosVersion::kOne, std::string_view()));
  std::vector<ReadMessage<Value>> values;
  std::size_t number = 0;
  for (const RecordedMessage* message : messages_of(from.recording, topic, type)) {
    try {
      ++number;
      values.push_back(
          {message, read(from.version_of(*message), message_bytes(from.recording, *message, most))});
    } catch (const std::runtime_error& error) {
      from.faults.push_back({from.place_of(topic), "", fmt::format("message {}: {}", number, error.what())});
    }
  }
  return values;
}

}  // namespace stereobench::harness
