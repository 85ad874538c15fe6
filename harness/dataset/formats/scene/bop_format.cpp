#include "harness/dataset/formats/scene/bop_format.h"

#include <array>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/formats/scene/bop_objects.h"
#include "harness/dataset/truth/bop_numbers.h"
#include "harness/dataset/truth/truth_pictures.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using renderer::BallTruth;
using vision::Side;

constexpr double kMmPerLevel = 0.2;

Json numbers_of(const Eigen::Matrix3d& matrix) {
  Json json = Json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) json.push_back(matrix(row, column));
  return json;
}

Json millimetres(const Eigen::Vector3d& at_m) {
  return {kMmPerMetre * at_m.x(), kMmPerMetre * at_m.y(), kMmPerMetre * at_m.z()};
}

/// A camera's three files: what they say of each step.
struct SceneFiles {
  Json camera = Json::object(), poses = Json::object(), balls = Json::object();
};

class BopWriter final : public DatasetWriter {
 public:
  explicit BopWriter(const DatasetDrive& drive) : drive_(drive), objects_(drive.world) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    std::vector<DatasetFile> files;
    for (const Side side : kBothSides) add_side(pair, side, files);
    return files;
  }
  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override;

 private:
  std::string scene_folder(Side side) const {
    return fmt::format("test_{}/{:06}", side == Side::kLeft ? "left" : "right", drive_.seed);
  }
  void add_side(DatasetPair& pair, Side side, std::vector<DatasetFile>& files) const;
  Json camera_json(const Eigen::Isometry3d& camera_from_world) const;

  const DatasetDrive& drive_;
  BopObjects objects_;
  mutable std::array<SceneFiles, 2> scenes_;  ///< by Side, of the pairs so far: BOP has one list of all
};

Json BopWriter::camera_json(const Eigen::Isometry3d& camera_from_world) const {
  const vision::Intrinsics& camera = drive_.rig.intrinsics;
  return {{"cam_K", {camera.focal_px, 0.0, camera.cx_px, 0.0, camera.focal_px, camera.cy_px, 0.0, 0.0, 1.0}},
          {"depth_scale", kMmPerLevel},
          {"cam_R_w2c", numbers_of(camera_from_world.linear())},
          {"cam_t_w2c", millimetres(camera_from_world.translation())}};
}

void BopWriter::add_side(DatasetPair& pair, Side side, std::vector<DatasetFile>& files) const {
  const std::string folder = scene_folder(side), step = fmt::format("{:06}", pair.step());
  const Eigen::Isometry3d camera_from_world = world_from_camera(drive_, pair.step(), side).inverse();
  const cv::Mat depth = depth_levels(pair.depth_m(side), kMmPerMetre / kMmPerLevel), ids = pair.ball_id(side);
  files.push_back(camera_file(fmt::format("{}/rgb/{}.png", folder, step), pair, side));
  files.push_back(picture_file(fmt::format("{}/depth/{}.png", folder, step), depth));
  Json poses = Json::array(), balls = Json::array();
  for (const BallTruth& truth : pair.balls(side)) {
    const cv::Mat mask = renderer::mask_within(truth.outline, ids.size());
    const std::string name = fmt::format("{}_{:06}.png", step, poses.size());
    files.push_back(picture_file(fmt::format("{}/mask/{}", folder, name), mask));
    files.push_back(picture_file(fmt::format("{}/mask_visib/{}", folder, name), ids == truth.ball + 1));
    poses.push_back({{"cam_R_m2c", numbers_of(camera_from_world.linear())},
                     {"cam_t_m2c", millimetres(truth.centre_in_camera_m)},
                     {"obj_id", objects_.object_of(static_cast<std::size_t>(truth.ball))}});
    balls.push_back(bop_numbers(truth));
    balls.back()["px_count_valid"] = cv::countNonZero(mask & (depth > 0));
  }
  SceneFiles& scene = scenes_[static_cast<std::size_t>(side)];
  const std::string key = std::to_string(pair.step());
  scene.camera[key] = camera_json(camera_from_world);
  scene.poses[key] = poses;
  scene.balls[key] = balls;
}

std::vector<DatasetFile> BopWriter::drive_files(const MeasurementLog&) const {
  std::vector<DatasetFile> files;
  for (const Side side : kBothSides) {
    const SceneFiles& scene = scenes_[static_cast<std::size_t>(side)];
    files.push_back(text_file(scene_folder(side) + "/scene_camera.json", json_text(scene.camera)));
    files.push_back(text_file(scene_folder(side) + "/scene_gt.json", json_text(scene.poses)));
    files.push_back(text_file(scene_folder(side) + "/scene_gt_info.json", json_text(scene.balls)));
  }
  Json infos = Json::object();
  for (std::size_t i = 0; i < objects_.balls().size(); ++i) {
    infos[std::to_string(i + 1)] = sphere_info(objects_.balls()[i]);
    files.push_back(text_file(fmt::format("models/obj_{:06}.ply", i + 1), sphere_ply(objects_.balls()[i])));
  }
  files.push_back(text_file("models/models_info.json", json_text(infos)));
  const vision::Intrinsics& camera = drive_.rig.intrinsics;
  files.push_back(text_file("camera.json", json_text({{"cx", camera.cx_px},
                                                      {"cy", camera.cy_px},
                                                      {"depth_scale", kMmPerLevel},
                                                      {"fx", camera.focal_px},
                                                      {"fy", camera.focal_px},
                                                      {"height", camera.height_px},
                                                      {"width", camera.width_px}})));
  return files;
}

}  // namespace

void check_bop_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"bop", "pinhole cameras that are known, and pictures of one instant each"};
  limits.require_undistorted(drive);
  limits.require_believed(drive);
  limits.require_whole_pictures(drive);
}

std::unique_ptr<DatasetWriter> bop_writer(const DatasetDrive& drive) {
  return std::make_unique<BopWriter>(drive);
}

}  // namespace stereobench::harness
