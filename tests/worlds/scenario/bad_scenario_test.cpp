// What a scenario file can have wrong: each is refused in one line that names the place and the cure.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/worlds/scenario/faults.h"
#include "tests/worlds/scenario/read_scenario.h"
#include "tests/worlds/scenario/scenario_text.h"

namespace stereobench::worlds {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class BadScenario : public testing::TestWithParam<Fault> {};

// Catches: a check dropped, a line counted from 0, a key path without its group, an unchecked leftover key.
TEST_P(BadScenario, IsRefusedInOneLineThatNamesPlaceAndExpectation) {
  expect_refused(GetParam(), complaint_about);
}

constexpr Fault kKeyFaults[] = {
    {"radius_m: 1\n", "radius: 1\n", "14: path.radius: unknown key, did you mean radius_m?"},
    {"noise_sd_levels: 1", "gama: 1", "9: camera.gama: unknown key, did you mean gamma?"},
    {"laps: 1", "closed: true", "16: path.closed: unknown key, expected one of kind, start_m"},
    {"focal_px: 500", "focal_px: 500, cz_px: 3", "8: rig.cz_px: unknown key, did you mean cx_px?"},
    {"range_sd_m: 0.1", "range_sd: 0.1", "10: oracle.range_sd: unknown key, did you mean range_sd_m?"},
    {"v_per_v: 0.1", "v_per_x: 0.1", "11: odometry_noise.v_per_x: unknown key, did you mean v_per_v?"},
    {"floor: bricks", "flor: bricks", "20: world.flor: unknown key, did you mean floor?"},
    {"ambient: 0.4", "ambience: 1", "21: world.light.ambience: unknown key, did you mean ambient?"},
    {"closed: true", "close: true", "24: world.walls[0].close: unknown key, did you mean closed?"},
    {"heading_deg: 90", "heading: 9", "26: world.meshes[0].heading: unknown key, did you mean heading_deg?"},
    {"{colour: 1", "{color: 1", "30: world.balls[1].color: unknown key, did you mean colour?"},
    {"seeds: 0..2", "name: twice", "3: name: expected each key once (this one is repeated)"},
    {"{colour: 1", "{colour: 1, colour: 3", "30: world.balls[1].colour: expected each key once"},
    {"description: three balls", "title: three balls", "2: title: unknown key"},
    {"name: small", "", "2: name: this key is missing and has no default"},
    {"  step_s: 0.5\n", "", "12: path.step_s: this key is missing and has no default"},
    {"identity: known\n", "", "1: identity: this key is missing"},
    {"{colour: 1, ", "{", "30: world.balls[1].colour: this key is missing"},
    {"{width_px: 640, ", "{", "8: rig.width_px: this key is missing"},
    {"rig: {width_px: 640, height_px: 480, focal_px: 500, baseline_m: 0.1, height_m: 0.3}\n", "",
     "1: rig: this key is missing"},
    {"name: small", "? [a, b]\n: small", "1: expected keys that are plain text"},
};
INSTANTIATE_TEST_SUITE_P(Keys, BadScenario, testing::ValuesIn(kKeyFaults));

constexpr Fault kValueFaults[] = {
    {"name: small", "name: Too Loud", "1: name: expected a name of small letters, digits and _"},
    {"name: small", "name: [small]", "1: name: expected text (got a list of 1)"},
    {"sensor: stereo", "sensor: radar", "6: sensor: expected one of stereo, oracle (got radar)"},
    {"identity: known", "identity:", "7: identity: expected one of known, colour_class, none (got nothing)"},
    {"width_px: 640", "width_px: 640.5",
     "8: rig.width_px: expected a whole number from 16 to 4096 (got 640.5)"},
    {"width_px: 640", "width_px: 99999999999", "8: rig.width_px: expected a whole number from 16 to 4096"},
    {"width_px: 640", "width_px: \"640\"",
     "8: rig.width_px: expected a whole number from 16 to 4096 (got \"640\")"},
    {"width_px: 640", "width_px: 5", "8: rig.width_px: expected a whole number from 16 to 4096 (got 5)"},
    {"baseline_m: 0.1", "baseline_m: 0", "8: rig.baseline_m: expected a number from 0.001 to 10 (got 0)"},
    {"focal_px: 500", "focal_px: .nan", "8: rig.focal_px: expected a number from 1 to 100000 (got .nan)"},
    {"focal_px: 500", "focal_px: nan", "8: rig.focal_px: expected a number from 1 to 100000 (got nan)"},
    {"focal_px: 500", "focal_px: 1e999", "8: rig.focal_px: expected a number from 1 to 100000 (got 1e999)"},
    {"focal_px: 500", "focal_px: 500 px", "8: rig.focal_px: expected a number from 1 to 100000 (got 500 px)"},
    {"noise_sd_levels: 1", "noise_sd_levels: -1",
     "9: camera.noise_sd_levels: expected a number from 0 to 255"},
    {"noise_sd_levels: 1", "gamma: 2", "9: camera.gamma: a gamma needs `encoding: gamma`"},
    {"noise_sd_levels: 1", "encoding: log", "9: camera.encoding: expected one of linear, srgb, gamma"},
    {"noise_sd_levels: 1", "vignette: 2", "9: camera.vignette: expected a number from 0 to 1"},
    {"noise_sd_levels: 1", "read_noise_electrons: 2",
     "9: camera.read_noise_electrons: electrons are counted with full_well_electrons"},
    {"noise_sd_levels: 1", "white_balance_rgb: [1, 1]", "9: camera.white_balance_rgb: expected"},
    {"camera: {noise_sd_levels: 1}", "shutter: {samples: 0}",
     "9: shutter.samples: expected a whole number from 1"},
    {"camera: {noise_sd_levels: 1}", "shutter: {most_samples: 0}",
     "9: shutter.most_samples: expected a whole number from 1"},
    {"floor: bricks", "floor: none\n  floor_tint_rgb: [1, 1, 1]",
     "21: world.floor_tint_rgb: expected none where `floor: none`"},
    {"floor: bricks", "floor_texture: {file: thing.obj}\n  floor: none",
     "20: world.floor_texture: expected no floor beside it"},
    {"world:\n  floor: bricks", "randomise: {floor: {}}\nworld:\n  floor: none",
     "21: world.floor: expected a floor, of which randomise.floor draws the material"},
    {"focal_px: 500", "focal_px: 500, right_turn_deg: [0, 90, 0]", "8: rig.right_turn_deg"},
    {"focal_px: 500", "focal_px: 56",
     "8: rig.focal_px: expected a focal length of at least 56.44 px, or a pixel looks more than 80 degrees "
     "aside (got 56)"},
    {"focal_px: 500", "focal_px: 60, cx_px: 10",
     "8: rig.focal_px: expected a focal length of at least 111.03"},
    {"camera: {noise_sd_levels: 1}", "believed_rig: {focal_px: 30}",
     "9: believed_rig.focal_px: expected a focal length of at least 56.44 px"},
    {"camera: {noise_sd_levels: 1}", "believed_rig: {rows_within_px: 0}",
     "9: believed_rig.rows_within_px: expected a number from 0.1 to 240 (got 0)"},
    {"camera: {noise_sd_levels: 1}", "believed_rig: {rows_within_px: .inf}",
     "9: believed_rig.rows_within_px: expected a number from 0.1 to 240 (got .inf)"},
    {"camera: {noise_sd_levels: 1}", "believed_rig: {rows_within_px: 241}",
     "9: believed_rig.rows_within_px: expected a number from 0.1 to 240 (got 241)"},
    {"focal_px: 500", "focal_px: 500, distortion: [-3, 0, 0, 0, 0]", "8: rig.distortion"},
    {"focal_px: 500", "focal_px: 500, pixel_aspect: 0.4", "8: rig.pixel_aspect"},
    {"width_px: 640", "width_px: 4096, distortion: [-0.001, 0, 0, 0, 0], pixel_aspect: 1.5",
     "8: rig.distortion: expected fewer pixels, or a lens that looks less far aside"},
    {"width_px: 640", "width_px: 4096, distortion: [0, 0, 0, 0, 0], pixel_aspect: 1.5",
     "8: rig.pixel_aspect: expected fewer pixels, or a lens that looks less far aside"},
    {"{noise_sd_levels: 1}", "2", "9: camera: expected a group of keys (got 2)"},
    {"bearing_sd_deg: 1", "bearing_sd_deg: inf",
     "10: oracle.bearing_sd_deg: expected a number from 0 to 180 (got inf)"},
    {"range_sd_m: 0.1", "range_sd_m: 0.1, miss_probability: 1",
     "10: oracle.miss_probability: expected a number from 0 to 0.99 (got 1)"},
    {"range_sd_m: 0.1", "range_sd_m: 0.1, false_per_look: -1",
     "10: oracle.false_per_look: expected a number from 0 to 100 (got -1)"},
    {"v_per_v: 0.1", "v_per_v: -0.1",
     "11: odometry_noise.v_per_v: expected a number from 0 to 100 (got -0.1)"},
    {"kind: circle", "kind: spiral",
     "13: path.kind: expected one of circle, polyline, tour, spline, figure_eight, recorded (got spiral)"},
    {"radius_m: 1\n", "radius_m: [1]\n",
     "14: path.radius_m: expected a number from 0.001 to 10000 (got a list of 1)"},
    {"laps: 1", "laps: 0", "16: path.laps: expected a number from 0.001 to 1000 (got 0)"},
    {"step_s: 0.5", "step_s: 0.5\n  odometry_s: 0",
     "18: path.odometry_s: expected a number from 0.001 to 1000 (got 0)"},
    {"step_s: 0.5", "step_s: 0.5\n  odometry: 0.1", "18: path.odometry: unknown key"},
    {"step_s: 0.5", "step_s: 0", "17: path.step_s: expected a number from 0.001 to 1000 (got 0)"},
    {"speed_mps: 0.5\n  laps: 1", "speed_mps: 0.001\n  laps: 999", "12: path: expected at most 100000 steps"},
    {"placement_jitter_m: 0.01", "placement_jitter_m: big", "18: placement_jitter_m: expected a number"},
};
INSTANTIATE_TEST_SUITE_P(Values, BadScenario, testing::ValuesIn(kValueFaults));

constexpr Fault kWorldFaults[] = {
    {"floor: bricks", "floor: lava",
     "20: world.floor: expected one of plain, tiles, plaster, bricks, wood, paint, none (got lava)"},
    {"[0, 0, 1]", "[0, 0, 0]", "21: world.light.towards_light: expected a direction"},
    {"[0, 0.5, 1]", "[0, 0.5, 2]", "22: world.sky_rgb[2]: expected a number from 0 to 1 (got 2)"},
    {"[0, 0.5, 1]", "[0, 0.5]", "22: world.sky_rgb: expected a list of 3 (got a list of 2)"},
    {"[4, 4]]", "[4, -4]]", "24: world.walls[0].corners_m[2]: expected another corner than the one before"},
    {"closed: true", "closed: maybe", "24: world.walls[0].closed: expected true or false (got maybe)"},
    {"thing.obj", "other.obj", "26: world.meshes[0].file: expected a mesh file that exists (got other.obj)"},
    {"thing.obj", ".", "26: world.meshes[0].file: expected a mesh file that exists"},
    {"heading_deg: 90", "up: x", "26: world.meshes[0].up: expected one of z, y (got x)"},
    {"heading_deg: 90", "unit_m: 0", "26: world.meshes[0].unit_m: expected a number from 1e-06 to 1000"},
    {"heading_deg: 90", "scale: 0",
     "26: world.meshes[0].scale: expected a number from 0.001 to 1000 (got 0)"},
    {"heading_deg: 90", "scale: [1, 2]", "26: world.meshes[0].scale: expected a list of 3"},
    {"heading_deg: 90", "tilt_deg: 9", "26: world.meshes[0].tilt_deg: unknown key, did you mean roll_deg?"},
    {"material: wood", "material: file", "24: world.walls[0].material: expected one of plain, tiles"},
    {"floor: bricks", "mesh_limits: {seconds: 0}",
     "20: world.mesh_limits.seconds: expected a number from 0.001 to 3600 (got 0)"},
    {"floor: bricks", "mesh_limits: {faces: 3}", "20: world.mesh_limits.faces: unknown key"},
    {"ball_radius_m: 0.05", "ball_radius_m: 0.05\n  ball_radius_sd_m: 0.006",
     "28: world.ball_radius_sd_m: expected at most a tenth of ball_radius_m, 0.005"},
    {"ball_radius_m: 0.05", "ball_radius_m: 0",
     "27: world.ball_radius_m: expected a number from 0.001 to 10"},
    {"colour: 1", "colour: 18", "30: world.balls[1].colour: expected a whole number from 0 to 17 (got 18)"},
    {"colour: 1", "colour: red", "30: world.balls[1].colour: expected a whole number from 0 to 17 (got red)"},
    {"[0, 3, 0.1]", "[0, 3, 0.01]", "30: world.balls[1].at_m: expected a height of at least the radius 0.05"},
    {"[0, 3, 0.1]", "[0, 3e9, 1]",
     "30: world.balls[1].at_m[1]: expected a number from -10000 to 10000 (got 3e9)"},
    {"colour: 1", "colour: 0", "30: world.balls[1]: expected a colour of its own (got 0, as ball 0)"},
    {"{colour: 1", "{radius_m: 0.06, colour: 1",
     "30: world.balls[1]: expected the radius of ball 0, 0.05 m (got 0.06 m)"},
    {"[0, 3, 0.1]", "[2.1, 0, 0.1]", "30: world.balls[1]: expected a place clear of ball 0 under any jitter"},
};
INSTANTIATE_TEST_SUITE_P(World, BadScenario, testing::ValuesIn(kWorldFaults));

constexpr Fault kPolylineFaults[] = {
    {"[[0, 0], [5, 0], [5, 5]]", "[[0, 0]]",
     "13: path.points_m: expected a list of 2 to 1000 (got a list of 1)"},
    {"[[0, 0], [5, 0], [5, 5]]", "[[0, 0], [5]]",
     "13: path.points_m[1]: expected a list of 2 (got a list of 1)"},
    {"[5, 5]]", "[0, 0]]", "12: path: expected no turning back (points_m[1] does)"},
    {"[5, 5]]", "[5, 0.5]]",
     "12: path: expected room for the rounded corners between points_m[1] and points_m[2]"},
    {"[5, 5]]", "[5, 0]]",
     "12: path: expected room for the rounded corners between points_m[1] and points_m[2]"},
    {"step_s: 1", "step_s: 1, overlap_m: 1",
     "12: path: expected overlap_m of 0 or more, and only on a closed path"},
    {"step_s: 1", "step_s: 1, closed: true, overlap_m: 99", "12: path: expected overlap_m of at most a lap"},
    {"[[0, 0], [5, 0], [5, 5]]", "[[0, 0], [5, 0]], closed: true", "12: path: expected at least 3 points_m"},
    {"step_s: 1", "step_s: 1, radius_m: 1", "13: path.radius_m: unknown key, did you mean corner_radius_m?"},
};

class BadPolyline : public testing::TestWithParam<Fault> {};

TEST_P(BadPolyline, IsRefused) {
  const Fault fault = GetParam();
  std::string path =
      "{kind: polyline,\n points_m: [[0, 0], [5, 0], [5, 5]],"
      " corner_radius_m: 1, speed_mps: 1, step_s: 1}\n";
  const std::size_t at = path.find(fault.piece);
  ASSERT_NE(at, std::string::npos);
  path.replace(at, std::string(fault.piece).size(), fault.instead);
  const std::string circle = "\n  kind: circle\n  radius_m: 1\n  speed_mps: 0.5\n  laps: 1\n  step_s: 0.5\n";
  const ScenarioFolder folder;
  const auto file = folder.write("bad.yaml", small_scenario_with(circle, " " + path));
  EXPECT_THAT(complaint_about(file), StartsWith(file.string() + ":" + fault.complaint));
}
INSTANTIATE_TEST_SUITE_P(Polylines, BadPolyline, testing::ValuesIn(kPolylineFaults));

// Catches: the check of colours left out for colour classes, or the jitter not counted in.
TEST(BadColours, OfOneClassAreFartherApartThanTheSpacingUnderAnyJitter) {
  std::string text = small_scenario_with("identity: known", "identity: colour_class\ncolour_spacing_m: 3.99");
  text.replace(text.find("colour: 2"), 9, "colour: 0");  // 4 m from ball 0, 0.028 m less under jitter
  const ScenarioFolder folder;
  const auto file = folder.write("bad.yaml", text);
  EXPECT_THAT(complaint_about(file),
              EndsWith("expected ball 0 of the same colour at least 3.99 m away (got 3.972 m)"));
  EXPECT_EQ(complaint_about(file, {"placement_jitter_m=0"}), "no complaint");
}

// Where nothing tells balls apart, all are of one class. Mutation: colours still told apart.
TEST(BadColours, DoNotMatterWhereNobodySeesThem) {
  const std::string text =
      small_scenario_with("identity: known", "identity: none\ncolour_spacing_m: 3.99");  // (2, 0) and (0, 3)
  const ScenarioFolder folder;
  EXPECT_THAT(complaint_about(folder.write("bad.yaml", text)),
              EndsWith("expected ball 0 at least 3.99 m away (got 3.577 m)"));
}

TEST(BadBalls, AreAtMost254) {
  std::string balls;
  for (int i = 0; i < 255; ++i) balls += "    - {colour: 0, at_m: [" + std::to_string(i) + ", 9, 1]}\n";
  const ScenarioFolder folder;
  std::string text = small_scenario_with("  balls:\n", "  balls:\n" + balls);
  const auto file = folder.write("bad.yaml", text);
  EXPECT_THAT(complaint_about(file),
              HasSubstr(":28: world.balls: expected a list of 1 to 254 (got a list of 258)"));
}

TEST(BadFile, MissingOrAFolder) {
  const ScenarioFolder folder;
  EXPECT_THAT(complaint_about(folder.path() / "none.yaml"),
              EndsWith("none.yaml: no such file; expected a scenario (.yaml)"));
  EXPECT_THAT(complaint_about(folder.path()), EndsWith("expected a scenario file (got a folder)"));
}

TEST(BadFile, IsNoYamlMap) {
  const ScenarioFolder folder;
  const auto about = [&](const std::string& text) { return complaint_about(folder.write("bad.yaml", text)); };
  EXPECT_THAT(about(""), EndsWith("bad.yaml:1: expected one YAML document (got 0)"));
  EXPECT_THAT(about("# nothing\n"), HasSubstr("bad.yaml:1: expected"));
  EXPECT_THAT(about("a: [1\nb: 2\n"), HasSubstr("bad.yaml:2: expected YAML ("));
  EXPECT_THAT(about("- a\n- b\n"), EndsWith("bad.yaml:1: expected a map of keys at the top"));
  EXPECT_THAT(about("just words"), EndsWith("bad.yaml:1: expected a map of keys at the top"));
  EXPECT_THAT(about("a: 1\n---\nb: 2\n"), EndsWith("bad.yaml:1: expected one YAML document (got 2)"));
  EXPECT_THAT(about(std::string(20000, '[')), HasSubstr("bad.yaml:1: expected YAML ("));
  EXPECT_THAT(about(std::string("\x00\x01\xff\xfe\x00garbage", 12)), HasSubstr("bad.yaml:1: expected"));
  EXPECT_THAT(about("a: &x {b: *x}\n"),
              HasSubstr("bad.yaml:1: expected YAML (an alias within what it stands for)"));
}

}  // namespace
}  // namespace stereobench::worlds
