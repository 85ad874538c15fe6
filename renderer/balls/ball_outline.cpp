#include "renderer/balls/ball_outline.h"

#include <algorithm>
#include <cmath>

#include "worlds/generate/paint.h"

namespace stereobench::renderer {
namespace {

constexpr double kMargin_px = 1.0;  // pixels whose centre is up to sqrt(1/2) outside are still partly covered

float narrow(double value) {
  return static_cast<float>(value);
}

struct Ellipse {
  Eigen::Vector2d centre_ray;  // line of sight of the centre, z = 1
  Eigen::Vector2d centre_px;
  Eigen::Vector2d half_extent_px;
  Eigen::Matrix2d shape;  // q' S q = 1 on the outline, px^-2
  double peak_m2;         // the discriminant at the centre
};

/// With c = (X, Y, Z) and k = |c|^2 - R^2, the discriminant is the quadric p' (c c' - k I) p; completing the
/// square around its maximum gives the ellipse's centre, its shape and its height in closed form.
Ellipse ellipse_of(const vision::Intrinsics& camera, const Eigen::Vector3d& c, double radius_m) {
  const double r2 = radius_m * radius_m;
  const double k = c.squaredNorm() - r2;
  const double ahead = c.z() * c.z() - r2;
  const double f = camera.focal_px;
  Ellipse result;
  result.centre_ray = c.head<2>() * (c.z() / ahead);
  result.centre_px = f * result.centre_ray + Eigen::Vector2d(camera.cx_px, camera.cy_px);
  result.half_extent_px = Eigen::Vector2d(std::sqrt(k - c.y() * c.y()), std::sqrt(k - c.x() * c.x()));
  result.half_extent_px *= f * radius_m / ahead;
  result.peak_m2 = r2 * k / ahead;
  result.shape =
      (k * Eigen::Matrix2d::Identity() - c.head<2>() * c.head<2>().transpose()) / (result.peak_m2 * f * f);
  return result;
}

std::array<float, 4> visible_bounds(const vision::Intrinsics& camera, const Ellipse& ellipse) {
  const Eigen::Vector2d reach = ellipse.half_extent_px.array() + kMargin_px;
  const Eigen::Vector2d low = device_point(camera, ellipse.centre_px - reach).cwiseMax(-1.0);
  const Eigen::Vector2d high = device_point(camera, ellipse.centre_px + reach).cwiseMin(1.0);
  return {narrow(low.x()), narrow(low.y()), narrow(high.x()), narrow(high.y())};
}

std::array<float, 4> split_centre(const CameraView& view, const Eigen::Vector2d& centre_px) {
  const Eigen::Vector2d whole = centre_px.array().round();
  const Eigen::Vector2d rest = centre_px - whole;
  return {narrow(whole.x() + 0.5 + view.first_column_px), narrow(whole.y() + 0.5), narrow(rest.x()),
          narrow(rest.y())};
}

std::array<float, 4> colour_of(const worlds::Ball& ball, int identity) {
  const Eigen::Vector3d rgb = worlds::paint_of(ball);
  return {narrow(rgb.x()), narrow(rgb.y()), narrow(rgb.z()), narrow(identity / 255.0)};
}

}  // namespace

std::optional<BallOutline> ball_outline(const CameraView& view, const worlds::Ball& ball, int identity) {
  const Eigen::Vector3d c = view.camera_from_world * ball.centre_m;
  if (!(c.z() - ball.radius_m > kNear_m)) return std::nullopt;
  const Ellipse ellipse = ellipse_of(view.intrinsics, c, ball.radius_m);
  const std::array<float, 4> bounds = visible_bounds(view.intrinsics, ellipse);
  if (!(bounds[0] < bounds[2] && bounds[1] < bounds[3])) return std::nullopt;
  const Eigen::Vector3d ray = ellipse.centre_ray.homogeneous();
  return BallOutline{
      .centre = split_centre(view, ellipse.centre_px),
      .shape = {narrow(ellipse.shape(0, 0)), narrow(ellipse.shape(0, 1)), narrow(ellipse.shape(1, 1)),
                narrow(ellipse.peak_m2)},
      .ray = {narrow(ray.x()), narrow(ray.y()), narrow(ray.dot(c)), narrow(1.0 / view.intrinsics.focal_px)},
      .ball = {narrow(c.x()), narrow(c.y()), narrow(c.z()), narrow(1.0 / ball.radius_m)},
      .colour = colour_of(ball, identity),
      .bounds = bounds};
}

}  // namespace stereobench::renderer
