/// The vocabulary of worlds: what can be seen, how the robot moves, and what a scenario says of both.
///
/// Frame **world**: x east, y north, z up; the floor is z = 0.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "slam/types.h"
#include "vision/types.h"
#include "worlds/camera_sensor.h"
#include "worlds/materials.h"
#include "worlds/randomisation.h"

namespace stereobench::worlds {

class TriangleBvh;

/// A coloured ball: a landmark. Its index in World::balls is its identity.
struct Ball {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.05;
  int colour = 0;  ///< index into vision::kPalette
  /// What it is really painted with, where that is not exactly the palette's colour: red, green and blue
  /// under full light, in [0, 1].
  std::optional<Eigen::Vector3d> paint_rgb = {};
  /// Whether it is one of many that were made alike: each seed draws its radius (World::ball_radius_sd_m).
  bool has_usual_radius = false;
};

/// A wall: an upright rectangle without thickness, standing on the floor, seen from both sides.
struct Wall {
  Eigen::Vector2d from_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_m = Eigen::Vector2d::Zero();
  double height_m = 2.5;
  Material material = Material::kPlaster;
  Eigen::Vector3d tint_rgb = Eigen::Vector3d::Ones();  ///< factors on the material's colours
  SurfaceTexture texture = {};                         ///< of kFile
};

/// Which axis of a mesh file points up.
enum class MeshUp { kZ, kY };

/// A mesh put somewhere: a door, a column. Taken to metres and z up it is scaled, turned about x (roll),
/// then y (pitch), then z (heading), and moved. One that carries a ball stands under it, reaches up to it,
/// and moves with it.
struct MeshInstance {
  std::string file;  ///< path of the mesh file, absolute after reading; of kFile
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double heading_rad = 0.0;  ///< about z
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  Material material = Material::kWood;
  int carried_ball = slam::kUnknown;  ///< index into World::balls
  double roll_rad = 0.0;              ///< about x
  double pitch_rad = 0.0;             ///< about y
  double unit_m = 1.0;                ///< the length of the file's unit
  MeshUp up = MeshUp::kZ;             ///< y up: the file's z points south in the world before it is turned
  MeshShape shape = MeshShape::kFile;
  Eigen::Vector3d tint_rgb = Eigen::Vector3d::Ones();  ///< factors on the material's colours
  std::shared_ptr<const TriangleBvh> occluder = {};    ///< of kFile, where somebody asks (occluders.h)
};

/// What a mesh file, and a texture, may cost: they come from anywhere.
struct MeshLimits {
  int triangles = 2000000;  ///< of a file, and of all instances in the world together
  int file_mib = 64;
  double seconds = 4.0;   ///< to read a file
  int memory_mib = 1024;  ///< to read a file
  int texture_px = 4096;  ///< the longer side of a texture
  int texture_mib = 256;  ///< all textures of the world together, as they are drawn
  auto operator<=>(const MeshLimits&) const = default;
};

/// What becomes of a mesh whose texture is nowhere.
enum class MissingTexturePolicy { kError, kGrey };

/// Where textures of mesh files may lie, besides beside the file and in ../materials/textures.
struct TextureSearch {
  std::vector<std::string> folders = {};  ///< absolute
  MissingTexturePolicy missing = MissingTexturePolicy::kError;
  auto operator<=>(const TextureSearch&) const = default;
};

/// Sunlight without shadows: Lambert's cosine law above a constant ambient part.
struct Light {
  Eigen::Vector3d towards_light = {0.3, 0.2, 0.9};  ///< any length but zero
  double ambient = 0.45;                            ///< in [0, 1]
  double diffuse = 0.55;                            ///< in [0, 1]
};

/// No ball is farther off its usual radius than so many standard deviations: those are sorted out.
inline constexpr double kMostRadiusSds = 3.0;

struct World {
  std::vector<Ball> balls;  ///< at most 254: identities are written into 8 bits
  std::vector<Wall> walls;
  std::vector<MeshInstance> meshes;
  MeshLimits mesh_limits;
  bool has_floor = true;         ///< false: nothing is seen where the floor would be
  TextureSearch texture_search;  ///< of meshes
  Material floor = Material::kTiles;
  SurfaceTexture floor_texture;                              ///< of kFile
  Eigen::Vector3d floor_tint_rgb = Eigen::Vector3d::Ones();  ///< factors on the material's colours
  Light light;
  Eigen::Vector3d sky_rgb = {0.75, 0.78, 0.80};  ///< what is seen where there is nothing, in [0, 1]

  std::optional<double> usual_radius_m = {};  ///< that balls are made to; none: that of the first ball
  /// Tolerance of manufacture: standard deviation of the radii of balls that have the usual one. 0: exact.
  double ball_radius_sd_m = 0.0;

  /// How large its balls are, as detectors are told.
  double ball_radius_m() const {
    return usual_radius_m.value_or(balls.empty() ? Ball{}.radius_m : balls.front().radius_m);
  }
};

/// One instant of the robot's drive: where it is, and the true controls that brought it here.
struct PathStep {
  std::int64_t stamp_ns = 0;
  slam::Pose pose;                      ///< truth, world_from_robot
  std::vector<slam::Control> controls;  ///< since the step before, exact; empty at the first step
};

using GroundTruth = std::vector<PathStep>;

enum class SensorKind { kStereo, kOracle };

/// How landmarks are seen without pixels: Gaussian range and bearing within a sector.
struct OracleSensor {
  double range_sd_m = 0.3;
  double bearing_sd_rad = 0.0523598775598299;
  double max_range_m = 30.0;
  double field_of_view_rad = 3.14159265358979;  ///< whole angle, centred forward
  double miss_probability = 0.0;                ///< of a ball in view, in [0, 1)
  double false_per_look = 0.0;  ///< sightings of nothing, on average; Poisson, uniform in the sector
};

/// How the robot tells landmarks apart.
enum class Identity {
  kKnown,        ///< every sighting carries the landmark's identity (stereo: colours are unique)
  kColourClass,  ///< colours repeat: a sighting carries a colour, the filter finds out which one it is
  kNone,         ///< a sighting says where something is, and nothing of what it is
};

/// How far off the start pose is that filters are told, as standard deviations: drawn for each seed.
struct StartNoise {
  double position_sd_m = 0.0;  ///< of x and of y
  double heading_sd_rad = 0.0;
};

/// What can be seen, what looks, and how the robot moves. What is run in it is the harness's to say.
struct Scenario {
  std::string name;
  std::string description;
  World world;
  double placement_jitter_m = 0.0;  ///< each seed moves each ball by up to this much in x and y
  Randomisation randomise;          ///< what else each seed draws anew
  vision::StereoRig rig;            ///< as it is
  vision::StereoRig believed_rig;   ///< as vision takes it to be
  double rows_within_px = 10.0;     ///< that this may be off by: vision matches balls within so many rows
  GroundTruth path;
  slam::OdometryNoise odometry_noise;  ///< what the odometry really has
  StartNoise start_noise;
  SensorKind sensor = SensorKind::kStereo;
  OracleSensor oracle;
  CameraSensor camera;
  Shutter shutter;
  Identity identity = Identity::kKnown;
  /// kColourClass: two balls of one colour are at least this far apart; kNone: any two.
  double colour_spacing_m = 0.0;
};

}  // namespace stereobench::worlds
