#include "tests/harness/verify/planted_recording.h"

#include <algorithm>
#include <map>

#include "harness/dataset/formats/container/bag_file.h"
#include "harness/dataset/formats/container/mcap_file.h"
#include "harness/dataset/formats/container/ros_drive.h"

namespace stereobench::harness {
namespace {

std::size_t index_of_topic(const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(kRosTopics, name, &RosTopic::name) - kRosTopics.begin());
}

void write_planted_bag(AtomicFile& file, const std::vector<PlantedMessage>& messages) {
  std::vector<BagConnection> connections;
  for (const RosTopic& topic : kRosTopics) {
    const RosSchema schema = ros_schema(topic.type, RosVersion::kOne);
    connections.push_back(
        {std::string(topic.name), schema.name, schema.md5, schema.definition, topic.is_latched});
  }
  BagFile bag(file, connections);
  for (const PlantedMessage& message : messages)
    bag.add(index_of_topic(message.topic), message.stamp_ns, message.bytes);
  bag.finish();
}

void write_planted_mcap(AtomicFile& file, const std::vector<PlantedMessage>& messages) {
  std::vector<McapChannel> channels;
  for (const RosTopic& topic : kRosTopics) {
    const RosSchema schema = ros_schema(topic.type, RosVersion::kTwo);
    channels.push_back({std::string(topic.name), schema.name, schema.definition});
  }
  McapFile mcap(file, channels);
  for (const PlantedMessage& message : messages)
    mcap.add(index_of_topic(message.topic), message.sequence, message.stamp_ns, message.bytes);
  mcap.finish();
}

}  // namespace

PlantedRecording::PlantedRecording(const std::string& format)
    : format_(format), name_(format == "rosbag" ? "bend_0.bag" : "bend_0.mcap") {
  const std::filesystem::path from = rendered(kBend, kRecordings, {"--frames", "2..7"}) / format / name_;
  const RecordedFile recording = format == "rosbag" ? read_bag(from) : read_mcap(from);
  for (const RecordedMessage& message : recording.messages)
    messages.push_back({recording.topics[message.topic].name, message.stamp_ns, message.sequence.value_or(0),
                        message_bytes(recording, message)});
}

std::vector<PlantedMessage*> PlantedRecording::of(const std::string& topic) {
  std::vector<PlantedMessage*> found;
  for (PlantedMessage& message : messages)
    if (message.topic == topic) found.push_back(&message);
  return found;
}

void PlantedRecording::remove(const std::vector<std::string>& topics, std::int64_t stamp_ns) {
  std::erase_if(messages, [&](const PlantedMessage& message) {
    return message.stamp_ns == stamp_ns && std::ranges::count(topics, message.topic) > 0;
  });
}

void PlantedRecording::write() const {
  AtomicFile written(file());
  format_ == "rosbag" ? write_planted_bag(written, messages) : write_planted_mcap(written, messages);
  written.move_into_place();
}

std::string PlantedRecording::faults() const {
  write();
  return faults_of(folder_.path(), format_);
}

void swap_pixels(PlantedMessage& one, PlantedMessage& other) {
  std::swap_ranges(one.bytes.end() - kPixelBytes, one.bytes.end(), other.bytes.end() - kPixelBytes);
}

}  // namespace stereobench::harness
