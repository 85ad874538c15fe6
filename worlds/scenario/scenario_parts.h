/// The parts of a scenario file, each read from its group of keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "worlds/generate/layout.h"
#include "worlds/types.h"
#include "worlds/yaml/yaml_value.h"

namespace stereobench::worlds {

/// The finite factors that a colour may have.
inline constexpr Interval kTint = {0.0, 4.0};

/// `randomise:` what each seed draws anew.
/// @param balls_in_view that the world's generator promises, unless said otherwise
/// @param folder that textures are relative to
Randomisation read_randomisation(const YamlValue& value, int balls_in_view,
                                 const std::filesystem::path& folder);

/// A texture of a wall or of the floor, whose file must exist.
SurfaceTexture read_surface_texture(const YamlValue& value, const std::filesystem::path& folder);

/// `world.ball_radius_m`, of balls that do not say theirs.
double read_ball_radius_m(const YamlMap& world);

/// `world:` balls, walls, meshes, floor, light and sky. Mesh files, relative to the folder, must exist. A
/// generator's world has no lists of balls and walls of its own.
World read_world(const YamlMap& map, const std::filesystem::path& folder);

/// An entry of `world.meshes`. @param balls those that it may stand under
MeshInstance read_mesh(const YamlValue& value, const std::filesystem::path& folder,
                       const std::vector<Ball>& balls);

/// `world.mesh_limits:` what a mesh file may cost.
MeshLimits read_mesh_limits(const YamlValue& value);

/// `path:` a circle, a polyline, a smooth curve, a figure eight, a recorded trajectory, or the tour of a
/// generated world, driven.
/// @param layout of the world, where it is generated
/// @param folder that files are relative to
GroundTruth read_path(const YamlValue& value, const Layout* layout, const std::filesystem::path& folder);

/// `rig:` the cameras and how they sit on the robot.
vision::StereoRig read_rig(const YamlValue& value);

/// Refuses a lens through which more is seen than can be drawn.
/// @param value of `rig:`, which the rig was read from
void check_lens(const YamlValue& value, const vision::StereoRig& rig);

/// `believed_rig:` what vision takes the rig for, where it is wrong.
vision::StereoRig read_believed_rig(const YamlValue& value, const vision::StereoRig& truth);

/// `believed_rig.rows_within_px:` by how many rows the cameras may be apart; at most half a picture.
/// @param value of `believed_rig`
double read_rows_within_px(const YamlValue& value, const vision::Intrinsics& camera, double otherwise_px);

/// `camera:` the lens, the chip, and how levels are stored.
CameraSensor read_camera(const YamlValue& value);

/// `shutter:` when the cameras look.
Shutter read_shutter(const YamlValue& value);

/// `odometry_noise:` and `believed_odometry_noise:`.
slam::OdometryNoise read_odometry_noise(const YamlValue& value);

/// `believed_measurement_noise:` what the filters are told of sightings.
struct MeasurementNoise {
  std::optional<slam::NoiseLaw> law;  ///< none: each sighting is taken at its word, to scale
  Eigen::Vector2d stated_sd_scale = Eigen::Vector2d::Ones();  ///< of range, bearing
};

/// @param rig where there is one: the stereo law is about its focal length and baseline
/// @param folder that a file of such lines is relative to
MeasurementNoise read_measurement_noise(const YamlValue& value, const std::optional<vision::StereoRig>& rig,
                                        const std::filesystem::path& folder);

/// `oracle:` the pixel-free sensor.
OracleSensor read_oracle(const YamlValue& value);

/// `believed_oracle:` what filters are told of its sector and rates; what is left out is as it really is.
slam::SensorSector read_believed_oracle(const YamlValue& value, const OracleSensor& oracle);

/// An entry of `gates:` a limit on a metric of the run.
Gate read_gate(const YamlValue& value);

/// The keys of each group of a scenario, declared beside its reader.
const KeyGroup& world_keys();
const KeyGroup& ball_keys();
const KeyGroup& wall_keys();
const KeyGroup& light_keys();
const KeyGroup& mesh_keys();
const KeyGroup& mesh_limit_keys();
const KeyGroup& surface_texture_keys();
const KeyGroup& generator_keys();
const KeyGroup& path_keys();
const KeyGroup& rig_keys();
const KeyGroup& believed_rig_keys();
const KeyGroup& camera_keys();
const KeyGroup& shutter_keys();
const KeyGroup& odometry_noise_keys();
const KeyGroup& measurement_noise_keys();
const KeyGroup& oracle_keys();
const KeyGroup& believed_oracle_keys();
const KeyGroup& gate_keys();
const KeyGroup& randomisation_keys();
const KeyGroup& surface_keys();
const KeyGroup& ball_colour_keys();
const KeyGroup& light_range_keys();
const KeyGroup& clutter_keys();
const KeyGroup& distractor_keys();

/// A list of exactly N numbers within bounds, e.g. [1, 2.5].
template <int N>
Eigen::Matrix<double, N, 1> read_vector(const YamlValue& value, const Interval& within) {
  Eigen::Matrix<double, N, 1> vector;
  const std::vector<YamlValue> entries = value.list(N, N);
  for (int i = 0; i < N; ++i) vector[i] = entries[static_cast<std::size_t>(i)].number(within);
  return vector;
}

/// A key whose value is N numbers, as it is declared: required, or `fallback` where it is left out.
template <int N>
Eigen::Matrix<double, N, 1> read_vector(
    const YamlMap& map, std::string_view key,
    const std::optional<Eigen::Matrix<double, N, 1>>& fallback = std::nullopt) {
  std::vector<double> otherwise;
  if (fallback) otherwise.assign(fallback->data(), fallback->data() + N);
  const std::vector<double> numbers = map.numbers(key, std::move(otherwise));
  return Eigen::Matrix<double, N, 1>(numbers.data());
}

/// A key whose value is one of the declared names, which are in the order of `Choice`.
template <typename Choice>
Choice read_choice(const YamlMap& map, std::string_view key, Choice fallback) {
  return static_cast<Choice>(map.choice(key, static_cast<std::size_t>(fallback)));
}

}  // namespace stereobench::worlds
