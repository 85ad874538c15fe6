#include "worlds/scenario.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "slam/filter_names.h"
#include "worlds/generator.h"
#include "worlds/randomise.h"
#include "worlds/scenario_checks.h"
#include "worlds/scenario_parts.h"
#include "worlds/seeds.h"

namespace stereobench::worlds {
namespace {

std::string read_name(const YamlValue& value) {
  const std::string name = value.text();
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (name.find_first_not_of(kLetters) != std::string::npos || name.size() > 64) {
    value.fail("expected a name of small letters, digits and _, at most 64");
  }
  return name;
}

std::vector<std::string> read_filters(const YamlValue& value) {
  const std::vector<std::string> known = slam::filter_names();
  const std::vector<std::string_view> names(known.begin(), known.end());
  std::vector<std::string> filters;
  for (const YamlValue& entry : value.list(1, 16)) {
    filters.push_back(known[entry.choice(names)]);
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
  if (const auto filters = map.find("filters")) scenario.filters = read_filters(*filters);
  if (const auto particles = map.find("particles")) scenario.particles = particles->integer(1, 100000);
  if (const auto draw_every = map.find("draw_every")) scenario.draw_every = draw_every->integer(1, 100000);
  if (const auto refit = map.find("refit")) scenario.refit = refit->flag();
  if (const auto seeds = map.find("seeds")) scenario.seeds = read_seeds(*seeds);
  if (const auto gates = map.find("gates")) scenario.gates = read_gates(*gates);
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
  constexpr std::array<std::string_view, 2> kSensors = {"stereo", "oracle"};
  constexpr std::array<std::string_view, 3> kIdentities = {"known", "colour_class", "none"};
  constexpr std::array<std::string_view, 2> kAssociations = {"individual", "joint"};
  scenario.sensor = static_cast<SensorKind>(map.at("sensor").choice(kSensors));
  scenario.identity = static_cast<Identity>(map.at("identity").choice(kIdentities));
  scenario.colour_spacing_m = map.number("colour_spacing_m", {0.0, 1e4}, 0.0);
  if (const auto association = map.find("association"))
    scenario.association = static_cast<slam::Association>(association->choice(kAssociations));
  const bool stereo = scenario.sensor == SensorKind::kStereo;
  if (const auto rig = stereo ? map.at("rig") : map.find("rig")) scenario.rig = read_rig(*rig);
  const auto believed = map.find("believed_rig");
  scenario.believed_rig = believed ? read_believed_rig(*believed, scenario.rig) : scenario.rig;
  if (const auto camera = map.find("camera")) scenario.camera = read_camera(*camera);
  if (const auto shutter = map.find("shutter")) scenario.shutter = read_shutter(*shutter);
  if (const auto detector = map.find("detector")) {
    if (!stereo) detector->refuse("the oracle has no pictures to look at");
    scenario.detector.command = detector->text();
  }
  scenario.detector.timeout_s = map.number("detector_timeout_s", {1e-3, 1e6}, scenario.detector.timeout_s);
  if (const auto noise = map.find("believed_measurement_noise")) {
    const auto rig = map.find("rig") ? std::optional(scenario.believed_rig) : std::nullopt;
    const MeasurementNoise told = read_measurement_noise(*noise, rig, folder);
    scenario.believed_measurement_noise = told.law;
    scenario.stated_sd_scale = told.stated_sd_scale;
  }
  read_oracles(map, scenario);
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

void read_world_and_path(const YamlMap& map, const std::filesystem::path& folder, const SolidReader& solids,
                         Scenario& scenario) {
  const YamlMap world(map.at("world"), kWorldKeys);
  const auto made = world.find("generator");
  std::optional<Generator> generator;
  if (made) generator = read_generator(*made, read_ball_radius_m(world));
  if (const auto randomise = map.find("randomise")) {
    if (scenario.sensor == SensorKind::kOracle) randomise->refuse("the oracle has no pictures to vary");
    scenario.randomise = read_randomisation(*randomise, generator ? generator->rules.in_view : 2, folder);
  }
  scenario.path = read_path(map.at("path"), generator ? &generator->layout : nullptr, folder);
  scenario.world = read_world(world, folder);
  if (generator || scenario.randomise.clutter || scenario.randomise.distractors)
    give_solids(scenario.world, solids);
  if (generator)
    generate(*made, *generator, scenario);
  else
    check_balls(scenario, world.at("balls"));
}

}  // namespace

Scenario read_scenario(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const SolidReader& solids) {
  const YamlDocument document = load_yaml(file, overrides);
  const YamlMap map(YamlValue(document, "", document.root, document.root.Mark()),
                    {"name",
                     "description",
                     "filters",
                     "particles",
                     "draw_every",
                     "refit",
                     "seeds",
                     "gates",
                     "sensor",
                     "identity",
                     "association",
                     "colour_spacing_m",
                     "rig",
                     "believed_rig",
                     "camera",
                     "shutter",
                     "detector",
                     "detector_timeout_s",
                     "oracle",
                     "believed_oracle",
                     "odometry_noise",
                     "believed_odometry_noise",
                     "believed_measurement_noise",
                     "path",
                     "placement_jitter_m",
                     "randomise",
                     "world"});
  Scenario scenario;
  scenario.name = read_name(map.at("name"));
  if (const auto description = map.find("description")) scenario.description = description->text();
  read_run(map, scenario);
  read_sensing(map, file.parent_path(), scenario);
  read_odometry(map, scenario);
  scenario.placement_jitter_m = map.number("placement_jitter_m", {0.0, 100.0}, 0.0);
  read_world_and_path(map, file.parent_path(), solids, scenario);
  return scenario;
}

World world_for_seed(const Scenario& scenario, std::uint64_t seed) {
  return seed_world(scenario, seed).world;
}

}  // namespace stereobench::worlds
