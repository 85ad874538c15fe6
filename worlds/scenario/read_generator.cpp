#include <stdexcept>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

enum class Kind { kBallRing, kBallField, kCorridorLoop, kOfficeGrid, kMaze };
constexpr Interval kPlace_m = {-1e4, 1e4};
constexpr Interval kSize_m = {0.1, 1e3};

std::vector<Eigen::Vector2d> read_ring(const YamlMap& map) {
  const int balls = map.whole("balls");
  const double radius_m = map.number("ring_radius_m");
  const Eigen::Vector2d centre_m = read_vector<2>(map, "centre_m", Eigen::Vector2d(0.0, 0.0));
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < balls; ++i) {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * i / balls);
    places.push_back(centre_m + radius_m * Eigen::Vector2d(c, s));
  }
  return places;
}

LatticeConfig read_lattice(const YamlMap& map, std::uint64_t seed) {
  LatticeConfig config;
  config.seed = seed;
  config.columns = map.whole("columns", config.columns);
  config.rows = map.whole("rows", config.rows);
  config.turns = map.whole("turns", config.turns);
  config.doors = map.whole("doors", config.doors);
  config.pitch_m = map.number("pitch_m", config.pitch_m);
  config.width_m = map.number("width_m", config.width_m);
  config.height_m = map.number("height_m", config.height_m);
  return config;
}

void read_field(const YamlMap& map, PlacementRules& rules) {
  rules.scattered = map.whole("balls");
  rules.field_m = {read_vector<2>(map, "low_m"), read_vector<2>(map, "high_m")};
  if (rules.field_m.isEmpty()) map.at("high_m").refuse("expected high_m above low_m");
}

void make(Kind kind, const YamlMap& map, Generator& generator) {
  switch (kind) {
    case Kind::kBallRing:
      generator.rules.first_m = read_ring(map);
      return;
    case Kind::kBallField:
      read_field(map, generator.rules);
      return;
    case Kind::kCorridorLoop:
      generator.layout = make_corridor_loop(read_lattice(map, generator.rules.seed));
      return;
    case Kind::kOfficeGrid:
      generator.layout = make_office_grid(read_lattice(map, generator.rules.seed));
      return;
    case Kind::kMaze:
      generator.layout = make_maze(read_lattice(map, generator.rules.seed));
      return;
  }
}

}  // namespace

const KeyGroup& generator_keys() {
  static const std::vector<std::string_view> lattices = {"corridor_loop", "office_grid", "maze"};
  static const std::vector<std::string_view> corridors = {"corridor_loop", "office_grid"};
  static const std::vector<std::string_view> fields = {"ball_ring", "ball_field"};
  static const KeyGroup keys = {
      .kind_key = "kind",
      .keys = {
          choice("kind", {"ball_ring", "ball_field", "corridor_loop", "office_grid", "maze"},
                 "What is made; the last three have walls, and a tour to drive.")
              .needed(),
          whole("seed", 0, 2147483647, "The same seed makes the same world, bit for bit.").otherwise("0"),
          whole("balls_in_view", 0, 254, "Balls are placed until at each step so many are in view, at least.")
              .otherwise("2"),
          whole("most_balls", 1, 254, "How many balls may be placed.").otherwise("100"),
          number("clearance_m", {0.0, 100.0}, "Distance between the drive and a ball, in metres.")
              .otherwise("0.3"),
          whole("balls", 1, 254, "How many balls stand on the ring, or in the field.")
              .only_for(fields)
              .needed_for(fields),
          number("centre_m", kPlace_m, "Middle of the ring: x, y in metres.")
              .vector(2)
              .only_for({"ball_ring"})
              .otherwise("[0, 0]"),
          number("ring_radius_m", kSize_m, "Radius of the ring, in metres.")
              .only_for({"ball_ring"})
              .needed_for({"ball_ring"}),
          number("low_m", kPlace_m, "South-west corner of the field: x, y in metres.")
              .vector(2)
              .only_for({"ball_field"})
              .needed_for({"ball_field"}),
          number("high_m", kPlace_m, "North-east corner of the field: x, y in metres.")
              .vector(2)
              .only_for({"ball_field"})
              .needed_for({"ball_field"}),
          whole("columns", 1, 50, "Cells from west to east.").only_for(lattices).otherwise("3"),
          whole("rows", 1, 50, "Cells from south to north.").only_for(lattices).otherwise("3"),
          number("pitch_m", kSize_m, "Side of a cell, in metres.").only_for(lattices).otherwise("6"),
          number("width_m", {0.5, 100.0}, "Width of corridors, in metres.")
              .only_for(corridors)
              .otherwise("2.4"),
          whole("turns", 4, 200, "Turns of the tour, at least.").only_for(corridors).otherwise("4"),
          whole("doors", 0, 1000, "Panels of wood on the walls.").only_for({"corridor_loop"}).otherwise("0"),
          number("height_m", kSize_m, "Height of the walls, in metres.").only_for(lattices).otherwise("2.6"),
      }};
  return keys;
}

Generator read_generator(const YamlValue& value, double ball_radius_m) {
  const YamlMap map(value, generator_keys());
  Generator generator;
  PlacementRules& rules = generator.rules;
  rules.radius_m = ball_radius_m;
  rules.seed = static_cast<std::uint64_t>(map.whole("seed", static_cast<int>(rules.seed)));
  rules.in_view = map.whole("balls_in_view", rules.in_view);
  rules.most_balls = map.whole("most_balls", rules.most_balls);
  rules.clearance_m = map.number("clearance_m", rules.clearance_m);
  try {
    make(static_cast<Kind>(map.choice("kind")), map, generator);
  } catch (const std::invalid_argument& error) {
    value.refuse(error.what());
  }
  return generator;
}

}  // namespace stereobench::worlds
