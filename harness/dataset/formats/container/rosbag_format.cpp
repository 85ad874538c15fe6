#include "harness/dataset/formats/container/rosbag_format.h"

#include <fmt/format.h>

#include "harness/dataset/formats/container/bag_file.h"
#include "harness/dataset/formats/container/pair_parts.h"
#include "harness/dataset/formats/container/ros_drive.h"

namespace stereobench::harness {
namespace {

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

class RosbagWriter final : public DatasetWriter {
 public:
  explicit RosbagWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override { return pair_parts(pair); }
  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }
  std::vector<DatasetContainer> containers(const MeasurementLog& log) const override {
    return {{fmt::format("{}_{}.bag", drive_.name, drive_.seed),
             [this, &log](AtomicFile& file, const std::filesystem::path& folder) {
               write_bag(drive_, log, file, folder);
             }}};
  }

 private:
  const DatasetDrive& drive_;
};

}  // namespace

void check_rosbag_format(const DatasetDrive& drive) {
  check_ros_drive(drive, "rosbag");
}

std::unique_ptr<DatasetWriter> rosbag_writer(const DatasetDrive& drive) {
  return std::make_unique<RosbagWriter>(drive);
}

}  // namespace stereobench::harness
