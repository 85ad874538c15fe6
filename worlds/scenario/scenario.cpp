#include "worlds/scenario/scenario.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "slam/filter_registry.h"
#include "worlds/generate/randomise.h"
#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario_checks.h"
#include "worlds/scenario/scenario_parts.h"
#include "worlds/scenario/seeds.h"

namespace stereobench::worlds {
namespace {

constexpr std::string_view kNamePattern = "^[a-z0-9_]{1,64}$";
constexpr std::string_view kSeedsPattern = R"(^[0-9]+(\.\.[0-9]+|(,[0-9]+)*)$)";

std::string read_name(const YamlValue& value) {
  const std::string name = value.text();
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (name.find_first_not_of(kLetters) != std::string::npos || name.size() > 64) {
    value.fail("expected a name of small letters, digits and _, at most 64");
  }
  return name;
}

const std::vector<std::string>& filter_names() {
  static const std::vector<std::string> names = slam::filter_names();
  return names;
}

std::vector<std::string> read_filters(const YamlMap& map) {
  std::vector<std::string> filters;
  for (const YamlValue& entry : map.list("filters")) {
    filters.push_back(filter_names()[entry.choice(map.declared("filters").names)]);
    if (std::ranges::count(filters, filters.back()) > 1) entry.fail("expected each filter once");
  }
  return filters;
}

std::vector<std::uint64_t> read_seeds(const YamlValue& value) {
  const std::string text = value.text();
  try {
    return parse_seeds(text);
  } catch (const std::invalid_argument& error) {
    value.fail(error.what());
  }
}

/// What is done with the world: who looks at it, how often, and what the outcome must be.
void read_run(const YamlMap& map, Scenario& scenario) {
  if (map.find("filters")) scenario.filters = read_filters(map);
  scenario.particles = map.whole("particles", scenario.particles);
  scenario.draw_every = map.whole("draw_every", scenario.draw_every);
  scenario.refit = map.flag("refit", scenario.refit);
  if (const auto seeds = map.find("seeds")) scenario.seeds = read_seeds(*seeds);
  for (const YamlValue& gate : map.list("gates")) scenario.gates.push_back(read_gate(gate));
}

void read_cameras(const YamlMap& map, Scenario& scenario) {
  const bool stereo = scenario.sensor == SensorKind::kStereo;
  if (const auto rig = stereo ? map.at("rig") : map.find("rig")) {
    scenario.rig = read_rig(*rig);
    if (stereo) check_lens(*rig, scenario.rig);
  }
  const auto believed = map.find("believed_rig");
  scenario.believed_rig = believed ? read_believed_rig(*believed, scenario.rig) : scenario.rig;
  if (believed)
    scenario.rows_within_px =
        read_rows_within_px(*believed, scenario.rig.intrinsics, scenario.rows_within_px);
  if (const auto camera = map.find("camera")) scenario.camera = read_camera(*camera);
  if (const auto shutter = map.find("shutter")) scenario.shutter = read_shutter(*shutter);
  if (const auto detector = map.find("detector")) {
    if (!stereo) detector->refuse("the oracle has no pictures to look at");
    scenario.detector.command = detector->text();
  }
  scenario.detector.timeout_s = map.number("detector_timeout_s", scenario.detector.timeout_s);
  scenario.detector.start_s = map.number("detector_start_s", scenario.detector.start_s);
}

void read_oracles(const YamlMap& map, Scenario& scenario) {
  const bool needed = scenario.sensor == SensorKind::kOracle;
  const auto oracle = needed ? map.at("oracle") : map.find("oracle");
  if (oracle) scenario.oracle = read_oracle(*oracle);
  const auto believed = map.find("believed_oracle");
  if (believed && !oracle) believed->refuse("expected `oracle:` beside it, the sensor as it is");
  if (believed) scenario.believed_sector = read_believed_oracle(*believed, scenario.oracle);
}

void read_sensing(const YamlMap& map, const std::filesystem::path& folder, Scenario& scenario) {
  scenario.sensor = static_cast<SensorKind>(map.choice("sensor"));
  scenario.identity = static_cast<Identity>(map.choice("identity"));
  scenario.colour_spacing_m = map.number("colour_spacing_m", scenario.colour_spacing_m);
  scenario.association = read_choice(map, "association", scenario.association);
  read_cameras(map, scenario);
  read_oracles(map, scenario);
  if (const auto noise = map.find("believed_measurement_noise")) {
    const auto rig = map.find("rig") ? std::optional(scenario.believed_rig) : std::nullopt;
    const MeasurementNoise told = read_measurement_noise(*noise, rig, folder);
    scenario.believed_measurement_noise = told.law;
    scenario.stated_sd_scale = told.stated_sd_scale;
  }
}

void read_odometry(const YamlMap& map, Scenario& scenario) {
  scenario.odometry_noise = read_odometry_noise(map.at("odometry_noise"));
  const auto believed = map.find("believed_odometry_noise");
  scenario.believed_odometry_noise = believed ? read_odometry_noise(*believed) : scenario.odometry_noise;
}

/// Puts a generated world's walls and balls in place, once it is known who drives where and sees how.
void generate(const YamlValue& value, const Generator& generator, Scenario& scenario) {
  scenario.world.walls = generator.layout.walls;
  try {
    place_balls(scenario, generator.rules);
  } catch (const std::invalid_argument& error) {
    value.refuse(error.what());
  }
}

void read_world_and_path(const YamlMap& map, const std::filesystem::path& folder,
                         const OccluderReader& occluders, Scenario& scenario) {
  const YamlMap world(map.at("world"), world_keys());
  const auto made = world.find("generator");
  std::optional<Generator> generator;
  if (made) generator = read_generator(*made, read_ball_radius_m(world));
  if (const auto randomise = map.find("randomise")) {
    if (scenario.sensor == SensorKind::kOracle) randomise->refuse("the oracle has no pictures to vary");
    scenario.randomise = read_randomisation(*randomise, generator ? generator->rules.in_view : 2, folder);
  }
  scenario.path = read_path(map.at("path"), generator ? &generator->layout : nullptr, folder);
  scenario.world = read_world(world, folder);
  if (scenario.randomise.floor && !scenario.world.has_floor)
    world.at("floor").refuse("expected a floor, of which randomise.floor draws the material");
  if (generator || scenario.randomise.clutter || scenario.randomise.distractors)
    give_occluders(scenario.world, occluders);
  if (generator)
    generate(*made, *generator, scenario);
  else
    check_balls(scenario, world.at("balls"));
}

}  // namespace

const KeyGroup& scenario_keys() {
  static const KeyGroup keys = {
      .kind_key = "sensor",
      .keys = {
          text("name", "Name of the results: small letters, digits and _.", kNamePattern).needed(),
          text("description", "What it is, for people.").otherwise_says("none"),
          choice("filters", {filter_names().begin(), filter_names().end()},
                 "Filters that are run; dead reckoning always is.")
              .list(1, 16)
              .otherwise("[dead_reckoning, fastslam2, ufastslam]"),
          whole("particles", 1, 100000, "Particles of each particle filter.").otherwise("100"),
          whole("draw_every", 1, 100000, "Frames of a block, of the filters that draw poses in blocks.")
              .otherwise("40"),
          flag("refit", "Whether a refused frame is fitted anew as a whole.").otherwise("true"),
          text("seeds", "Which seeds are run: 0..9 (both included), 3, or 0,4,7.", kSeedsPattern)
              .otherwise("0"),
          group("gates", gate_keys(), "Limits on metrics of run.json; a broken one is exit code 1.")
              .list(0, 1000),
          choice("sensor", {"stereo", "oracle"}, "Whether pictures are rendered, or range and bearing drawn.")
              .needed(),
          choice("identity", {"known", "colour_class", "none"}, "How landmarks are told apart.").needed(),
          choice("association", {"individual", "joint"},
                 "Whether sightings that compete for landmarks are settled each for itself or as a set.")
              .otherwise("joint"),
          number("colour_spacing_m", {0.0, 1e4},
                 "Least distance between balls that look alike, in metres, which filters may rely on.")
              .otherwise("0"),
          group("rig", rig_keys(), "The stereo rig as it is.").needed_for({"stereo"}),
          group("believed_rig", believed_rig_keys(), "What vision takes the rig for, where it is wrong."),
          group("camera", camera_keys(), "What the camera makes of the light."),
          group("shutter", shutter_keys(), "When the cameras look."),
          text("detector",
               "What finds the balls: the name of a linked detector, or the command of a program.")
              .otherwise_says("our own detector"),
          number("detector_timeout_s", {1e-3, 1e6}, "How long it may think about a frame, in seconds.")
              .otherwise("30"),
          number("detector_start_s", {0.0, 1e6},
                 "How much longer it may take for its first answer, in seconds, since it has to start.")
              .otherwise("90"),
          group("oracle", oracle_keys(), "The sensor without pixels.").needed_for({"oracle"}),
          group("believed_oracle", believed_oracle_keys(),
                "What filters are told of that sensor's sector and rates."),
          group("odometry_noise", odometry_noise_keys(), "Noise that the odometry really has.").needed(),
          group("believed_odometry_noise", odometry_noise_keys(),
                "Noise of the odometry that filters are told.")
              .otherwise_as("odometry_noise"),
          group("believed_measurement_noise", measurement_noise_keys(),
                "Noise of sightings that filters are told.")
              .otherwise_says("what each sighting states"),
          group("path", path_keys(), "The drive.").needed(),
          number("placement_jitter_m", {0.0, 100.0},
                 "Each seed moves each ball by up to so much in x and in y, in metres.")
              .otherwise("0"),
          group("randomise", randomisation_keys(), "What each seed draws anew.").otherwise_says("nothing"),
          group("world", world_keys(), "Balls, walls, meshes, floor, light and sky.").needed(),
      }};
  return keys;
}

Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const OccluderReader& occluders) {
  const YamlDocument document = load_yaml(file, overrides, &scenario_keys());
  const YamlValue top(document, "", document.root, document.root.Mark());
  check_keys(top, scenario_keys());
  const YamlMap map(top, scenario_keys());
  Scenario scenario;
  scenario.name = read_name(map.at("name"));
  if (const auto description = map.find("description")) scenario.description = description->text();
  read_run(map, scenario);
  read_sensing(map, file.parent_path(), scenario);
  read_odometry(map, scenario);
  scenario.placement_jitter_m = map.number("placement_jitter_m", 0.0);
  read_world_and_path(map, file.parent_path(), occluders, scenario);
  return scenario;
}

World world_for_seed(const Scenario& scenario, std::uint64_t seed) {
  return seed_world(scenario, seed).world;
}

}  // namespace stereobench::worlds
