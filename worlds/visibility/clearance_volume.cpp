#include "worlds/visibility/clearance_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace stereobench::worlds {
namespace {

constexpr double kNear_m = 0.01;  // what is nearer to a camera is not in its picture

/// A triangle, as planes cut it.
class Polygon {
 public:
  explicit Polygon(const TriangleCorners& corners) : size_(corners.size()) {
    std::ranges::copy(corners, corners_.begin());
  }

  /// Leaves what is in the half-space (Sutherland and Hodgman, CACM 17, 1974).
  void cut(const HalfSpace& half) {
    const Polygon whole = *this;
    size_ = 0;
    for (std::size_t i = 0; i < whole.size_; ++i) {
      const Eigen::Vector3d& here = whole.corners_[i];
      const Eigen::Vector3d& next = whole.corners_[(i + 1) % whole.size_];
      const double inside = half.dot(here.homogeneous());
      const double then = half.dot(next.homogeneous());
      if (inside >= 0.0) corners_[size_++] = here;
      if ((inside >= 0.0) != (then >= 0.0))
        corners_[size_++] = here + inside / (inside - then) * (next - here);
    }
  }
  std::span<const Eigen::Vector3d> corners() const { return {corners_.data(), size_}; }

 private:
  // A cut makes one corner more; of slivers, whose corners lie on a plane up to rounding, half as many more.
  std::array<Eigen::Vector3d, 12> corners_;
  std::size_t size_;
};

/// The half-space, which is told in axes of the world, in a clearance volume's.
HalfSpace in_volume(const Eigen::Isometry3d& volume_from_world, const HalfSpace& world) {
  return volume_from_world.inverse().matrix().transpose() * world;
}

/// The four planes of a mip chain, or a square column, around a clearance volume.
std::array<HalfSpace, 4> sides_of(const ClearanceVolume& volume) {
  const HalfSpace away(0.0, 0.0, volume.narrows ? volume.radius : 0.0, volume.narrows ? 0.0 : volume.radius);
  const HalfSpace x = HalfSpace::UnitX(), y = HalfSpace::UnitY();
  return {away + x, away - x, away + y, away - y};
}

double squared_distance_of_origin(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double length = along.squaredNorm();
  const double share = length > 0.0 ? std::clamp(-from.dot(along) / length, 0.0, 1.0) : 0.0;
  return (from + share * along).squaredNorm();
}

/// Whether a polygon has a point within a circle around the origin: an edge comes near enough, or a ray from
/// the origin along x crosses an odd number of edges. Corners may be there twice, as cuts through a corner
/// leave them.
bool meets_circle(std::span<const Eigen::Vector2d> corners, double radius) {
  bool is_around = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % corners.size()];
    if (squared_distance_of_origin(from, to) <= radius * radius) return true;
    if ((from.y() > 0.0) == (to.y() > 0.0)) continue;
    const double turn = from.x() * to.y() - from.y() * to.x();
    if ((turn > 0.0) == (to.y() > from.y())) is_around = !is_around;
  }
  return is_around;
}

/// @param corners in the clearance volume's axes
bool meets(const ClearanceVolume& volume, const TriangleCorners& corners) {
  Polygon polygon(corners);
  for (const HalfSpace& cut : volume.cuts) polygon.cut(cut);
  std::array<Eigen::Vector2d, 12> along_z;
  for (std::size_t i = 0; i < polygon.corners().size(); ++i) {
    const Eigen::Vector3d& corner = polygon.corners()[i];
    along_z[i] = corner.head<2>() / (volume.narrows ? corner.z() : 1.0);
  }
  const Sphere& excused = volume.excused;
  return meets_circle({along_z.data(), polygon.corners().size()}, volume.radius) &&
         !std::ranges::all_of(polygon.corners(), [&](const Eigen::Vector3d& corner) {
           return (corner - excused.centre_m).norm() < excused.radius_m;
         });
}

}  // namespace

ClearanceVolume visibility_volume(const Eigen::Vector3d& camera_m, const Sphere& ball, double slack_m) {
  const double core_m = (1.0 - kRim) * ball.radius_m;
  const double radius_m = core_m + slack_m;
  const double distance_m = (ball.centre_m - camera_m).norm();
  const double squared_tangent = distance_m * distance_m - radius_m * radius_m;
  Eigen::Isometry3d world = Eigen::Isometry3d::Identity();
  world.linear().col(2) = (ball.centre_m - camera_m) / distance_m;
  world.linear().col(0) = world.linear().col(2).unitOrthogonal();
  world.linear().col(1) = world.linear().col(2).cross(world.linear().col(0));
  world.translation() = camera_m;
  const Eigen::Isometry3d from_world = world.inverse();
  // No line of sight is lower than both its ends, and none goes on behind where the cone touches the ball.
  const double low_m = std::min(camera_m.z(), ball.centre_m.z() - core_m);
  return {.from_world = from_world,
          .narrows = true,
          .radius = radius_m / std::sqrt(squared_tangent),
          .cuts = {{0.0, 0.0, 1.0, -kNear_m},
                   {0.0, 0.0, -1.0, squared_tangent / distance_m},
                   in_volume(from_world, {0.0, 0.0, 1.0, -low_m})},
          .excused = {{0.0, 0.0, distance_m}, std::max(ball.radius_m - slack_m, 0.0)}};
}

ClearanceVolume upright_cylinder(const Eigen::Vector2d& at_m, double radius_m, double low_m, double high_m) {
  Eigen::Isometry3d from_world = Eigen::Isometry3d::Identity();
  from_world.translation().head<2>() = -at_m;
  return {.from_world = from_world,
          .radius = radius_m,
          .cuts = {{0.0, 0.0, 1.0, -low_m}, {0.0, 0.0, -1.0, high_m}}};
}

bool meets(const ClearanceVolume& volume, const TriangleBvh& tree, const Eigen::Affine3d& world_from_tree) {
  const Eigen::Affine3d volume_from_tree = volume.from_world * world_from_tree;
  std::vector<HalfSpace> within(volume.cuts);
  std::ranges::copy(sides_of(volume), std::back_inserter(within));
  for (HalfSpace& half : within) half = (volume_from_tree.matrix().transpose() * half).eval();
  return tree.any(within, [&](const TriangleCorners& corners) {
    return meets(volume, {volume_from_tree * corners[0], volume_from_tree * corners[1],
                          volume_from_tree * corners[2]});
  });
}

}  // namespace stereobench::worlds
