#include "harness/dataset/pictures/changed_pair.h"

#include <cmath>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/pictures/area_mean.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {

using renderer::BallTruth;
using renderer::Correspondence;
using renderer::PixelTruth;
using vision::Side;

namespace {

Side opposite(Side side) {
  return side == Side::kLeft ? Side::kRight : Side::kLeft;
}

/// A place of the whole picture in the changed one.
Eigen::Vector2d moved(const Eigen::Vector2d& place_px, const PictureChange& change) {
  const Eigen::Vector2d first =
      change.crop ? Eigen::Vector2d(change.crop->x, change.crop->y) : Eigen::Vector2d(0.0, 0.0);
  const Eigen::Vector2d half(0.5, 0.5);
  return (place_px - first + half) / change.divide - half;
}

BallTruth moved(BallTruth truth, const PictureChange& change) {
  truth.centre_px = moved(truth.centre_px, change);
  truth.outline.centre_px = moved(truth.outline.centre_px, change);
  truth.outline.semi_major_px /= change.divide;
  truth.outline.semi_minor_px /= change.divide;
  return truth;
}

/// What now lies out of the other picture is seen there no more.
void mark_outside(Correspondence& found, const vision::Intrinsics& camera) {
  for (int row = 0; row < found.occlusion.rows; ++row)
    for (int column = 0; column < found.occlusion.cols; ++column) {
      const auto& shift = found.shift_px.at<cv::Vec2f>(row, column);
      const Eigen::Vector2d place(column + static_cast<double>(shift[0]),
                                  row + static_cast<double>(shift[1]));
      if (std::isfinite(shift[0]) && !vision::is_inside(camera, place))
        found.occlusion.at<std::uint8_t>(row, column) =
            static_cast<std::uint8_t>(renderer::Occlusion::kOutside);
    }
}

}  // namespace

std::optional<std::filesystem::path> ChangedPair::file_of(Side side) const {
  return change_.changes_pictures() ? std::nullopt : whole_.file_of(side);
}

cv::Mat ChangedPair::cut(const cv::Mat& picture) const {
  return change_.crop ? picture(*change_.crop).clone() : picture;
}

PixelTruth ChangedPair::cut(const PixelTruth& pixels) const {
  return {cut(pixels.surface), cut(pixels.range_m), cut(pixels.normal)};
}

Correspondence ChangedPair::cut(const Correspondence& found) const {
  return {cut(found.shift_px), cut(found.occlusion)};
}

renderer::CameraView ChangedPair::view_at(const Eigen::Isometry3d& world_from_camera) const {
  return {.camera_from_world = world_from_camera.inverse(),
          .intrinsics = drive_.rig.intrinsics,
          .lens = drive_.rig.distortion};
}

ScaledLook ChangedPair::look(Side side) const {
  return {change_.divide, view_at(world_from_camera(drive_, step(), side)), drive_.rig.baseline_m};
}

const ScaledTruth& ChangedPair::scaled(Side side) {
  std::optional<ScaledTruth>& known = known_of(side).scaled;
  if (!known)
    known = scaled_truth(cut(whole_.ball_id(side)), cut(whole_.depth_m(side)), look(side), drive_.world);
  return *known;
}

cv::Mat ChangedPair::picture(Side side) {
  return in_kind(area_mean(cut(whole_.picture(side)), change_.divide), change_.kind);
}

cv::Mat ChangedPair::ball_id(Side side) {
  return change_.divide > 1 ? scaled(side).ball_id : cut(whole_.ball_id(side));
}

cv::Mat ChangedPair::depth_m(Side side) {
  return change_.divide > 1 ? scaled(side).depth_m : cut(whole_.depth_m(side));
}

const PixelTruth& ChangedPair::pixels(Side side) {
  std::optional<PixelTruth>& known = known_of(side).pixels;
  if (known) return *known;
  known = cut(whole_.pixels(side));
  if (change_.divide > 1) known = scaled_pixels(*known, scaled(side), look(side), drive_.world);
  return *known;
}

std::vector<BallTruth> ChangedPair::balls(Side side) {
  std::vector<BallTruth> truths;
  for (const BallTruth& truth : whole_.balls(side)) truths.push_back(moved(truth, change_));
  return renderer::counted(std::move(truths), drive_.rig.intrinsics, ball_id(side));
}

const Correspondence& ChangedPair::to_other_camera(Side side) {
  std::optional<Correspondence>& known = known_of(side).to_other_camera;
  if (known) return *known;
  known = cut(whole_.to_other_camera(side));
  if (change_.divide > 1)
    known = scaled_correspondence(*known, scaled(side), look(side).view, look(opposite(side)).view);
  else
    mark_outside(*known, drive_.rig.intrinsics);
  return *known;
}

const Correspondence& ChangedPair::to_next_step(Side side) {
  std::optional<Correspondence>& known = known_of(side).to_next_step;
  if (known) return *known;
  known = cut(whole_.to_next_step(side));
  const Eigen::Isometry3d next = world_from_robot(drive_.steps.at(step() + 1).world_from_robot) *
                                 vision::robot_from_camera(drive_.rig, side);
  if (change_.divide > 1)
    known = scaled_correspondence(*known, scaled(side), look(side).view, view_at(next));
  else
    mark_outside(*known, drive_.rig.intrinsics);
  return *known;
}

}  // namespace stereobench::harness
