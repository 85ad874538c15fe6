#include <array>
#include <numbers>
#include <stdexcept>

#include "slam/elementary.h"
#include "worlds/generator.h"
#include "worlds/scenario_parts.h"

namespace stereobench::worlds {
namespace {

enum class Kind { kBallRing, kBallField, kCorridorLoop, kOfficeGrid, kMaze };
constexpr std::array<std::string_view, 5> kKinds = {"ball_ring", "ball_field", "corridor_loop", "office_grid",
                                                    "maze"};
constexpr std::array<std::string_view, 17> kKeys = {
    "kind",     "seed",          "balls_in_view", "most_balls", "clearance_m", "balls",
    "centre_m", "ring_radius_m", "low_m",         "high_m",     "columns",     "rows",
    "pitch_m",  "width_m",       "turns",         "doors",      "height_m"};
constexpr std::array<std::string_view, 5> kCommonKeys = {"kind", "seed", "balls_in_view", "most_balls",
                                                         "clearance_m"};
constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kSize_m = {0.1, 1e3};

/// The keys of one kind are those that all have, and its own.
void check_keys(const YamlValue& value, std::initializer_list<std::string_view> own) {
  std::vector<std::string_view> known(kCommonKeys.begin(), kCommonKeys.end());
  known.insert(known.end(), own.begin(), own.end());
  YamlMap(value, known);
}

std::vector<Eigen::Vector2d> read_ring(const YamlMap& map) {
  const int balls = map.at("balls").integer(1, 254);
  const double radius_m = map.number("ring_radius_m", kSize_m);
  const auto centre = map.find("centre_m");
  const Eigen::Vector2d centre_m = centre ? read_vector<2>(*centre, kPlace_m) : Eigen::Vector2d(0.0, 0.0);
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < balls; ++i) {
    const auto [s, c] = slam::sine_cosine(2.0 * std::numbers::pi * i / balls);
    places.push_back(centre_m + radius_m * Eigen::Vector2d(c, s));
  }
  return places;
}

LatticeConfig read_lattice(const YamlMap& map, std::uint64_t seed) {
  LatticeConfig config;
  config.seed = seed;
  const auto count = [&](std::string_view key, int least, int most, int& value) {
    if (const auto written = map.find(key)) value = written->integer(least, most);
  };
  count("columns", 1, 50, config.columns);
  count("rows", 1, 50, config.rows);
  count("turns", 4, 200, config.turns);
  count("doors", 0, 1000, config.doors);
  config.pitch_m = map.number("pitch_m", kSize_m, config.pitch_m);
  config.width_m = map.number("width_m", {0.5, 100.0}, config.width_m);
  config.height_m = map.number("height_m", kSize_m, config.height_m);
  return config;
}

void read_rules(const YamlMap& map, PlacementRules& rules) {
  if (const auto seed = map.find("seed"))
    rules.seed = static_cast<std::uint64_t>(seed->integer(0, 2147483647));
  if (const auto count = map.find("balls_in_view")) rules.in_view = count->integer(0, 254);
  if (const auto count = map.find("most_balls")) rules.most_balls = count->integer(1, 254);
  rules.clearance_m = map.number("clearance_m", {0.0, 100.0}, rules.clearance_m);
}

void make(const YamlValue& value, Kind kind, const YamlMap& map, Generator& generator) {
  switch (kind) {
    case Kind::kBallRing:
      check_keys(value, {"balls", "centre_m", "ring_radius_m"});
      generator.rules.first_m = read_ring(map);
      return;
    case Kind::kBallField:
      check_keys(value, {"balls", "low_m", "high_m"});
      generator.rules.scattered = map.at("balls").integer(1, 254);
      generator.rules.field_m = {read_vector<2>(map.at("low_m"), kPlace_m),
                                 read_vector<2>(map.at("high_m"), kPlace_m)};
      if (generator.rules.field_m.isEmpty()) map.at("high_m").refuse("expected high_m above low_m");
      return;
    case Kind::kCorridorLoop:
      check_keys(value, {"columns", "rows", "pitch_m", "width_m", "turns", "doors", "height_m"});
      generator.layout = make_corridor_loop(read_lattice(map, generator.rules.seed));
      return;
    case Kind::kOfficeGrid:
      check_keys(value, {"columns", "rows", "pitch_m", "width_m", "turns", "height_m"});
      generator.layout = make_office_grid(read_lattice(map, generator.rules.seed));
      return;
    case Kind::kMaze:
      check_keys(value, {"columns", "rows", "pitch_m", "height_m"});
      generator.layout = make_maze(read_lattice(map, generator.rules.seed));
      return;
  }
}

}  // namespace

Generator read_generator(const YamlValue& value, double ball_radius_m) {
  const YamlMap map(value, kKeys);
  Generator generator;
  generator.rules.radius_m = ball_radius_m;
  read_rules(map, generator.rules);
  try {
    make(value, static_cast<Kind>(map.at("kind").choice(kKinds)), map, generator);
  } catch (const std::invalid_argument& error) {
    value.refuse(error.what());
  }
  return generator;
}

}  // namespace stereobench::worlds
