#include "harness/detector/ball_geometry.h"

#include "slam/math/elementary.h"
#include "vision/camera/rig.h"
#include "vision/stereo/range_bearing.h"

namespace stereobench::harness {

Eigen::Vector3d at_camera_height(const vision::StereoRig& rig, const slam::RangeBearing& seen) {
  const auto [s, c] = slam::sine_cosine(seen.bearing_rad);
  return vision::robot_from_camera(rig).inverse() *
         Eigen::Vector3d(seen.range_m * c, seen.range_m * s, rig.height_m);
}

ExpectedOutlines expected_outlines(const BallGeometry& geometry, const vision::BallObservation& ball) {
  const vision::Intrinsics& camera = geometry.rig.intrinsics;
  const Eigen::Vector3d in_right =
      vision::camera_point(geometry.rig, ball.ball_in_camera, vision::Side::kRight);
  return {vision::sphere_outline(camera, ball.ball_in_camera, geometry.radius_m),
          vision::sphere_outline(camera, in_right, geometry.radius_m)};
}

bool imagine_pixels(const BallGeometry& geometry, vision::BallObservation& ball) {
  const vision::Intrinsics& camera = geometry.rig.intrinsics;
  const auto [left, right] = expected_outlines(geometry, ball);
  if (!left || !right) return false;
  ball.left_px = vision::image_point(geometry.rig, vision::pixel_ray(camera, left->centre_px));
  ball.right_px = vision::image_point(geometry.rig, vision::pixel_ray(camera, right->centre_px));
  ball.left_radius_px = left->radius_px();
  ball.right_radius_px = right->radius_px();
  return true;
}

RectifiedCentres rectified_centres(const BallGeometry& geometry, const vision::BallObservation& ball) {
  return {vision::rectified_point(geometry.rig, ball.left_px, vision::Side::kLeft),
          vision::rectified_point(geometry.rig, ball.right_px, vision::Side::kRight)};
}

std::optional<Eigen::Vector3d> place_of(const BallGeometry& geometry, const RectifiedCentres& centres) {
  if (!centres.left || !centres.right) return {};
  return vision::triangulate_ball(geometry.rig, *centres.left, *centres.right, geometry.radius_m);
}

slam::RangeBearing seen_through(const BallGeometry& geometry, const vision::BallObservation& ball,
                                double sd_px) {
  const Eigen::Matrix2d of_centre = sd_px * sd_px * Eigen::Matrix2d::Identity();
  const auto [left, right] = rectified_centres(geometry, ball);
  const vision::OutlineCentres centres = {left.value_or(ball.left_px), right.value_or(ball.right_px),
                                          of_centre, of_centre};
  return vision::range_bearing(ball.ball_in_camera,
                               vision::ball_covariance(geometry.rig, centres, geometry.radius_m),
                               vision::robot_from_camera(geometry.rig));
}

}  // namespace stereobench::harness
