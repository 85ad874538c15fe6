#include "harness/dataset/formats/container/webdataset_format.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/drive_json.h"
#include "harness/dataset/formats/container/pair_parts.h"
#include "harness/dataset/formats/container/tar_file.h"
#include "harness/dataset/formats/format_limits.h"
#include "harness/io/text_file.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using vision::Side;

Json point_json(const Eigen::Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

/// Four lists of four numbers: the rows.
Json rows_json(const Eigen::Isometry3d& pose) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back(Json::array());
    for (int column = 0; column < 4; ++column) rows.back().push_back(pose.matrix()(row, column));
  }
  return rows;
}

/// What is known of a ball that a picture of the step shows.
Json ball_json(const DatasetDrive& drive, std::size_t step, const Json& seen) {
  const worlds::Ball& ball = drive.world.balls.at(seen.at("ball_id").get<std::size_t>());
  Json json = {{"ball_id", seen.at("ball_id")},
               {"colour", ball.colour},
               {"radius_m", ball.radius_m},
               {"centre_in_world_m", point_json(ball.centre_m)}};
  for (const Side side : kBothSides) {
    const char* camera = side == Side::kLeft ? "left" : "right";
    json[camera] = {
        {"centre_in_camera_m", point_json(world_from_camera(drive, step, side).inverse() * ball.centre_m)}};
    const Json none = {{"px_count_visib", 0}, {"bbox_visib", {-1, -1, -1, -1}}};
    json[camera].update(seen.at(camera).is_null() ? none : seen.at(camera));
  }
  return json;
}

/// @param rigs what dataset.json says of the drive
std::string sample_json(const DatasetDrive& drive, const Json& rigs, std::size_t step, const Json& visible) {
  const DriveStep& now = drive.steps[step];
  Json balls = Json::array();
  for (const Json& seen : visible) balls.push_back(ball_json(drive, step, seen));
  const Json json = {{"drive", drive.name},
                     {"seed", drive.seed},
                     {"step", step},
                     {"t_s", static_cast<double>(now.stamp_ns) / static_cast<double>(kSecond_ns)},
                     {"late_s", now.pictures.value().late_s},
                     {"encoding", rigs.at("encoding")},
                     {"rig", rigs.at("rig")},
                     {"believed_rig", rigs.at("believed_rig")},
                     {"world_from_robot", rows_json(world_from_robot(now.world_from_robot))},
                     {"world_from_left_camera", rows_json(world_from_camera(drive, step, Side::kLeft))},
                     {"world_from_right_camera", rows_json(world_from_camera(drive, step, Side::kRight))},
                     {"balls", balls}};
  return json.dump() + "\n";
}

class WebdatasetWriter final : public DatasetWriter {
 public:
  explicit WebdatasetWriter(const DatasetDrive& drive)
      : drive_(drive), taken_(steps_with_pictures(drive)), rigs_(drive_json(drive)) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override { return pair_parts(pair); }
  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override { return {}; }
  std::vector<DatasetContainer> containers(const MeasurementLog&) const override {
    std::vector<DatasetContainer> shards;
    for (std::size_t first = 0; first < taken_.size(); first += kPairsOfShard) {
      const auto write = [this, first](AtomicFile& file, const std::filesystem::path& folder) {
        const std::size_t count = std::min(kPairsOfShard, taken_.size() - first);
        write_shard(std::span(taken_).subspan(first, count), file, folder);
      };
      shards.push_back({fmt::format("{}-{:06}.tar", stem(), shards.size()), write});
    }
    return shards;
  }

 private:
  std::string stem() const { return fmt::format("{}_{}", drive_.name, drive_.seed); }

  void write_shard(std::span<const std::size_t> steps, AtomicFile& file,
                   const std::filesystem::path& folder) const {
    TarFile tar(file);
    for (const std::size_t step : steps) {
      const std::string key = fmt::format("{}_{:06}", stem(), step);
      tar.add(key + ".json", sample_json(drive_, rigs_, step, visible_balls_part(folder, step)));
      tar.add(key + ".left.png", read_text(picture_part(folder, step, Side::kLeft)));
      tar.add(key + ".right.png", read_text(picture_part(folder, step, Side::kRight)));
    }
    tar.finish();
  }

  const DatasetDrive& drive_;
  std::vector<std::size_t> taken_;
  Json rigs_;
};

}  // namespace

void check_webdataset_format(const DatasetDrive& drive) {
  FormatLimits{"webdataset", "cameras that have one pose in a picture"}.require_whole_pictures(drive);
}

std::unique_ptr<DatasetWriter> webdataset_writer(const DatasetDrive& drive) {
  return std::make_unique<WebdatasetWriter>(drive);
}

}  // namespace stereobench::harness
