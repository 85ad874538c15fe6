#include "harness/verify/readers/recording/recorded_topics.h"

#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

constexpr std::string_view kImageType = "sensor_msgs/Image";

/// The topics that have a picture.
std::set<std::string> topics_with_pictures(const RecordedFile& recording) {
  std::vector<bool> is_used(recording.topics.size(), false);
  for (const RecordedMessage& message : recording.messages) is_used[message.topic] = true;
  std::set<std::string> names;
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (is_used[i] && recording.topics[i].type == kImageType) names.insert(recording.topics[i].name);
  return names;
}

/// "/stereo/left/" and "/stereo/right/", where both have pictures.
std::array<std::string, 2> camera_topics(const RecordedFile& recording) {
  constexpr std::string_view kLeft = "/left/image_raw", kRight = "/right/", kRaw = "image_raw";
  const std::set<std::string> with_pictures = topics_with_pictures(recording);
  for (const RecordedTopic& topic : recording.topics) {
    if (!topic.name.ends_with(kLeft) || topic.type != kImageType) continue;
    const std::string above = topic.name.substr(0, topic.name.size() - kLeft.size());
    const std::string right = above + std::string(kRight);
    if (with_pictures.contains(topic.name) || with_pictures.contains(right + std::string(kRaw)))
      return {above + "/left/", right};
  }
  std::vector<std::string> topics;
  for (const RecordedTopic& topic : recording.topics)
    topics.push_back(
        fmt::format("{} {}", topic.name, topic.type.empty() ? "of another encoding" : topic.type));
  constexpr std::size_t kMostListed = 2000;
  const std::string got =
      topics.empty() ? "no topics" : worlds::excerpt(fmt::format("{}", fmt::join(topics, ", ")), kMostListed);
  throw std::runtime_error(
      fmt::format("{}: expected sensor_msgs/Image as .../left/image_raw and .../right/image_raw (got {})",
                  recording.file.string(), got));
}

/// /odom, or else the first one that is not true.
std::string odometry_topic(const RecordedFile& recording) {
  std::string found;
  for (const RecordedTopic& topic : recording.topics) {
    if (topic.type != "nav_msgs/Odometry" || topic.name.starts_with("/ground_truth")) continue;
    if (topic.name == "/odom") return topic.name;
    if (found.empty()) found = topic.name;
  }
  return found;
}

}  // namespace

OpenRecording opened(RecordedFile recording) {
  OpenRecording open = {
      .recording = std::move(recording), .name = {}, .cameras = {}, .odometry = {}, .faults = {}};
  const RecordedFile& of = open.recording;
  open.name = of.file.filename().string();
  for (const std::string& fault : of.faults) open.faults.push_back({open.name, "", fault});
  open.cameras = camera_topics(of);
  open.odometry = odometry_topic(of);
  const auto first = messages_of(of, open.odometry, "nav_msgs/Odometry");
  if (first.empty()) return open;
  try {
    const ReadOdometry odometry =
        read_ros_odometry(open.version_of(*first.front()), message_bytes(of, *first.front()));
    if (!odometry.child_frame.empty()) open.body = odometry.child_frame;
  } catch (const std::runtime_error&) {
    // It is a fault once all of them are read.
  }
  return open;
}

std::vector<const RecordedMessage*> messages_of(const RecordedFile& recording, std::string_view topic,
                                                std::string_view type) {
  std::vector<const RecordedMessage*> messages;
  for (const RecordedMessage& message : recording.messages)
    if (recording.topics[message.topic].name == topic && recording.topics[message.topic].type == type)
      messages.push_back(&message);
  return messages;
}

}  // namespace stereobench::harness
