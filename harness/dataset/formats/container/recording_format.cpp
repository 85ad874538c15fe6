#include "harness/dataset/formats/container/recording_format.h"

#include <fmt/format.h>

#include "harness/dataset/formats/container/bag_file.h"
#include "harness/dataset/formats/container/mcap_file.h"
#include "harness/dataset/formats/container/pair_parts.h"
#include "harness/dataset/formats/container/ros_drive.h"

namespace stereobench::harness {
namespace {

using WriteRecording = void (*)(const DatasetDrive& drive, const MeasurementLog& log, AtomicFile& file,
                                const std::filesystem::path& folder);

void write_bag(const DatasetDrive& drive, const MeasurementLog& log, AtomicFile& file,
               const std::filesystem::path& folder) {
  std::vector<BagConnection> connections;
  for (const RosTopic& topic : kRosTopics) {
    RosSchema schema = ros_schema(topic.type, RosVersion::kOne);
    connections.push_back({std::string(topic.name), std::move(schema.name), std::move(schema.md5),
                           std::move(schema.definition), topic.is_latched});
  }
  BagFile bag(file, std::move(connections));
  play_ros_drive(drive, log, RosVersion::kOne, folder,
                 [&](const RosEvent& event) { bag.add(event.topic, event.stamp_ns, event.message); });
  bag.finish();
}

void write_mcap(const DatasetDrive& drive, const MeasurementLog& log, AtomicFile& file,
                const std::filesystem::path& folder) {
  std::vector<McapChannel> channels;
  for (const RosTopic& topic : kRosTopics) {
    RosSchema schema = ros_schema(topic.type, RosVersion::kTwo);
    channels.push_back({std::string(topic.name), std::move(schema.name), std::move(schema.definition)});
  }
  McapFile mcap(file, std::move(channels));
  play_ros_drive(drive, log, RosVersion::kTwo, folder, [&](const RosEvent& event) {
    mcap.add(event.topic, event.sequence, event.stamp_ns, event.message);
  });
  mcap.finish();
}

/// Writes one container, which has the whole drive.
class RecordingWriter final : public DatasetWriter {
 public:
  /// @param ending of the container's name
  RecordingWriter(const DatasetDrive& drive, const char* ending, WriteRecording write)
      : drive_(drive), ending_(ending), write_(write) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override { return pair_parts(pair); }
  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }
  std::vector<DatasetContainer> containers(const MeasurementLog& log) const override {
    return {{fmt::format("{}_{}{}", drive_.name, drive_.seed, ending_),
             [this, &log](AtomicFile& file, const std::filesystem::path& folder) {
               write_(drive_, log, file, folder);
             }}};
  }

 private:
  const DatasetDrive& drive_;
  const char* ending_;
  WriteRecording write_;
};

}  // namespace

void check_rosbag_format(const DatasetDrive& drive) {
  check_ros_drive(drive, "rosbag");
}

void check_mcap_format(const DatasetDrive& drive) {
  check_ros_drive(drive, "mcap");
}

std::unique_ptr<DatasetWriter> rosbag_writer(const DatasetDrive& drive) {
  return std::make_unique<RecordingWriter>(drive, ".bag", write_bag);
}

std::unique_ptr<DatasetWriter> mcap_writer(const DatasetDrive& drive) {
  return std::make_unique<RecordingWriter>(drive, ".mcap", write_mcap);
}

}  // namespace stereobench::harness
