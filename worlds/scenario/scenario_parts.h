/// The parts of a scenario, each read from its group of keys.
#pragma once

#include <optional>
#include <vector>

#include "worlds/generate/layout.h"
#include "worlds/types.h"
#include "worlds/yaml/fields.h"

namespace stereobench::worlds {

/// The finite factors that a colour may have.
inline constexpr Interval kTint = {0.0, 4.0};

/// What numbers in scenario files may be.
inline constexpr Interval kPlace_m = {-1e4, 1e4};
inline constexpr Interval kSize_m = {1e-3, 1e4};
inline constexpr Interval kTurn_deg = {-360.0, 360.0};
inline constexpr Interval kShare = {0.0, 1.0};

inline constexpr std::size_t kOurMaterials = 6;  ///< all but a file's

/// `world.ball_radius_m`, of balls that do not say theirs.
double read_ball_radius_m(const YamlMap& world);

/// `world:` balls, walls, meshes, floor, light and sky. Mesh files, relative to the folder, must exist. A
/// generator's world has no lists of balls and walls of its own.
World read_world(const YamlValue& value);

/// An entry of `world.meshes`. @param balls those that it may stand under
MeshInstance read_mesh(const YamlValue& value, const std::vector<Ball>& balls);

/// `path:` a circle, a polyline, a smooth curve, a figure eight, a recorded trajectory, or the tour of a
/// generated world, driven.
/// @param layout of the world, where it is generated
GroundTruth read_path(const YamlValue& value, const Layout* layout);

/// Refuses a lens through which more is seen than can be drawn.
/// @param value of `rig:`, which the rig was read from
void check_lens(const YamlValue& value, const vision::StereoRig& rig);

/// A line of corners: a wall from each to the next.
struct WallLine {
  std::vector<Eigen::Vector2d> corners_m;
  bool closed = false;  ///< whether a wall leads from the last corner to the first
  Wall wall;            ///< what they all look like
};

/// The keys of each group of a scenario, and the members that they fill.
const Fields<World>& world_keys();  ///< lists of balls, walls and meshes are read by read_world
const Fields<Ball>& ball_keys();
const Fields<WallLine>& wall_keys();
const Fields<Light>& light_keys();
const Fields<MeshInstance>& mesh_keys();
const Fields<MeshLimits>& mesh_limit_keys();
const Fields<SurfaceTexture>& surface_texture_keys();
const KeyGroup& generator_keys();
const KeyGroup& path_keys();
const Fields<vision::StereoRig>& rig_keys();
const Fields<Scenario>& believed_rig_keys();  ///< whose believed rig is the true one before
const Fields<CameraSensor>& camera_keys();
const Fields<Shutter>& shutter_keys();
const Fields<slam::OdometryNoise>& odometry_noise_keys();
const Fields<StartNoise>& start_noise_keys();
const Fields<OracleSensor>& oracle_keys();
const Fields<Randomisation>& randomisation_keys();
const Fields<SurfaceLooks>& surface_keys();
const Fields<BallColours>& ball_colour_keys();
const Fields<LightRanges>& light_range_keys();
const Fields<Clutter>& clutter_keys();
const Fields<Distractors>& distractor_keys();

}  // namespace stereobench::worlds
