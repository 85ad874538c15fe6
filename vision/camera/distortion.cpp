#include "vision/camera/distortion.h"

#include <Eigen/LU>

#include "vision/camera/rig.h"

namespace stereobench::vision {
namespace {

/// 1 + k1 r^2 + k2 r^4 + k3 r^6, and its derivative by r^2.
struct Radial {
  double factor;
  double by_r2;
};

Radial radial_at(const Distortion& lens, double r2) {
  return {1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3)),
          lens.k1 + r2 * (2.0 * lens.k2 + r2 * 3.0 * lens.k3)};
}

}  // namespace

Eigen::Matrix2d distortion_slope(const Distortion& lens, const Eigen::Vector2d& direction) {
  const double x = direction.x();
  const double y = direction.y();
  const Radial radial = radial_at(lens, direction.squaredNorm());
  const double both = 2.0 * (lens.p1 * x + lens.p2 * y);
  Eigen::Matrix2d decentred;
  decentred << 2.0 * lens.p1 * y + 6.0 * lens.p2 * x, both, both, 6.0 * lens.p1 * y + 2.0 * lens.p2 * x;
  Eigen::Matrix2d slope = radial.factor * Eigen::Matrix2d::Identity() +
                          2.0 * radial.by_r2 * direction * direction.transpose() + decentred;
  slope.row(1) *= lens.pixel_aspect;
  return slope;
}

Eigen::Vector2d distort(const Distortion& lens, const Eigen::Vector2d& direction) {
  const double x = direction.x();
  const double y = direction.y();
  const double r2 = direction.squaredNorm();
  const double radial = radial_at(lens, r2).factor;
  return {x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x),
          lens.pixel_aspect * (y * radial + lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y)};
}

std::optional<Eigen::Vector2d> undistort(const Distortion& lens, const Eigen::Vector2d& place,
                                         const Eigen::Vector2d& start) {
  constexpr int kSteps = 20;
  constexpr double kConverged = 1e-13;
  Eigen::Vector2d direction = start;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::Matrix2d slope = distortion_slope(lens, direction);
    if (!(slope.determinant() > 0.0)) return std::nullopt;
    const Eigen::Vector2d change = slope.inverse() * (place - distort(lens, direction));
    direction += change;
    if (change.norm() <= kConverged * (1.0 + direction.norm())) return direction;
  }
  return std::nullopt;
}

std::optional<Eigen::Vector2d> undistort(const Distortion& lens, const Eigen::Vector2d& place) {
  constexpr int kStages = 32;
  if (lens == Distortion{}) return place;
  std::optional<Eigen::Vector2d> direction = Eigen::Vector2d::Zero();
  for (int stage = 1; stage <= kStages && direction; ++stage)
    direction = undistort(lens, place * stage / kStages, *direction);
  return direction;
}

std::optional<std::vector<Eigen::Vector2d>> border_directions(const Distortion& lens,
                                                              const Intrinsics& camera) {
  constexpr int kCells = 64;
  std::vector<Eigen::Vector2d> seen;
  for (int i = 0; i <= kCells; ++i) {
    const double x = camera.width_px * i / double{kCells} - 0.5;
    const double y = camera.height_px * i / double{kCells} - 0.5;
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(x, -0.5), Eigen::Vector2d(x, camera.height_px - 0.5), Eigen::Vector2d(-0.5, y),
          Eigen::Vector2d(camera.width_px - 0.5, y)}) {
      const auto direction = undistort(lens, pixel_ray(camera, pixel).head<2>());
      if (!direction || !(direction->cwiseAbs().maxCoeff() <= kWidestTangent)) return std::nullopt;
      seen.push_back(*direction);
    }
  }
  return seen;
}

std::optional<Eigen::AlignedBox2d> directions_seen(const Distortion& lens, const Intrinsics& camera) {
  const auto border = border_directions(lens, camera);
  if (!border) return std::nullopt;
  Eigen::AlignedBox2d seen;
  for (const Eigen::Vector2d& direction : *border) seen.extend(direction);
  return seen;
}

}  // namespace stereobench::vision
