#include "worlds/visibility/view_cone.h"

#include <cmath>

#include "slam/math/elementary.h"

namespace stereobench::worlds {

CameraPose camera_pose(const vision::StereoRig& rig, vision::Side side, const slam::Pose& world_from_robot) {
  const auto [s, c] = slam::sine_cosine(world_from_robot.heading_rad);
  Eigen::Isometry3d robot = Eigen::Isometry3d::Identity();
  robot.linear() << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  robot.translation() << world_from_robot.x_m, world_from_robot.y_m, 0.0;
  const Eigen::Isometry3d placed = robot * vision::robot_from_camera(rig, side);
  return {rig.intrinsics, rig.distortion.pixel_aspect, placed.inverse(), placed.translation()};
}

std::vector<Sphere> spheres_around_shapes(const World& world) {
  std::vector<Sphere> spheres;
  for (const MeshInstance& mesh : world.meshes) {
    const Eigen::Vector3d size_m = mesh.unit_m * mesh.scale;
    const Eigen::Vector3d middle_m = mesh.position_m + Eigen::Vector3d(0.0, 0.0, 0.5 * size_m.z());
    if (mesh.shape == MeshShape::kFile) continue;
    if (mesh.roll_rad != 0.0 || mesh.pitch_rad != 0.0)
      spheres.push_back({mesh.position_m, Eigen::Vector3d(size_m.x(), size_m.y(), 2.0 * size_m.z()).norm()});
    else if (mesh.shape == MeshShape::kBall)
      spheres.push_back({middle_m, 0.5 * size_m.maxCoeff()});
    else
      spheres.push_back({middle_m, 0.5 * size_m.norm()});
  }
  return spheres;
}

std::optional<Cone> cone_around(const CameraPose& camera, const Sphere& sphere) {
  const Eigen::Vector3d in_camera = camera.camera_from_world * sphere.centre_m;
  const double distance_m = in_camera.norm();
  if (distance_m <= sphere.radius_m) return std::nullopt;
  const double tangent_m = std::sqrt(distance_m * distance_m - sphere.radius_m * sphere.radius_m);
  return Cone{in_camera / distance_m, slam::arc_tangent(sphere.radius_m, tangent_m), distance_m, tangent_m};
}

bool overlap(const Cone& a, const Cone& b) {
  const double between_rad =
      slam::arc_tangent(a.direction.cross(b.direction).norm(), a.direction.dot(b.direction));
  return between_rad < a.half_angle_rad + b.half_angle_rad;
}

bool hides(const std::optional<Cone>& thing, const Cone& cone) {
  return !thing || (thing->tangent_m < cone.tangent_m && overlap(*thing, cone));
}

}  // namespace stereobench::worlds
