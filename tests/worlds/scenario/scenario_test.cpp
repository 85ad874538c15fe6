// A scenario says what its file says.
#include <locale>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/math/angles.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/scenario/scenario_text.h"
#include "worlds/drive/path.h"

namespace stereobench::worlds {
namespace {

Scenario read_small(const std::vector<std::string>& overrides = {}) {
  const ScenarioFolder folder;
  return read_scenario(folder.write("good.yaml", kSmallScenario), overrides);
}

TEST(Scenario, SaysWhoLooksHow) {
  const Scenario scenario = read_small();
  EXPECT_EQ(scenario.name, "small");
  EXPECT_EQ(scenario.sensor, SensorKind::kStereo);
  EXPECT_EQ(scenario.identity, Identity::kKnown);
  EXPECT_EQ(scenario.camera.noise_sd_levels, 1.0);
}

// Catches: degrees taken for radians, a principal point at width / 2.
TEST(Scenario, TurnsDegreesIntoRadiansAndCentresTheCamera) {
  const Scenario scenario = read_small({"rig.pitch_down_deg=10"});
  EXPECT_DOUBLE_EQ(scenario.rig.intrinsics.cx_px, 319.5);
  EXPECT_DOUBLE_EQ(scenario.rig.intrinsics.cy_px, 239.5);
  EXPECT_DOUBLE_EQ(scenario.rig.pitch_down_rad, 10 * slam::kRadPerDegree);
  EXPECT_DOUBLE_EQ(scenario.odometry_noise.w_constant_radps, 2 * slam::kRadPerDegree);
  EXPECT_DOUBLE_EQ(scenario.oracle.bearing_sd_rad, slam::kRadPerDegree);
  EXPECT_DOUBLE_EQ(scenario.oracle.field_of_view_rad, 90 * slam::kRadPerDegree);
  EXPECT_DOUBLE_EQ(scenario.world.meshes.at(0).heading_rad, 90 * slam::kRadPerDegree);
}

// Mutations: the two lists of names in another order than what they name.
TEST(Scenario, SaysHowLandmarksAreToldApart) {
  EXPECT_EQ(read_small().oracle.false_per_look, 0.0);
  EXPECT_EQ(read_small().oracle.miss_probability, 0.0);
  const Scenario scenario =
      read_small({"identity=none", "oracle.false_per_look=0.5", "oracle.miss_probability=0.1"});
  EXPECT_EQ(scenario.identity, Identity::kNone);
  EXPECT_EQ(scenario.oracle.false_per_look, 0.5);
  EXPECT_EQ(scenario.oracle.miss_probability, 0.1);
}

// Catches: a closed line of corners that lacks its last wall, a mesh path that stays relative.
TEST(Scenario, BuildsTheWorld) {
  const Scenario scenario = read_small();
  const World& world = scenario.world;
  ASSERT_EQ(world.walls.size(), 3U);
  EXPECT_EQ(world.walls[2].from_m, Eigen::Vector2d(4, 4));
  EXPECT_EQ(world.walls[2].to_m, Eigen::Vector2d(-4, -4));
  EXPECT_EQ(world.walls[1].material, Material::kWood);
  EXPECT_EQ(world.floor, Material::kBricks);
  ASSERT_EQ(world.balls.size(), 3U);
  EXPECT_EQ(world.balls[1].centre_m, Eigen::Vector3d(0, 3, 0.1));
  EXPECT_EQ(world.balls[1].colour, 1);
  EXPECT_EQ(world.balls[1].radius_m, 0.05);
  EXPECT_TRUE(std::filesystem::path(world.meshes.at(0).file).is_absolute());
  EXPECT_EQ(world.sky_rgb, Eigen::Vector3d(0, 0.5, 1));
}

TEST(Scenario, OverridesReplaceWhatTheFileSaysAndAddWhatItLeavesOut) {
  const Scenario scenario = read_small({"path.laps=3", "camera.noise_sd_levels=4", "colour_spacing_m=0.5",
                                        "odometry_noise.w_per_w=0.5", "path.laps=2"});
  EXPECT_NEAR(length_m(scenario.path), 4 * std::numbers::pi, 1e-12) << "the last one counts";
  EXPECT_EQ(scenario.camera.noise_sd_levels, 4.0);
  EXPECT_EQ(scenario.colour_spacing_m, 0.5);
  EXPECT_EQ(scenario.odometry_noise.v_per_v, 0.1);
  EXPECT_EQ(scenario.odometry_noise.w_per_w, 0.5);
}

TEST(Scenario, ReadsHowOftenTheOdometryIsRead) {
  EXPECT_EQ(read_small().path.at(1).controls.size(), 1U);
  EXPECT_EQ(read_small({"path.odometry_s=0.125"}).path.at(1).controls.size(), 4U);
  EXPECT_EQ(read_small({"path={kind: polyline, points_m: [[0, 0], [9, 0]], corner_radius_m: 1, speed_mps: 1, "
                        "step_s: 0.2, odometry_s: 0.025}"})
                .path.at(1)
                .controls.size(),
            8U);
}

TEST(Scenario, ReadsTheCameraAndItsShutter) {
  const Scenario scenario = read_small(
      {"camera={noise_sd_levels: 1.5, defocus_sd_px: 0.8, vignette: 0.3, exposure: 0.5, "
       "full_well_electrons: 8000, read_noise_electrons: 6, gain: 2, white_balance_rgb: [1, 1.1, 0.9], "
       "encoding: gamma, gamma: 1.8}",
       "shutter={open_s: 0.01, samples: 4, right_delay_s: 0.002, drop_probability: 0.1, "
       "readout_s: 0.03, late_probability: 0.2, late_s: 0.04}"});
  EXPECT_EQ(scenario.camera,
            (CameraSensor{1.5, 0.8, 0.3, 0.5, 8000, 6, 2, {1, 1.1, 0.9}, Encoding::kGamma, 1.8}));
  EXPECT_EQ(scenario.shutter.open_s, 0.01);
  EXPECT_EQ(scenario.shutter.samples, 4);
  EXPECT_EQ(scenario.shutter.right_delay_s, 0.002);
  EXPECT_EQ(scenario.shutter.drop_probability, 0.1);
  EXPECT_EQ(scenario.shutter.readout_s, 0.03);
  EXPECT_EQ(scenario.shutter.late_probability, 0.2);
  EXPECT_EQ(scenario.shutter.late_s, 0.04);
}

// Catches: a belief that stays at the file's rig when the true rig is overridden.
TEST(Scenario, BelievesTheTrueRigUnlessToldOtherwise) {
  const Scenario scenario = read_small({"rig.baseline_m=0.2", "rig.right_turn_deg=[0, 0.5, 0]",
                                        "rig.distortion=[-0.2, 0.03, 0.001, -0.002, 0.004]",
                                        "rig.pixel_aspect=0.9", "believed_rig={focal_px: 505}"});
  EXPECT_EQ(scenario.rig.distortion,
            (vision::Distortion{
                .k1 = -0.2, .k2 = 0.03, .p1 = 0.001, .p2 = -0.002, .k3 = 0.004, .pixel_aspect = 0.9}));
  EXPECT_EQ(scenario.rig.right_turn_rad.y(), 0.5 * std::numbers::pi / 180.0);
  EXPECT_EQ(scenario.believed_rig.baseline_m, 0.2);
  EXPECT_EQ(scenario.believed_rig.intrinsics.focal_px, 505.0);
  EXPECT_EQ(scenario.believed_rig.right_turn_rad, scenario.rig.right_turn_rad);
  EXPECT_EQ(scenario.believed_rig.distortion, scenario.rig.distortion);
  const Scenario blind = read_small(
      {"rig.right_turn_deg=[0, 0.5, 0]", "rig.distortion=[-0.2, 0, 0, 0, 0]", "rig.pixel_aspect=1.1",
       "believed_rig={right_turn_deg: [0, 0, 0], distortion: [0, 0, 0, 0, 0], pixel_aspect: 1}"});
  EXPECT_EQ(blind.believed_rig.right_turn_rad, Eigen::Vector3d::Zero());
  EXPECT_EQ(blind.believed_rig.distortion, vision::Distortion{});
  EXPECT_EQ(scenario.rig.intrinsics.focal_px, read_small().believed_rig.intrinsics.focal_px);
}

TEST(Scenario, SaysByHowManyRowsTheRigMayBeOff) {
  EXPECT_EQ(read_small({"believed_rig={rows_within_px: 6}"}).rows_within_px, 6.0);
  EXPECT_EQ(read_small({"believed_rig={focal_px: 505}"}).rows_within_px, read_small().rows_within_px);
}

TEST(Scenario, DrivesSmoothPaths) {
  EXPECT_NEAR(
      length_m(read_small({"path={kind: figure_eight, radius_m: 1, speed_mps: 1, step_s: 0.1}"}).path),
      4.0 * std::numbers::pi, 1e-9);
  const Scenario spline =
      read_small({"path={kind: spline, points_m: [[0, 0], [1, 0], [2, 1]], speed_mps: 1, step_s: 0.1}"});
  EXPECT_NEAR(spline.path.back().pose.y_m, 1.0, 1e-9);
  const ScenarioFolder folder;
  const auto file = folder.write("drive.txt", "0 1 1 0 0 0 0 1\n2 3 1 0 0 0 0 1\n");
  const Scenario recorded = read_small({"path={kind: recorded, file: " + file.string() + ", step_s: 1}"});
  EXPECT_NEAR(recorded.path[1].pose.x_m, 2.0, 1e-12);
}

/// A language that writes a comma where C++ writes a point.
struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

// Catches: numbers that are read or written by the rules of the user's language, as yaml-cpp's own are.
TEST(Scenario, ReadsNumbersWithoutTheLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  const Scenario scenario = read_small({"rig.baseline_m=1.5e-1"});
  std::locale::global(before);
  EXPECT_EQ(scenario.rig.baseline_m, 0.15);
  EXPECT_EQ(scenario.rig.height_m, 0.3);
}

TEST(ScenarioMesh, SaysUnitUpAxisPoseScaleAndMaterial) {
  const ScenarioFolder folder;
  const Scenario scenario = read_scenario(folder.write(
      "small.yaml", small_scenario_with("at_m: [1, 2, 0], heading_deg: 90",
                                        "at_m: [1, 2, 0], unit_m: 0.01, up: y, roll_deg: 10, pitch_deg: -20, "
                                        "heading_deg: 30, scale: 2, material: file")));
  const MeshInstance& mesh = scenario.world.meshes.at(0);
  EXPECT_EQ(mesh.unit_m, 0.01);
  EXPECT_EQ(mesh.up, MeshUp::kY);
  EXPECT_DOUBLE_EQ(mesh.roll_rad, 10 * slam::kRadPerDegree);
  EXPECT_DOUBLE_EQ(mesh.pitch_rad, -20 * slam::kRadPerDegree);
  EXPECT_DOUBLE_EQ(mesh.heading_rad, 30 * slam::kRadPerDegree);
  EXPECT_EQ(mesh.scale, Eigen::Vector3d(2, 2, 2));
  EXPECT_EQ(mesh.material, Material::kFile);
}

TEST(ScenarioMesh, TexturesAreSoughtWhereTheScenarioSays) {
  const ScenarioFolder folder;
  const auto at = [&](const std::string& lines) {
    return read_scenario(folder.write("small.yaml", small_scenario_with("floor: bricks", lines)))
        .world.texture_search;
  };
  EXPECT_EQ(at("floor: bricks"), TextureSearch{});
  const std::filesystem::path own = folder.write("small.yaml", "").parent_path();
  const TextureSearch search =
      at("texture_folders: [., " + own.root_path().string() + "]\n  missing_texture: grey");
  EXPECT_EQ(search.folders, (std::vector<std::string>{(own / "").string(), own.root_path().string()}));
  EXPECT_EQ(search.missing, MissingTexturePolicy::kGrey);
  const ScenarioFolder other;
  EXPECT_EQ(read_scenario(other.write("copy.yaml", written_out(own / "small.yaml", {}, std::nullopt)))
                .world.texture_search,
            search);
  EXPECT_THAT([&] { at("texture_folders: [nowhere]"); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(
                  "20: world.texture_folders[0]: expected a folder that exists (got nowhere)")));
}

TEST(ScenarioMesh, LimitsAreTheScenarios) {
  const ScenarioFolder folder;
  const Scenario scenario = read_scenario(folder.write(
      "small.yaml",
      small_scenario_with("floor: bricks",
                          "mesh_limits: {triangles: 12, file_mib: 3, seconds: 0.5, memory_mib: 99}")));
  const MeshLimits& limits = scenario.world.mesh_limits;
  EXPECT_EQ(limits.triangles, 12);
  EXPECT_EQ(limits.file_mib, 3);
  EXPECT_EQ(limits.seconds, 0.5);
  EXPECT_EQ(limits.memory_mib, 99);
}

}  // namespace
}  // namespace stereobench::worlds
