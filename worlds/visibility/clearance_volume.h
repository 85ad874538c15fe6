/// Rooms that must be empty: what a camera looks through, and where something is to stand.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "worlds/visibility/triangle_bvh.h"
#include "worlds/visibility/view_cone.h"

namespace stereobench::worlds {

/// Balls stand on things that hide some of their undersides. What reaches no farther into the outline than
/// this share of the radius hides 5 % of the disc, and counts as nothing, as it does for scores of detectors.
inline constexpr double kRim = 0.19;

/// A cone from its origin along z, or a cylinder around z, between planes; in axes of its own.
struct ClearanceVolume {
  Eigen::Isometry3d from_world;
  bool narrows = false;         ///< towards its origin: a cone
  double radius = 0.0;          ///< metres, of a cone for each metre from the origin
  std::vector<HalfSpace> cuts;  ///< it ends there, at most three; a cone's leave out its origin
  Sphere excused;               ///< a triangle whose part between the cuts lies all in here is not met
};

/// What must be empty for a camera to see all of a ball but its rim: all between the camera and what it sees
/// of the ball. A triangle whose part before the ball's rim lies within the ball hides nothing, nor does what
/// is nearer to the camera than its picture begins.
/// @param slack_m the ball may lie that far aside, at the same height
/// @param ball the camera is not in it, slack included
ClearanceVolume visibility_volume(const Eigen::Vector3d& camera_m, const Sphere& ball, double slack_m);

/// An upright cylinder.
ClearanceVolume upright_cylinder(const Eigen::Vector2d& at_m, double radius_m, double low_m, double high_m);

/// Whether a triangle has a point in common with a clearance volume.
/// @param world_from_tree where its triangles are
bool meets(const ClearanceVolume& volume, const TriangleBvh& tree, const Eigen::Affine3d& world_from_tree);

}  // namespace stereobench::worlds
