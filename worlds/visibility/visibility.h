/// Which balls a robot can see from where it stands, by geometry alone.
#pragma once

#include <vector>

#include "worlds/types.h"

namespace stereobench::worlds {

/// What a ball must be, to count as seen by a stereo camera.
inline constexpr double kLeastRadius_px = 5.0;  ///< smaller ones vision does not measure
inline constexpr double kBorder_px = 2.0;       ///< between its outline and the picture's border

/// The balls in view: by stereo, those that both cameras see whole, large enough, with no wall, no mesh of a
/// file and no other ball in front of any of it, nor a sphere around a box or another shape; by the oracle,
/// those in its sector, whatever stands between.
///
/// @param world the scenario's, or that of a seed
/// @param slack_m each ball may lie this far from where it should: only those count that are seen anyway
/// @return indices into world.balls, ascending
/// @throws std::invalid_argument by stereo, where a mesh of a file has no solid (occluders.h)
std::vector<int> balls_in_view(const Scenario& scenario, const World& world,
                               const slam::Pose& world_from_robot, double slack_m = 0.0);

/// How far, and how wide to each side, a robot looks, if nothing hides what is there.
struct ViewSector {
  double range_m = 0.0;
  double half_angle_rad = 0.0;
};

/// As far as a ball is large enough to be measured, and as wide as the picture of the left camera.
ViewSector view_sector(const vision::StereoRig& rig, double ball_radius_m);

/// Whether the lines from a to b and from c to d have a point in common.
bool segments_meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                   const Eigen::Vector2d& d);

/// The distance on the floor from a point to a wall.
double distance_m(const Eigen::Vector2d& point_m, const Wall& wall);

}  // namespace stereobench::worlds
