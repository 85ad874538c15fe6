/// A second way to see a world: one ray a pixel, in double precision, without GL and without any of the
/// renderer's code. Slow and obvious on purpose.
#pragma once

#include <vector>

#include "renderer/meshes/mesh_file.h"
#include "slam/types.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::renderer::test {

/// What a ray meets first.
struct RayHit {
  int ball_id = 0;       ///< 0 = no ball, k = World::balls[k - 1]
  int surface = 0;       ///< 0 = nothing, else a number for each ball, wall, triangle and the floor
  double depth_m = 0.0;  ///< planar Z, +inf for nothing
  double edge_px = 1e9;  ///< how far the ray passes from the outline of the nearest outline, about
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< that is met, world frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();   ///< there, towards the camera, in its frame
};

class RayCaster {
 public:
  /// @param triangles of all meshes, already in the world frame
  RayCaster(worlds::World world, vision::StereoRig rig, std::vector<Triangle> triangles = {});

  void stand_at(const slam::Pose& world_from_robot, vision::Side side);

  /// @param u,v (0, 0) is the centre of the top-left pixel
  RayHit look(double u, double v) const;

  /// A point of the world in the camera's frame.
  Eigen::Vector3d in_camera(const Eigen::Vector3d& point_m) const;

  /// What number primitives.h has for a surface of this caster's.
  int primitive(int surface) const;

  /// The colour without noise: materials must be plain, light ambient only. Red, green, blue in [0, 1].
  Eigen::Vector3d ball_or_sky_colour(double u, double v) const;

 private:
  Eigen::Vector3d normal_of(int surface, const Eigen::Vector3d& point_m) const;

  worlds::World world_;
  vision::StereoRig rig_;
  std::vector<Triangle> triangles_;
  Eigen::Vector3d origin_, forward_, right_, down_;
};

}  // namespace stereobench::renderer::test
