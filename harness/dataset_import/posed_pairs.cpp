#include "harness/dataset_import/posed_pairs.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset_import/few_decimals.h"
#include "harness/io/calibration_file.h"
#include "slam/math/angles.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using vision::Side;

[[noreturn]] void refuse_file(const DatasetView& view, const std::string& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}: {}", view.folder.string(), file, what));
}

/// The robots' frames with the rig that vision is told.
void stand_on_robots(const DatasetView& view, std::vector<ViewFrame>& frames) {
  const vision::StereoRig& rig = frames.front().robot.value().rig;
  const std::string calibration = calibration_yaml(rig);
  for (ViewFrame& frame : frames) {
    const ViewRobot& robot = frame.robot.value();
    if (calibration_yaml(robot.rig) != calibration)
      refuse_file(view, view.calibration_file,
                  fmt::format("the rig of {} is not that of {}; import one drive or frame by --only",
                              frame.name, frames.front().name));
    for (const Side side : {Side::kLeft, Side::kRight}) {
      frame.cameras[index_of(side)] = {rig.intrinsics, rig.distortion, vision::robot_from_camera(rig, side)};
      frame.world_from_body[index_of(side)] = robot.world_from_robot;
    }
  }
}

bool is_turn(const Isometry3d& pose) {
  constexpr double kDecimals = 1e-3;  // of somebody's file
  return pose.matrix().allFinite() && pose.linear().isUnitary(kDecimals) && pose.linear().determinant() > 0.0;
}

/// Where the right camera is in the left one, by each pair's poses.
std::vector<Isometry3d> places_of_right(const DatasetView& view, const std::vector<ViewFrame>& frames) {
  std::vector<Isometry3d> places;
  for (const ViewFrame& frame : frames) {
    const auto& [left, right] = frame.world_from_body;
    if (!left || !right)
      refuse_file(
          view, view.poses_file,
          fmt::format("expected a pose of each picture (frame {}): they say how the cameras are mounted",
                      frame.name));
    if (!is_turn(*left) || !is_turn(*right))
      refuse_file(view, view.poses_file,
                  fmt::format("expected poses of a rotation and a shift (frame {})", frame.name));
    const Eigen::Matrix3d left_from_world = left->linear().transpose();
    Isometry3d& place = places.emplace_back(Isometry3d::Identity());
    place.linear() = left_from_world * right->linear();
    place.translation() = left_from_world * (right->translation() - left->translation());
  }
  return places;
}

/// The mean of places that differ little.
Isometry3d mean_of(const std::vector<Isometry3d>& places) {
  const Eigen::Quaterniond first(places.front().linear());
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  Vector3d at_m = Vector3d::Zero();
  for (const Isometry3d& place : places) {
    const Eigen::Quaterniond next(place.linear());
    turn += next.dot(first) < 0.0 ? Eigen::Vector4d(-next.coeffs()) : next.coeffs();
    at_m += place.translation();
  }
  Isometry3d mean = Isometry3d::Identity();
  mean.linear() = Eigen::Quaterniond(Eigen::Vector4d(turn.normalized())).toRotationMatrix();
  mean.translation() = at_m / static_cast<double>(places.size());
  return mean;
}

/// How far a pair is off a rig.
PairSpread off_rig(const Isometry3d& place, const Isometry3d& rig, double focal_px) {
  const double turn_rad = Eigen::AngleAxisd(rig.linear().transpose() * place.linear()).angle();
  return {focal_px * turn_rad, (place.translation() - rig.translation()).norm() / rig.translation().norm()};
}

/// @param rig of the cameras, of places
PairSpread require_fixed(const DatasetView& view, const std::vector<ViewFrame>& frames,
                         const std::vector<Isometry3d>& places, const Isometry3d& rig) {
  constexpr double kMost_px = 0.1, kMostShare = 1e-3;
  const double focal_px = frames.front().cameras[0].pinhole.focal_px;
  PairSpread most;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [px, share] = off_rig(places[i], rig, focal_px);
    if (!(px <= kMost_px && share <= kMostShare))
      refuse_file(view, view.poses_file,
                  fmt::format("expected two cameras that are fixed to each other (frame {}: turned by {:.3g} "
                              "px against the mean of all pairs, {} are allowed, and moved by {:.3g} % of "
                              "the baseline, {} are allowed)",
                              frames[i].name, px, kMost_px, 100.0 * share, 100.0 * kMostShare));
    most = {std::max(most.px, px), std::max(most.share, share)};
  }
  return most;
}

/// How far from the origin any camera is.
double farthest_m(const std::vector<ViewFrame>& frames) {
  double most_m = 0.0;
  for (const ViewFrame& frame : frames)
    for (const auto& pose : frame.world_from_body) most_m = std::max(most_m, pose->translation().norm());
  return most_m;
}

/// Gives a principal point back what another first pixel cost of its last digits.
void shorten(vision::Intrinsics& pinhole) {
  for (double* const at_px : {&pinhole.cx_px, &pinhole.cy_px})
    *at_px = in_few_decimals(*at_px, rounding_of(std::abs(*at_px)));
}

/// Puts the right camera where the poses have it in the mean.
PairSpread mount_right_camera(const DatasetView& view, std::vector<ViewFrame>& frames) {
  const std::vector<Isometry3d> places = places_of_right(view, frames);
  Isometry3d rig = mean_of(places);
  const PairSpread spread = require_fixed(view, frames, places, rig);
  const double rounding_m = rounding_of(farthest_m(frames));
  for (double& at_m : rig.translation()) at_m = in_few_decimals(at_m, rounding_m);
  for (ViewFrame& frame : frames) {
    for (ViewCamera& camera : frame.cameras) shorten(camera.pinhole);
    frame.cameras[1].body_from_camera = rig;
    frame.world_from_body[1] = frame.world_from_body[0];
  }
  return spread;
}

}  // namespace

std::optional<PairSpread> put_on_one_body(const DatasetView& view, ImportedFrames& imported) {
  std::vector<ViewFrame>& frames = imported.frames;
  if (view.poses_of != PosesOf::kEachCamera) return std::nullopt;
  if (frames.front().robot) {
    stand_on_robots(view, frames);
    return std::nullopt;
  }
  if (!view.has_calibration && !frames.front().world_from_body[0]) return std::nullopt;  // pictures alone
  if (!view.has_calibration)
    refuse_file(view, view.calibration_file,
                "expected pinhole cameras, with radial-tangential lenses or none");
  if (!imported.are_pairs)
    refuse_file(view, view.poses_file,
                "expected pairs, which say how two cameras are mounted: pictures of the same name in folders "
                "left and right");
  return mount_right_camera(view, frames);
}

}  // namespace stereobench::harness
