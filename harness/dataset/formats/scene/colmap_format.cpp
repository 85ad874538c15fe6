#include "harness/dataset/formats/scene/colmap_format.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "renderer/truth/ball_truth.h"
#include "vision/camera/rig.h"
#include "worlds/generate/paint.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// A ball's centre in a picture.
struct SeenCentre {
  std::size_t ball = 0;
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< the first pixel's centre is (0, 0)
};

/// A picture of the model.
struct ModelPicture {
  std::size_t step = 0;
  Side side = Side::kLeft;
  std::vector<SeenCentre> seen;  ///< in order of the balls
};

int camera_number(Side side) {
  return side == Side::kLeft ? 1 : 2;
}

std::size_t picture_number(const ModelPicture& picture) {
  return 2 * picture.step + (picture.side == Side::kLeft ? 1 : 2);
}

std::string picture_name(std::size_t step, Side side) {
  return fmt::format("{}/{:06}.png", side == Side::kLeft ? "left" : "right", step);
}

std::vector<SeenCentre> seen_centres(const DatasetDrive& drive, DatasetPair& pair, Side side) {
  const Eigen::Isometry3d camera_from_world = world_from_camera(drive, pair.step(), side).inverse();
  const auto pixels = renderer::pixels_by_id(pair.ball_id(side));
  std::vector<SeenCentre> seen;
  for (std::size_t ball = 0; ball < drive.world.balls.size(); ++ball) {
    if (pixels[ball + 1].count == 0) continue;
    const Eigen::Vector2d px =
        vision::image_point(drive.rig, camera_from_world * drive.world.balls[ball].centre_m);
    if (vision::is_inside(drive.rig.intrinsics, px)) seen.push_back({ball, px});
  }
  return seen;
}

/// A camera's model and its parameters. COLMAP's places begin at the first pixel's corner.
std::string camera_parameters(const vision::StereoRig& rig) {
  const vision::Intrinsics& camera = rig.intrinsics;
  const vision::Distortion& lens = rig.distortion;
  const bool is_straight = lens == vision::Distortion{.pixel_aspect = lens.pixel_aspect};
  std::string text = fmt::format("{} {} {} {} {} {} {}",
                                 is_straight      ? "PINHOLE"
                                 : lens.k3 == 0.0 ? "OPENCV"
                                                  : "FULL_OPENCV",
                                 camera.width_px, camera.height_px, camera.focal_px,
                                 camera.focal_px * lens.pixel_aspect, camera.cx_px + 0.5, camera.cy_px + 0.5);
  if (!is_straight) text += fmt::format(" {} {} {} {}", lens.k1, lens.k2, lens.p1, lens.p2);
  if (lens.k3 != 0.0) text += fmt::format(" {} 0 0 0", lens.k3);
  return text;
}

class ColmapWriter final : public DatasetWriter {
 public:
  explicit ColmapWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    std::vector<DatasetFile> files;
    for (const Side side : kBothSides) {
      pictures_.push_back({pair.step(), side, seen_centres(drive_, pair, side)});
      files.push_back(camera_file("images/" + picture_name(pair.step(), side), pair, side));
    }
    return files;
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override {
    return {text_file("sparse/0/cameras.txt", cameras_text()),
            text_file("sparse/0/images.txt", pictures_text()),
            text_file("sparse/0/points3D.txt", points_text())};
  }

 private:
  std::string cameras_text() const {
    std::string text = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
    for (const Side side : kBothSides)
      text += fmt::format("{} {}\n", camera_number(side), camera_parameters(drive_.rig));
    return text;
  }
  std::string pictures_text() const;
  std::string points_text() const;

  const DatasetDrive& drive_;
  mutable std::vector<ModelPicture> pictures_;  ///< of the pairs so far: the model is one file a drive
};

std::string ColmapWriter::pictures_text() const {
  std::string text =
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  for (const ModelPicture& picture : pictures_) {
    const Eigen::Isometry3d pose = world_from_camera(drive_, picture.step, picture.side).inverse();
    const Eigen::Quaterniond turn = unit_quaternion(pose.linear());
    const Eigen::Vector3d& shift = pose.translation();
    text += fmt::format("{} {} {} {} {} {} {} {} {} {}\n", picture_number(picture), turn.w(), turn.x(),
                        turn.y(), turn.z(), shift.x(), shift.y(), shift.z(), camera_number(picture.side),
                        picture_name(picture.step, picture.side));
    std::string points;
    for (const SeenCentre& centre : picture.seen)
      points += fmt::format("{}{} {} {}", points.empty() ? "" : " ", centre.px.x() + 0.5, centre.px.y() + 0.5,
                            centre.ball + 1);
    text += points + "\n";
  }
  return text;
}

std::string ColmapWriter::points_text() const {
  std::vector<std::string> tracks(drive_.world.balls.size());
  for (const ModelPicture& picture : pictures_)
    for (std::size_t i = 0; i < picture.seen.size(); ++i)
      tracks[picture.seen[i].ball] += fmt::format(" {} {}", picture_number(picture), i);
  std::string text = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (std::size_t ball = 0; ball < tracks.size(); ++ball) {
    if (tracks[ball].empty()) continue;
    const Eigen::Vector3d& at = drive_.world.balls[ball].centre_m;
    const Eigen::Vector3d rgb = 255.0 * worlds::paint_of(drive_.world.balls[ball]);
    text += fmt::format("{} {} {} {} {} {} {} 0{}\n", ball + 1, at.x(), at.y(), at.z(), std::lround(rgb.x()),
                        std::lround(rgb.y()), std::lround(rgb.z()), tracks[ball]);
  }
  return text;
}

}  // namespace

void check_colmap_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"colmap", "pictures of one instant each, and one calibration"};
  limits.require_believed(drive);
  limits.require_whole_pictures(drive);
}

std::unique_ptr<DatasetWriter> colmap_writer(const DatasetDrive& drive) {
  return std::make_unique<ColmapWriter>(drive);
}

}  // namespace stereobench::harness
