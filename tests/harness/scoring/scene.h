/// Small worlds of balls with the identities that a renderer would give, for tests that score vision.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "harness/vision_scoring/vision_score.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {

inline vision::StereoRig small_rig() {
  vision::StereoRig rig;
  rig.intrinsics = {320, 240, 300.0, 159.5, 119.5};
  return rig;
}

/// Which ball each pixel's centre sees, by rays and spheres: shares nothing with the closed-form outline.
inline cv::Mat ball_ids(const worlds::World& world, const vision::StereoRig& rig, const slam::Pose& pose,
                        vision::Side side) {
  const Eigen::Isometry3d robot_from_camera = vision::robot_from_camera(rig, side);
  const Eigen::AngleAxisd turn(pose.heading_rad, Eigen::Vector3d::UnitZ());
  const Eigen::Isometry3d world_from_camera =
      Eigen::Translation3d(pose.x_m, pose.y_m, 0.0) * turn * robot_from_camera;
  cv::Mat ids(rig.intrinsics.height_px, rig.intrinsics.width_px, CV_8UC1, cv::Scalar(0));
  for (int v = 0; v < ids.rows; ++v) {
    for (int u = 0; u < ids.cols; ++u) {
      const Eigen::Vector3d ray =
          world_from_camera.linear() * vision::pixel_ray(rig.intrinsics, {u, v}).normalized();
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < world.balls.size(); ++i) {
        const Eigen::Vector3d offset = world.balls[i].centre_m - world_from_camera.translation();
        const double along = offset.dot(ray);
        const double miss = std::pow(world.balls[i].radius_m, 2) - (offset - along * ray).squaredNorm();
        if (miss < 0.0 || along < 0.0 || along >= nearest) continue;
        nearest = along;
        ids.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(i + 1);
      }
    }
  }
  return ids;
}

/// A world with its rendered identities.
struct Scene {
  worlds::World world;
  vision::StereoRig rig = small_rig();
  slam::Pose pose;
  renderer::StereoFrame frame;

  explicit Scene(std::vector<worlds::Ball> balls, const slam::Pose& world_from_robot = {})
      : pose(world_from_robot) {
    world.balls = std::move(balls);
    frame.left.ball_id = ball_ids(world, rig, pose, vision::Side::kLeft);
    frame.right.ball_id = ball_ids(world, rig, pose, vision::Side::kRight);
  }
  VisionTruth truth() const { return {world, rig, pose, frame}; }
};

/// What a perfect observer says of a ball.
inline vision::BallObservation perfect(const BallInPair& outline, int colour) {
  vision::BallObservation observation;
  observation.colour = colour;
  observation.left_px = outline.left.centre_px;
  observation.right_px = outline.right.centre_px;
  observation.range_bearing.range_m = outline.ball_in_robot.head<2>().norm();
  observation.range_bearing.bearing_rad = std::atan2(outline.ball_in_robot.y(), outline.ball_in_robot.x());
  observation.range_bearing.covariance = Eigen::Vector2d(1e-4, 1e-6).asDiagonal();
  return observation;
}

inline const worlds::Ball kAhead{{1.0, 0.1, 0.3}, 0.1, 3};
inline const worlds::Ball kBehindIt{{1.6, 0.1, 0.3}, 0.1, 5};
inline const worlds::Ball kAside{{1.5, -0.45, 0.35}, 0.08, 5};
inline const worlds::Ball kCut{{1.0, 0.55, 0.3}, 0.1, 7};
inline const worlds::Ball kAtTheBack{{-1.0, 0.0, 0.3}, 0.1, 8};

/// How much of a ball a camera sees past the others, by counting what its rays hit.
inline double seen_fraction(const worlds::Ball& ball, const worlds::Ball& in_front, vision::Side side) {
  const worlds::World alone{.balls = {ball}};
  const worlds::World both{.balls = {ball, in_front}};
  const cv::Mat seen = ball_ids(both, small_rig(), {}, side) == 1;
  return static_cast<double>(cv::countNonZero(seen)) /
         static_cast<double>(cv::countNonZero(ball_ids(alone, small_rig(), {}, side)));
}

inline VisionScore score_observations(const VisionTruth& truth,
                                      std::span<const vision::BallObservation> observations) {
  return score_match(match_observations(truth, observations));
}

}  // namespace stereobench::harness
