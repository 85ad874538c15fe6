#include "vision/stereo/sphere.h"

#include <cmath>

#include "slam/math/elementary.h"
#include "vision/camera/rig.h"

namespace stereobench::vision {

double OutlineEllipse::radius_px() const {
  return std::sqrt(semi_major_px * semi_minor_px);
}

Eigen::Vector2d OutlineEllipse::half_extent_px() const {
  const auto [s, c] = slam::sine_cosine(angle_rad);
  const Eigen::Vector2d axes(semi_major_px, semi_minor_px);
  return {Eigen::Vector2d(c, s).cwiseProduct(axes).norm(), Eigen::Vector2d(s, c).cwiseProduct(axes).norm()};
}

bool lies_inside(const Intrinsics& camera, const OutlineEllipse& outline) {
  const Eigen::Vector2d low = outline.centre_px - outline.half_extent_px();
  const Eigen::Vector2d high = outline.centre_px + outline.half_extent_px();
  return low.minCoeff() >= -0.5 && high.x() <= camera.width_px - 0.5 && high.y() <= camera.height_px - 0.5;
}

std::optional<OutlineEllipse> sphere_outline(const Intrinsics& camera, const Eigen::Vector3d& ball_in_camera,
                                             double radius_m) {
  const double depth = ball_in_camera.z();
  if (!(depth > radius_m)) return std::nullopt;
  const double gap = depth * depth - radius_m * radius_m;
  const double minor = radius_m / std::sqrt(gap);
  const double stretch = std::sqrt((ball_in_camera.squaredNorm() - radius_m * radius_m) / gap);
  const Eigen::Vector2d centre = ball_in_camera.head<2>() * (depth / gap);  // (1 + b^2) (X/Z, Y/Z)

  OutlineEllipse ellipse;
  ellipse.centre_px = Eigen::Vector2d(camera.cx_px, camera.cy_px) + camera.focal_px * centre;
  ellipse.semi_minor_px = camera.focal_px * minor;
  ellipse.semi_major_px = camera.focal_px * minor * stretch;
  ellipse.angle_rad = slam::arc_tangent(centre.y(), centre.x());
  return ellipse;
}

SeenOutline seen_outline(const Intrinsics& camera, const SizedBall& ball) {
  const double z = ball.z();
  const double radius = ball.w();
  const double gap = z * z - radius * radius;
  const double tangent2 = ball.head<3>().squaredNorm() - radius * radius;  // squared length of a tangent
  const double f = camera.focal_px;
  SeenOutline seen;
  for (int axis = 0; axis < 2; ++axis) {
    seen.outline_px[axis] = f * ball[axis] * z / gap + (axis == 0 ? camera.cx_px : camera.cy_px);
    seen.by_ball(axis, axis) = f * z / gap;
    seen.by_ball(axis, 2) = f * ball[axis] * (1.0 - 2.0 * z * z / gap) / gap;
    seen.by_ball(axis, 3) = 2.0 * f * ball[axis] * z * radius / (gap * gap);
  }
  const double outline_radius = f * radius * std::sqrt(std::sqrt(tangent2 / gap) / gap);
  seen.outline_px[2] = outline_radius;
  const double by_tangent = 0.5 * outline_radius / tangent2;
  const double by_gap = -1.5 * outline_radius / gap;
  seen.by_ball.row(2) << by_tangent * ball.x(), by_tangent * ball.y(), (by_tangent + by_gap) * z,
      outline_radius / radius - (by_tangent + by_gap) * radius;
  return seen;
}

double ball_depth(double triangulated_depth_m, double radius_m) {
  const double zn = triangulated_depth_m;
  return 0.5 * (zn + std::sqrt(zn * zn + 4.0 * radius_m * radius_m));
}

std::optional<Eigen::Vector3d> triangulate_ball(const StereoRig& rig, const Eigen::Vector2d& left_px,
                                                const Eigen::Vector2d& right_px, double radius_m) {
  const double disparity_px = left_px.x() - right_px.x();
  if (!(disparity_px > 0.0)) return std::nullopt;
  const double zn = rig.intrinsics.focal_px * rig.baseline_m / disparity_px;
  const Eigen::Vector2d pixel(left_px.x(), 0.5 * (left_px.y() + right_px.y()));
  Eigen::Vector3d ball_in_camera = zn * pixel_ray(rig.intrinsics, pixel);
  ball_in_camera.z() = ball_depth(zn, radius_m);
  return ball_in_camera;
}

}  // namespace stereobench::vision
