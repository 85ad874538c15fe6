#include "harness/dataset/formats/container/mcap_format.h"

#include <fmt/format.h>

#include "harness/dataset/formats/container/mcap_file.h"
#include "harness/dataset/formats/container/pair_parts.h"
#include "harness/dataset/formats/container/ros_drive.h"

namespace stereobench::harness {
namespace {

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

class McapWriter final : public DatasetWriter {
 public:
  explicit McapWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override { return pair_parts(pair); }
  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }
  std::vector<DatasetContainer> containers(const MeasurementLog& log) const override {
    return {{fmt::format("{}_{}.mcap", drive_.name, drive_.seed),
             [this, &log](AtomicFile& file, const std::filesystem::path& folder) {
               write_mcap(drive_, log, file, folder);
             }}};
  }

 private:
  const DatasetDrive& drive_;
};

}  // namespace

void check_mcap_format(const DatasetDrive& drive) {
  check_ros_drive(drive, "mcap");
}

std::unique_ptr<DatasetWriter> mcap_writer(const DatasetDrive& drive) {
  return std::make_unique<McapWriter>(drive);
}

}  // namespace stereobench::harness
