#include "worlds/scenario/scenario.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "slam/filter_registry.h"
#include "worlds/generate/randomise.h"
#include "worlds/oracle.h"
#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario_checks.h"
#include "worlds/scenario/scenario_parts.h"
#include "worlds/scenario/seeds.h"

namespace stereobench::worlds {
namespace {

constexpr std::size_t kMostFilters = 16;
constexpr std::string_view kNamePattern = "^[a-z0-9_]{1,64}$";
constexpr std::string_view kSeedsPattern = R"(^[0-9]+(\.\.[0-9]+|(,[0-9]+)*)$)";

void read_name(const YamlValue& value, Scenario& scenario) {
  const std::string name = value.text();
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (name.find_first_not_of(kLetters) != std::string::npos || name.size() > 64) {
    value.fail("expected a name of small letters, digits and _, at most 64");
  }
  scenario.name = name;
}

const std::vector<std::string>& filter_names() {
  static const std::vector<std::string> names = slam::filter_names();
  return names;
}

void read_filters(const YamlValue& list, Scenario& scenario) {
  const std::vector<std::string_view> names(filter_names().begin(), filter_names().end());
  scenario.filters.clear();
  for (const YamlValue& entry : list.list(1, kMostFilters)) {
    scenario.filters.push_back(filter_names()[entry.choice(names)]);
    if (std::ranges::count(scenario.filters, scenario.filters.back()) > 1)
      entry.fail("expected each filter once");
  }
}

void read_seeds(const YamlValue& value, Scenario& scenario) {
  const std::string text = value.text();
  try {
    scenario.seeds = parse_seeds(text);
  } catch (const std::invalid_argument& error) {
    value.fail(error.what());
  }
}

YAML::Node written_seeds(const Scenario& scenario) {
  return YAML::Node(fmt::format("{}", fmt::join(scenario.seeds, ",")));
}

/// What is believed of the rig is what is so, but for what is said.
void read_rig(const YamlValue& value, Scenario& scenario) {
  scenario.rig = rig_keys().read(value);
  scenario.believed_rig = scenario.rig;
  if (scenario.sensor == SensorKind::kStereo) check_lens(value, scenario.rig);
}

void read_detector(const YamlValue& value, Scenario& scenario) {
  if (scenario.sensor != SensorKind::kStereo) value.refuse("the oracle has no pictures to look at");
  scenario.detector.command = value.text();
}

void read_odometry_noise(const YamlValue& value, Scenario& scenario) {
  scenario.odometry_noise = odometry_noise_keys().read(value);
  scenario.believed_odometry_noise = scenario.odometry_noise;
}

/// What depends on whether other groups are there.
void read_beliefs(const YamlMap& map, Scenario& scenario) {
  if (const auto believed = map.find("believed_oracle")) {
    if (!map.find("oracle")) believed->refuse("expected `oracle:` beside it, the sensor as it is");
    scenario.believed_sector = sector_of(scenario.oracle);
    believed_oracle_keys().read_into(*believed, *scenario.believed_sector);
  }
  if (const auto noise = map.find("believed_measurement_noise")) {
    const auto rig = map.find("rig") ? std::optional(scenario.believed_rig) : std::nullopt;
    const MeasurementNoise told = read_measurement_noise(*noise, rig);
    scenario.believed_measurement_noise = told.law;
    scenario.stated_sd_scale = told.stated_sd_scale;
  }
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

void read_world_and_path(const YamlMap& map, const OccluderReader& occluders, Scenario& scenario) {
  const YamlMap world(map.at("world"), world_keys());
  const auto made = world.find("generator");
  std::optional<Generator> generator;
  if (made) generator = read_generator(*made, read_ball_radius_m(world));
  if (const auto randomise = map.find("randomise")) {
    if (scenario.sensor == SensorKind::kOracle) randomise->refuse("the oracle has no pictures to vary");
    if (generator) scenario.randomise.balls_in_view = generator->rules.in_view;
    randomisation_keys().read_into(*randomise, scenario.randomise);
  }
  scenario.path = read_path(map.at("path"), generator ? &generator->layout : nullptr);
  scenario.world = read_world(world.value());
  if (scenario.randomise.floor && !scenario.world.has_floor)
    world.at("floor").refuse("expected a floor, of which randomise.floor draws the material");
  if (generator || scenario.randomise.clutter || scenario.randomise.distractors)
    give_occluders(scenario.world, occluders);
  if (generator)
    generate(*made, *generator, scenario);
  else
    check_balls(scenario, world.at("balls"));
}

const Fields<Scenario>& keys_of_scenario() {
  static const Fields<Scenario> keys(
      "sensor",
      {
          text("name", "Name of the results: small letters, digits and _.", kNamePattern)
              .needed()
              .by<Scenario>(read_name),
          text("description", "What it is, for people.").otherwise_says("none").fills(&Scenario::description),
          choice("filters", {filter_names().begin(), filter_names().end()},
                 "Filters that are run; dead reckoning always is.")
              .list(1, kMostFilters)
              .fills(&Scenario::filters)
              .reading(read_filters),
          whole("particles", 1, 100000, "Particles of each particle filter.").fills(&Scenario::particles),
          whole("draw_every", 1, 100000, "Frames of a block, of the filters that draw poses in blocks.")
              .fills(&Scenario::draw_every),
          flag("refit", "Whether a refused frame is fitted anew as a whole.").fills(&Scenario::refit),
          text("seeds", "Which seeds are run: 0..9 (both included), 3, or 0,4,7.", kSeedsPattern)
              .by<Scenario>(read_seeds, written_seeds),
          group("gates", gate_keys(), "Limits on metrics of run.json; a broken one is exit code 1.")
              .list(0, 1000)
              .fills(&Scenario::gates),
          choice("sensor", {"stereo", "oracle"}, "Whether pictures are rendered, or range and bearing drawn.")
              .needed()
              .fills(&Scenario::sensor),
          choice("identity", {"known", "colour_class", "none"}, "How landmarks are told apart.")
              .needed()
              .fills(&Scenario::identity),
          choice("association", {"individual", "joint"},
                 "Whether sightings that compete for landmarks are settled each for itself or as a set.")
              .fills(&Scenario::association),
          number("colour_spacing_m", {0.0, 1e4},
                 "Least distance between balls that look alike, in metres, which filters may rely on.")
              .fills(&Scenario::colour_spacing_m),
          group("rig", rig_keys(), "The stereo rig as it is.").needed_for({"stereo"}).by<Scenario>(read_rig),
          group("believed_rig", believed_rig_keys(), "What vision takes the rig for, where it is wrong.")
              .by<Scenario>([](const YamlValue& value, Scenario& scenario) {
                believed_rig_keys().read_into(value, scenario);
              }),
          group("camera", camera_keys(), "What the camera makes of the light.").fills(&Scenario::camera),
          group("shutter", shutter_keys(), "When the cameras look.").fills(&Scenario::shutter),
          text("detector",
               "What finds the balls: the name of a linked detector, or the command of a program.")
              .otherwise_says("our own detector")
              .by<Scenario>(read_detector),
          number("detector_timeout_s", {1e-3, 1e6}, "How long it may think about a frame, in seconds.")
              .fills(&Scenario::detector, &DetectorProgram::timeout_s),
          number("detector_start_s", {0.0, 1e6},
                 "How much longer it may take for its first answer, in seconds, since it has to start.")
              .fills(&Scenario::detector, &DetectorProgram::start_s),
          group("oracle", oracle_keys(), "The sensor without pixels.")
              .needed_for({"oracle"})
              .fills(&Scenario::oracle),
          group("believed_oracle", believed_oracle_keys(),
                "What filters are told of that sensor's sector and rates."),
          group("odometry_noise", odometry_noise_keys(), "Noise that the odometry really has.")
              .needed()
              .by<Scenario>(read_odometry_noise),
          group("believed_odometry_noise", odometry_noise_keys(),
                "Noise of the odometry that filters are told.")
              .otherwise_as("odometry_noise")
              .by<Scenario>([](const YamlValue& value, Scenario& scenario) {
                scenario.believed_odometry_noise = odometry_noise_keys().read(value);
              }),
          group("believed_measurement_noise", measurement_noise_keys(),
                "Noise of sightings that filters are told.")
              .otherwise_says("what each sighting states"),
          group("path", path_keys(), "The drive.").needed(),
          number("placement_jitter_m", {0.0, 100.0},
                 "Each seed moves each ball by up to so much in x and in y, in metres.")
              .fills(&Scenario::placement_jitter_m),
          group("randomise", randomisation_keys(), "What each seed draws anew.").otherwise_says("nothing"),
          group("world", world_keys(), "Balls, walls, meshes, floor, light and sky.").needed(),
      });
  return keys;
}

}  // namespace

const KeyGroup& scenario_keys() {
  return keys_of_scenario();
}

Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const OccluderReader& occluders) {
  const YamlDocument document = load_yaml(file, overrides, &scenario_keys());
  const YamlValue top(document, "", document.root, document.root.Mark());
  check_keys(top, scenario_keys());
  const YamlMap map(top, scenario_keys());
  Scenario scenario;
  keys_of_scenario().read_into(top, scenario);
  read_beliefs(map, scenario);
  read_world_and_path(map, occluders, scenario);
  return scenario;
}

World world_for_seed(const Scenario& scenario, std::uint64_t seed) {
  return seed_world(scenario, seed).world;
}

}  // namespace stereobench::worlds
