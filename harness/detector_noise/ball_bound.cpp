#include "harness/detector_noise/ball_bound.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "vision/camera/rig.h"
#include "vision/stereo/range_bearing.h"

namespace stereobench::harness {
namespace {

/// Covariance of the ball's place, its radius being known by its tolerance.
Eigen::Matrix3d place_covariance(Eigen::Matrix4d information, double radius_sd_m) {
  if (!(radius_sd_m > 0.0)) return information.topLeftCorner<3, 3>().inverse();
  information(3, 3) += 1.0 / (radius_sd_m * radius_sd_m);
  return information.inverse().topLeftCorner<3, 3>();
}

}  // namespace

BallBounds ball_bounds(const vision::StereoRig& rig, const vision::SizedBall& ball, double radius_sd_m,
                       const std::array<Eigen::Matrix3d, 2>& information) {
  const vision::SizedBall in_right = ball - vision::SizedBall(rig.baseline_m, 0.0, 0.0, 0.0);
  const vision::SeenOutline left = vision::seen_outline(rig.intrinsics, ball);
  const vision::SeenOutline right = vision::seen_outline(rig.intrinsics, in_right);
  for (const Eigen::Matrix3d& camera : information)
    if (!(camera.topLeftCorner<2, 2>().determinant() > 0.0)) return {};
  const Eigen::Isometry3d robot_from_camera = vision::robot_from_camera(rig);
  const auto in_robot = [&](const Eigen::Matrix3d& covariance_m2) -> Eigen::Matrix2d {
    return vision::range_bearing(ball.head<3>(), covariance_m2, robot_from_camera).covariance;
  };
  const vision::OutlineCentres centres = {left.outline_px.head<2>(), right.outline_px.head<2>(),
                                          information[0].topLeftCorner<2, 2>().inverse(),
                                          information[1].topLeftCorner<2, 2>().inverse()};
  const Eigen::Matrix4d of_ball = left.by_ball.transpose() * information[0] * left.by_ball +
                                  right.by_ball.transpose() * information[1] * right.by_ball;
  return {in_robot(place_covariance(of_ball, radius_sd_m)),
          in_robot(vision::ball_covariance(rig, centres, ball.w()))};
}

}  // namespace stereobench::harness
