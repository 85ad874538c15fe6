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

/// What a generator's line says.
struct Line {
  Kind kind = Kind::kBallRing;
  PlacementRules rules;
  LatticeConfig lattice;
  int balls = 0;  ///< of a ring, or a field
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double ring_radius_m = 0.0;
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d high_m = Eigen::Vector2d::Zero();
};

std::vector<Eigen::Vector2d> ring_of(const Line& line) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < line.balls; ++i) {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * i / line.balls);
    places.push_back(line.centre_m + line.ring_radius_m * Eigen::Vector2d(c, s));
  }
  return places;
}

void check_field(const YamlMap& map, Line& line) {
  if (line.kind == Kind::kBallField && Eigen::AlignedBox2d(line.low_m, line.high_m).isEmpty())
    map.at("high_m").refuse("expected high_m above low_m");
}

Generator made(Line line) {
  Generator generator{.rules = line.rules};
  line.lattice.seed = line.rules.seed;
  switch (line.kind) {
    case Kind::kBallRing:
      generator.rules.first_m = ring_of(line);
      break;
    case Kind::kBallField:
      generator.rules.scattered = line.balls;
      generator.rules.field_m = {line.low_m, line.high_m};
      break;
    case Kind::kCorridorLoop:
      generator.layout = make_corridor_loop(line.lattice);
      break;
    case Kind::kOfficeGrid:
      generator.layout = make_office_grid(line.lattice);
      break;
    case Kind::kMaze:
      generator.layout = make_maze(line.lattice);
      break;
  }
  return generator;
}

std::vector<Field<Line>> general_fields() {
  return {
      choice("kind", {"ball_ring", "ball_field", "corridor_loop", "office_grid", "maze"},
             "What is made; the last three have walls, and a tour to drive.")
          .needed()
          .fills(&Line::kind),
      whole("seed", 0, 2147483647, "The same seed makes the same world, bit for bit.")
          .fills(&Line::rules, &PlacementRules::seed),
      whole("balls_in_view", 0, 254, "Balls are placed until at each step so many are in view, at least.")
          .fills(&Line::rules, &PlacementRules::in_view),
      whole("most_balls", 1, 254, "How many balls may be placed.")
          .fills(&Line::rules, &PlacementRules::most_balls),
      number("clearance_m", {0.0, 100.0}, "Distance between the drive and a ball, in metres.")
          .fills(&Line::rules, &PlacementRules::clearance_m),
  };
}

/// Of balls without walls.
std::vector<Field<Line>> ring_and_field_fields() {
  const Key::Kinds both = {"ball_ring", "ball_field"};
  return {
      whole("balls", 1, 254, "How many balls stand on the ring, or in the field.")
          .only_for(both)
          .needed_for(both)
          .fills(&Line::balls),
      number("centre_m", kPlace_m, "Middle of the ring: x, y in metres.")
          .only_for({"ball_ring"})
          .fills(&Line::centre_m),
      number("ring_radius_m", kSize_m, "Radius of the ring, in metres.")
          .only_for({"ball_ring"})
          .needed_for({"ball_ring"})
          .fills(&Line::ring_radius_m),
      number("low_m", kPlace_m, "South-west corner of the field: x, y in metres.")
          .only_for({"ball_field"})
          .needed_for({"ball_field"})
          .fills(&Line::low_m),
      number("high_m", kPlace_m, "North-east corner of the field: x, y in metres.")
          .only_for({"ball_field"})
          .needed_for({"ball_field"})
          .fills(&Line::high_m),
  };
}

/// Of corridors between walls.
std::vector<Field<Line>> lattice_fields() {
  const Key::Kinds lattices = {"corridor_loop", "office_grid", "maze"};
  const Key::Kinds corridors = {"corridor_loop", "office_grid"};
  return {
      whole("columns", 1, 50, "Cells from west to east.")
          .only_for(lattices)
          .fills(&Line::lattice, &LatticeConfig::columns),
      whole("rows", 1, 50, "Cells from south to north.")
          .only_for(lattices)
          .fills(&Line::lattice, &LatticeConfig::rows),
      number("pitch_m", kSize_m, "Side of a cell, in metres.")
          .only_for(lattices)
          .fills(&Line::lattice, &LatticeConfig::pitch_m),
      number("width_m", {0.5, 100.0}, "Width of corridors, in metres.")
          .only_for(corridors)
          .fills(&Line::lattice, &LatticeConfig::width_m),
      whole("turns", 4, 200, "Turns of the tour, at least.")
          .only_for(corridors)
          .fills(&Line::lattice, &LatticeConfig::turns),
      whole("doors", 0, 1000, "Panels of wood on the walls.")
          .only_for({"corridor_loop"})
          .fills(&Line::lattice, &LatticeConfig::doors),
      number("height_m", kSize_m, "Height of the walls, in metres.")
          .only_for(lattices)
          .fills(&Line::lattice, &LatticeConfig::height_m),
  };
}

const Fields<Line>& line_keys() {
  static const Fields<Line> keys(
      "kind", joined<Line>({general_fields(), ring_and_field_fields(), lattice_fields()}), check_field);
  return keys;
}

}  // namespace

const KeyGroup& generator_keys() {
  return line_keys();
}

Generator read_generator(const YamlValue& value, double ball_radius_m) {
  Line line = line_keys().read(value);
  line.rules.radius_m = ball_radius_m;
  try {
    return made(std::move(line));
  } catch (const std::invalid_argument& error) {
    value.refuse(error.what());
  }
}

}  // namespace stereobench::worlds
