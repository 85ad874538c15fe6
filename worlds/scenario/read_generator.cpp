#include <stdexcept>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "worlds/scenario/generator.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

enum class GeneratorKind { kBallRing, kBallField, kCorridorLoop, kOfficeGrid, kMaze };
constexpr Interval kRoomSize_m = {0.1, 1e3};

/// What a generator's line says.
struct GeneratorLines {
  GeneratorKind kind = GeneratorKind::kBallRing;
  PlacementRules rules;
  LatticeConfig lattice;
  int balls = 0;  ///< of a ring, or a field
  Eigen::Vector2d centre_m = Eigen::Vector2d::Zero();
  double ring_radius_m = 0.0;
  Eigen::Vector2d low_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d high_m = Eigen::Vector2d::Zero();
};

std::vector<Eigen::Vector2d> ring_of(const GeneratorLines& line) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < line.balls; ++i) {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * i / line.balls);
    places.push_back(line.centre_m + line.ring_radius_m * Eigen::Vector2d(c, s));
  }
  return places;
}

void check_field(const YamlMap& map, GeneratorLines& line) {
  if (line.kind == GeneratorKind::kBallField && Eigen::AlignedBox2d(line.low_m, line.high_m).isEmpty())
    map.at("high_m").refuse("expected high_m above low_m");
}

Generator made(GeneratorLines line) {
  Generator generator{.rules = line.rules};
  line.lattice.seed = line.rules.seed;
  switch (line.kind) {
    case GeneratorKind::kBallRing:
      generator.rules.first_m = ring_of(line);
      break;
    case GeneratorKind::kBallField:
      generator.rules.scattered = line.balls;
      generator.rules.field_m = {line.low_m, line.high_m};
      break;
    case GeneratorKind::kCorridorLoop:
      generator.layout = make_corridor_loop(line.lattice);
      break;
    case GeneratorKind::kOfficeGrid:
      generator.layout = make_office_grid(line.lattice);
      break;
    case GeneratorKind::kMaze:
      generator.layout = make_maze(line.lattice);
      break;
  }
  return generator;
}

std::vector<Field<GeneratorLines>> general_fields() {
  return {
      choice("kind", {"ball_ring", "ball_field", "corridor_loop", "office_grid", "maze"},
             "What is made; the last three have walls, and a tour to drive.")
          .needed()
          .fills(&GeneratorLines::kind),
      whole("seed", 0, 2147483647, "The same seed makes the same world, bit for bit.")
          .fills(&GeneratorLines::rules, &PlacementRules::seed),
      whole("balls_in_view", 0, 254, "Balls are placed until at each step so many are in view, at least.")
          .fills(&GeneratorLines::rules, &PlacementRules::in_view),
      whole("most_balls", 1, 254, "How many balls may be placed.")
          .fills(&GeneratorLines::rules, &PlacementRules::most_balls),
      number("clearance_m", {0.0, 100.0}, "Distance between the drive and a ball, in metres.")
          .fills(&GeneratorLines::rules, &PlacementRules::clearance_m),
  };
}

/// Of balls without walls.
std::vector<Field<GeneratorLines>> ring_and_field_fields() {
  const Key::Kinds both = {"ball_ring", "ball_field"};
  return {
      whole("balls", 1, 254, "How many balls stand on the ring, or in the field.")
          .only_for(both)
          .needed_for(both)
          .fills(&GeneratorLines::balls),
      number("centre_m", kPlace_m, "Middle of the ring: x, y in metres.")
          .only_for({"ball_ring"})
          .fills(&GeneratorLines::centre_m),
      number("ring_radius_m", kRoomSize_m, "Radius of the ring, in metres.")
          .only_for({"ball_ring"})
          .needed_for({"ball_ring"})
          .fills(&GeneratorLines::ring_radius_m),
      number("low_m", kPlace_m, "South-west corner of the field: x, y in metres.")
          .only_for({"ball_field"})
          .needed_for({"ball_field"})
          .fills(&GeneratorLines::low_m),
      number("high_m", kPlace_m, "North-east corner of the field: x, y in metres.")
          .only_for({"ball_field"})
          .needed_for({"ball_field"})
          .fills(&GeneratorLines::high_m),
  };
}

/// Of corridors between walls.
std::vector<Field<GeneratorLines>> lattice_fields() {
  const Key::Kinds lattices = {"corridor_loop", "office_grid", "maze"};
  const Key::Kinds corridors = {"corridor_loop", "office_grid"};
  return {
      whole("columns", 1, 50, "Cells from west to east.")
          .only_for(lattices)
          .fills(&GeneratorLines::lattice, &LatticeConfig::columns),
      whole("rows", 1, 50, "Cells from south to north.")
          .only_for(lattices)
          .fills(&GeneratorLines::lattice, &LatticeConfig::rows),
      number("pitch_m", kRoomSize_m, "Side of a cell, in metres.")
          .only_for(lattices)
          .fills(&GeneratorLines::lattice, &LatticeConfig::pitch_m),
      number("width_m", {0.5, 100.0}, "Width of corridors, in metres.")
          .only_for(corridors)
          .fills(&GeneratorLines::lattice, &LatticeConfig::width_m),
      whole("turns", 4, 200, "Turns of the tour, at least.")
          .only_for(corridors)
          .fills(&GeneratorLines::lattice, &LatticeConfig::turns),
      whole("doors", 0, 1000, "Panels of wood on the walls.")
          .only_for({"corridor_loop"})
          .fills(&GeneratorLines::lattice, &LatticeConfig::doors),
      number("height_m", kRoomSize_m, "Height of the walls, in metres.")
          .only_for(lattices)
          .fills(&GeneratorLines::lattice, &LatticeConfig::height_m),
  };
}

const Fields<GeneratorLines>& generator_line_keys() {
  static const Fields<GeneratorLines> keys(
      "kind", joined<GeneratorLines>({general_fields(), ring_and_field_fields(), lattice_fields()}),
      check_field);
  return keys;
}

}  // namespace

const KeyGroup& generator_keys() {
  return generator_line_keys();
}

Generator read_generator(const YamlValue& value, double ball_radius_m) {
  GeneratorLines line = generator_line_keys().read(value);
  line.rules.radius_m = ball_radius_m;
  try {
    return made(std::move(line));
  } catch (const std::invalid_argument& error) {
    value.refuse(error.what());
  }
}

}  // namespace stereobench::worlds
