/// Spheres as a camera has them: the cones that they fill.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "vision/camera/rig.h"
#include "worlds/types.h"

namespace stereobench::worlds {

/// A camera and its pose in the world.
struct CameraPose {
  vision::Intrinsics intrinsics;
  double pixel_aspect = 1.0;
  Eigen::Isometry3d camera_from_world;
  Eigen::Vector3d centre_m;  ///< world frame
};

CameraPose camera_pose(const vision::StereoRig& rig, vision::Side side, const slam::Pose& world_from_robot);

struct Sphere {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< world frame
  double radius_m = 0.0;
};

/// A sphere around each mesh that is a shape; files are not read here.
std::vector<Sphere> spheres_around_shapes(const World& world);

struct Cone {
  Eigen::Vector3d direction;  ///< unit length, camera frame
  double half_angle_rad = 0.0;
  double distance_m = 0.0;  ///< to the centre
  double tangent_m = 0.0;   ///< to where rays touch
};

/// @return none from inside
std::optional<Cone> cone_around(const CameraPose& camera, const Sphere& sphere);

bool overlap(const Cone& a, const Cone& b);

/// Whether a thing stands before any of what fills the cone; of spheres apart, the one with the shorter
/// tangents is in front. From inside, all is hidden.
bool hides(const std::optional<Cone>& thing, const Cone& cone);

}  // namespace stereobench::worlds
