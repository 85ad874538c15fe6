#include "harness/dataset/formats/scene/nerfstudio_format.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/truth/truth_pictures.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using vision::Side;

constexpr double kLevelsPerMetre = 1000.0;

std::string path(const char* folder, std::size_t step, Side side) {
  return fmt::format("{}/{}/{:06}.png", folder, side == Side::kLeft ? "left" : "right", step);
}

Json rows_of(const Eigen::Matrix4d& matrix) {
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row)
    rows.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
  return rows;
}

/// Both cameras' lens. Nerfstudio's places begin at the first pixel's corner.
Json camera_json(const vision::StereoRig& rig) {
  const vision::Intrinsics& camera = rig.intrinsics;
  const vision::Distortion& lens = rig.distortion;
  return {{"camera_model", "OPENCV"},
          {"fl_x", camera.focal_px},
          {"fl_y", camera.focal_px * lens.pixel_aspect},
          {"cx", camera.cx_px + 0.5},
          {"cy", camera.cy_px + 0.5},
          {"w", camera.width_px},
          {"h", camera.height_px},
          {"k1", lens.k1},
          {"k2", lens.k2},
          {"k3", lens.k3},
          {"k4", 0.0},
          {"p1", lens.p1},
          {"p2", lens.p2}};
}

class NerfstudioWriter final : public DatasetWriter {
 public:
  explicit NerfstudioWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    std::vector<DatasetFile> files;
    for (const Side side : kBothSides) {
      files.push_back(camera_file(path("images", pair.step(), side), pair, side));
      files.push_back(picture_file(path("depth", pair.step(), side), [&pair, side] {
        return depth_levels(pair.depth_m(side), kLevelsPerMetre);
      }));
    }
    return files;
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override {
    const Eigen::Vector4d gl_axes(1.0, -1.0, -1.0, 1.0);
    Json json = camera_json(drive_.rig);
    json["frames"] = Json::array();
    for (const std::size_t step : steps_with_pictures(drive_))
      for (const Side side : kBothSides) {
        const Eigen::Matrix4d pose = world_from_camera(drive_, step, side).matrix() * gl_axes.asDiagonal();
        json["frames"].push_back({{"file_path", path("images", step, side)},
                                  {"depth_file_path", path("depth", step, side)},
                                  {"transform_matrix", rows_of(pose)}});
      }
    return {text_file("transforms.json", json_text(json))};
  }

 private:
  const DatasetDrive& drive_;
};

}  // namespace

void check_nerfstudio_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"nerfstudio", "pictures of one instant each, and one calibration"};
  limits.require_believed(drive);
  limits.require_whole_pictures(drive);
}

std::unique_ptr<DatasetWriter> nerfstudio_writer(const DatasetDrive& drive) {
  return std::make_unique<NerfstudioWriter>(drive);
}

}  // namespace stereobench::harness
