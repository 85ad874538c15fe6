/// Views of a board whose truth is known: as points, and as rendered pictures.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "harness/rig_calibration/types.h"
#include "slam/math/random.h"
#include "vision/camera/rig.h"

namespace stereobench::harness::test {

/// Where a board is held: turned by up to half a radian about each axis, and somewhere in both cameras' view.
inline std::vector<Eigen::Isometry3d> board_places(const Board& board, std::size_t views,
                                                   std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const Eigen::Vector3d middle = 0.5 * board.corner_m(board.corners() - 1);
  std::vector<Eigen::Isometry3d> places;
  for (std::size_t i = 0; i < views; ++i) {
    Eigen::Isometry3d left_from_board = Eigen::Isometry3d::Identity();
    left_from_board.linear() = (Eigen::AngleAxisd(between(-0.3, 0.3), Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(between(-0.6, 0.6), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(between(-0.6, 0.6), Eigen::Vector3d::UnitX()))
                                   .matrix();
    const double depth = between(0.55, 0.9);
    const Eigen::Vector3d centre(0.06 + depth * between(-0.2, 0.2), depth * between(-0.15, 0.15), depth);
    left_from_board.translation() = centre - left_from_board.linear() * middle;
    places.push_back(left_from_board);
  }
  return places;
}

/// The rig that the tests look through: a lens, and a right camera that is turned.
inline vision::StereoRig faulty_rig() {
  vision::StereoRig rig;
  rig.intrinsics = {1024, 768, 887.0, 505.0, 390.0};
  rig.right_turn_rad = {0.010, -0.015, 0.005};
  rig.distortion = {.k1 = -0.2, .k2 = 0.05, .p1 = 0.0005, .p2 = -0.0008};
  return rig;
}

/// The corners as a rig shows them, each coordinate off by Gaussian noise.
inline std::vector<BoardView> seen_through(const vision::StereoRig& rig, const Board& board,
                                           const std::vector<Eigen::Isometry3d>& places, double noise_px,
                                           std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kImageNoise);
  std::vector<BoardView> views;
  for (const Eigen::Isometry3d& place : places) {
    BoardView view{.name = std::to_string(views.size())};
    for (int i = 0; i < board.corners(); ++i) {
      const Eigen::Vector3d point = place * board.corner_m(i);
      for (const vision::Side side : {vision::Side::kLeft, vision::Side::kRight}) {
        const Eigen::Vector2d noise(random.normal(), random.normal());
        view.corners_px[static_cast<std::size_t>(side)].push_back(
            vision::image_point(rig, vision::camera_point(rig, point, side)) + noise_px * noise);
      }
    }
    views.push_back(view);
  }
  return views;
}

/// How far a fit is from a rig in standard deviations, for each parameter that was fitted: of both cameras,
/// the right camera's place, and its turn.
inline std::vector<double> deviations(const RigFit& fit, const vision::StereoRig& rig, RigModel model) {
  CameraParameters truth;
  const vision::Distortion& lens = rig.distortion;
  truth << rig.intrinsics.focal_px, rig.intrinsics.cx_px, rig.intrinsics.cy_px, lens.k1, lens.k2, lens.p1,
      lens.p2, lens.k3, lens.pixel_aspect;
  std::vector<double> result;
  const auto add = [&](double error, double sd) {
    if (sd > 0.0) result.push_back(error / sd);
  };
  for (std::size_t side = 0; side < (model == RigModel::kOneCamera ? 1U : 2U); ++side)
    for (int i = 0; i < kCameraSize; ++i) add(fit.cameras[side][i] - truth[i], fit.cameras_sd[side][i]);
  const Eigen::Matrix3d turn = vision::robot_from_camera(rig).linear().transpose() *
                               vision::robot_from_camera(rig, vision::Side::kRight).linear();
  const Eigen::AngleAxisd true_turn(turn);
  const Eigen::Vector3d turn_error = fit.turn_rad - true_turn.angle() * true_turn.axis();
  for (int i = 0; i < 3; ++i) {
    add(fit.right_in_left_m[i] - (i == 0 ? rig.baseline_m : 0.0), fit.right_in_left_sd_m[i]);
    add(turn_error[i], fit.turn_sd_rad[i]);
  }
  return result;
}

}  // namespace stereobench::harness::test
