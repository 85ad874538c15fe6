#include "tests/renderer/ray_caster.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "vision/palette.h"

namespace stereobench::renderer::test {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kNearest_m = 0.01;

/// Depth at which the ray enters the ball; `miss` is by how much it passes its surface (negative: hits).
double enter_ball(const worlds::Ball& ball, const Eigen::Vector3d& origin, const Eigen::Vector3d& ray,
                  double& miss) {
  const Eigen::Vector3d to_centre = ball.centre_m - origin;
  const double middle = to_centre.dot(ray) / ray.squaredNorm();
  const double apart = (to_centre - middle * ray).norm();
  miss = apart - ball.radius_m;
  if (miss >= 0.0 || middle <= 0.0) return kNever;
  return middle - std::sqrt(ball.radius_m * ball.radius_m - apart * apart) / ray.norm();
}

double meet_wall(const worlds::Wall& wall, const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  const Eigen::Vector2d run = wall.to_m - wall.from_m;
  const Eigen::Vector2d across(-run.y(), run.x());
  const double t = across.dot(wall.from_m - origin.head<2>()) / across.dot(ray.head<2>());
  const Eigen::Vector3d point = origin + t * ray;
  const double along = (point.head<2>() - wall.from_m).dot(run) / run.squaredNorm();
  const bool hit =
      t > kNearest_m && along >= 0.0 && along <= 1.0 && point.z() >= 0.0 && point.z() <= wall.height_m;
  return hit ? t : kNever;
}

double meet_triangle(const Triangle& triangle, const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  Eigen::Matrix3d system;
  system << -ray, triangle.corners[1] - triangle.corners[0], triangle.corners[2] - triangle.corners[0];
  if (std::abs(system.determinant()) < 1e-14) return kNever;
  const Eigen::Vector3d found = system.inverse() * (origin - triangle.corners[0]);
  const bool hit =
      found.x() > kNearest_m && found.y() >= 0.0 && found.z() >= 0.0 && found.y() + found.z() <= 1.0;
  return hit ? found.x() : kNever;
}

}  // namespace

RayCaster::RayCaster(worlds::World world, vision::StereoRig rig, std::vector<Triangle> triangles)
    : world_(std::move(world)), rig_(rig), triangles_(std::move(triangles)) {
  stand_at({}, vision::Side::kLeft);
}

void RayCaster::stand_at(const slam::Pose& pose, vision::Side side) {
  const double heading = pose.heading_rad;
  const double pitch = rig_.pitch_down_rad;
  forward_ = {std::cos(heading) * std::cos(pitch), std::sin(heading) * std::cos(pitch), -std::sin(pitch)};
  right_ = {std::sin(heading), -std::cos(heading), 0.0};
  down_ = forward_.cross(right_);
  const double side_m = (side == vision::Side::kLeft ? -0.5 : 0.5) * rig_.baseline_m;
  origin_ = Eigen::Vector3d(pose.x_m, pose.y_m, rig_.height_m) + side_m * right_;
  if (side == vision::Side::kLeft) return;
  Eigen::Matrix3d axes;
  axes << right_, down_, forward_;
  for (int axis = 0; axis < 3; ++axis) {  // about its x as it is, then about the new y, then the new z
    axes = Eigen::AngleAxisd(rig_.right_turn_rad[axis], axes.col(axis)).toRotationMatrix() * axes;
  }
  right_ = axes.col(0);
  down_ = axes.col(1);
  forward_ = axes.col(2);
}

RayHit RayCaster::look(double u, double v) const {
  const vision::Intrinsics& camera = rig_.intrinsics;
  const Eigen::Vector3d ray = forward_ + right_ * ((u - camera.cx_px) / camera.focal_px) +
                              down_ * ((v - camera.cy_px) / camera.focal_px);
  RayHit hit;
  hit.depth_m = kNever;
  int surface = 0;
  const auto meet = [&](double depth_m, int ball_id) {
    ++surface;
    if (!(depth_m < hit.depth_m)) return;
    hit.ball_id = ball_id;
    hit.surface = surface;
    hit.depth_m = depth_m;
  };
  for (std::size_t k = 0; k < world_.balls.size(); ++k) {
    double miss = 0.0;
    const double depth_m = enter_ball(world_.balls[k], origin_, ray, miss);
    hit.edge_px =
        std::min(hit.edge_px, std::abs(miss) * camera.focal_px / (world_.balls[k].centre_m - origin_).norm());
    meet(depth_m, static_cast<int>(k) + 1);
  }
  for (const worlds::Wall& wall : world_.walls) meet(meet_wall(wall, origin_, ray), 0);
  for (const Triangle& triangle : triangles_) meet(meet_triangle(triangle, origin_, ray), 0);
  meet(world_.has_floor && ray.z() < 0.0 ? -origin_.z() / ray.z() : kNever, 0);
  if (hit.surface == 0) return hit;
  hit.point_m = origin_ + hit.depth_m * ray;
  const Eigen::Vector3d normal = normal_of(hit.surface, hit.point_m);
  const Eigen::Vector3d facing = normal.dot(ray) > 0.0 ? Eigen::Vector3d(-normal) : normal;
  hit.normal = {facing.dot(right_), facing.dot(down_), facing.dot(forward_)};
  return hit;
}

Eigen::Vector3d RayCaster::in_camera(const Eigen::Vector3d& point_m) const {
  const Eigen::Vector3d offset = point_m - origin_;
  return {offset.dot(right_), offset.dot(down_), offset.dot(forward_)};
}

Eigen::Vector3d RayCaster::normal_of(int surface, const Eigen::Vector3d& point_m) const {
  std::size_t index = static_cast<std::size_t>(surface - 1);
  if (index < world_.balls.size()) return (point_m - world_.balls[index].centre_m).normalized();
  index -= world_.balls.size();
  if (index < world_.walls.size()) {
    const Eigen::Vector2d run = world_.walls[index].to_m - world_.walls[index].from_m;
    return Eigen::Vector3d(-run.y(), run.x(), 0.0).normalized();
  }
  index -= world_.walls.size();
  if (index == triangles_.size()) return Eigen::Vector3d::UnitZ();
  const Triangle& triangle = triangles_[index];
  return (triangle.corners[1] - triangle.corners[0])
      .cross(triangle.corners[2] - triangle.corners[0])
      .normalized();
}

int RayCaster::primitive(int surface) const {
  const int balls = static_cast<int>(world_.balls.size());
  const int flats = static_cast<int>(world_.walls.size() + triangles_.size());
  if (surface <= balls) return surface;
  return surface == balls + flats + 1 ? 255 : 256 + surface - balls - 1;
}

Eigen::Vector3d RayCaster::ball_or_sky_colour(double u, double v) const {
  const int id = look(u, v).ball_id;
  if (id == 0) return world_.sky_rgb;
  const auto& colour =
      vision::kPalette.at(static_cast<std::size_t>(world_.balls[static_cast<std::size_t>(id - 1)].colour));
  return world_.light.ambient * Eigen::Vector3d(colour.r, colour.g, colour.b) / 255.0;
}

}  // namespace stereobench::renderer::test
