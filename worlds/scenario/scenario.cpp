#include "worlds/scenario/scenario.h"

#include <optional>
#include <stdexcept>

#include "worlds/generate/randomise.h"
#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario_checks.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr std::string_view kNamePattern = "^[a-z0-9_]{1,64}$";

void read_name(const YamlValue& value, Scenario& scenario) {
  const std::string name = value.text();
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (name.find_first_not_of(kLetters) != std::string::npos || name.size() > 64) {
    value.fail("expected a name of small letters, digits and _, at most 64");
  }
  scenario.name = name;
}

/// What is believed of the rig is what is so, but for what is said.
void read_rig(const YamlValue& value, Scenario& scenario) {
  scenario.rig = rig_keys().read(value);
  scenario.believed_rig = scenario.rig;
  if (scenario.sensor == SensorKind::kStereo) check_lens(value, scenario.rig);
}

void read_believed_rig(const YamlValue& value, Scenario& scenario) {
  believed_rig_keys().read_into(value, scenario);
}

std::vector<Field<Scenario>> title_fields() {
  return {
      text("name", "Name of the results: small letters, digits and _.", kNamePattern)
          .needed()
          .by<Scenario>(read_name),
      text("description", "What it is, for people.").otherwise_says("none").fills(&Scenario::description),
  };
}

std::vector<Field<Scenario>> identity_fields() {
  return {
      choice("sensor", {"stereo", "oracle"}, "Whether pictures are rendered, or range and bearing drawn.")
          .needed()
          .fills(&Scenario::sensor),
      choice("identity", {"known", "colour_class", "none"}, "How landmarks are told apart.")
          .needed()
          .fills(&Scenario::identity),
      number("colour_spacing_m", {0.0, 1e4},
             "Least distance between balls that look alike, in metres, which filters may rely on.")
          .fills(&Scenario::colour_spacing_m),
  };
}

std::vector<Field<Scenario>> sensor_fields() {
  return {
      group("rig", rig_keys(), "The stereo rig as it is.").needed_for({"stereo"}).by<Scenario>(read_rig),
      group("believed_rig", believed_rig_keys(), "What vision takes the rig for, where it is wrong.")
          .by<Scenario>(read_believed_rig),
      group("camera", camera_keys(), "What the camera makes of the light.").fills(&Scenario::camera),
      group("shutter", shutter_keys(), "When the cameras look.").fills(&Scenario::shutter),
      group("oracle", oracle_keys(), "The sensor without pixels.")
          .needed_for({"oracle"})
          .fills(&Scenario::oracle),
      group("odometry_noise", odometry_noise_keys(), "Noise that the odometry really has.")
          .needed()
          .fills(&Scenario::odometry_noise),
      group("start_noise", start_noise_keys(),
            "By how much the start pose is off that filters are told. Each seed draws it; only `run` and "
            "`sweep` "
            "do.")
          .fills(&Scenario::start_noise),
  };
}

/// What read_world_and_path reads, and what each seed draws.
std::vector<Field<Scenario>> world_fields() {
  return {
      group("path", path_keys(), "The drive.").needed(),
      number("placement_jitter_m", {0.0, 100.0},
             "Each seed moves each ball by up to so much in x and in y, in metres.")
          .fills(&Scenario::placement_jitter_m),
      group("randomise", randomisation_keys(), "What each seed draws anew.").otherwise_says("nothing"),
      group("world", world_keys(), "Balls, walls, meshes, floor, light and sky.").needed(),
  };
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

}  // namespace

const Fields<Scenario>& scenario_keys() {
  static const Fields<Scenario> keys(
      "sensor", joined<Scenario>({title_fields(), identity_fields(), sensor_fields(), world_fields()}));
  return keys;
}

void read_world_and_path(const YamlMap& top, const OccluderReader& occluders, Scenario& scenario) {
  const YamlMap world(top.at("world"), world_keys());
  const auto made = world.find("generator");
  std::optional<Generator> generator;
  if (made) generator = read_generator(*made, read_ball_radius_m(world));
  if (const auto randomise = top.find("randomise")) {
    if (scenario.sensor == SensorKind::kOracle) randomise->refuse("the oracle has no pictures to vary");
    if (generator) scenario.randomise.balls_in_view = generator->rules.in_view;
    randomisation_keys().read_into(*randomise, scenario.randomise);
  }
  scenario.path = read_path(top.at("path"), generator ? &generator->layout : nullptr);
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

World world_for_seed(const Scenario& scenario, std::uint64_t seed) {
  return seed_world(scenario, seed).world;
}

}  // namespace stereobench::worlds
