#include "worlds/generate/layout.h"

#include <algorithm>
#include <stdexcept>

#include "slam/math/random.h"
#include "worlds/generate/lattice.h"

namespace stereobench::worlds {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2i;

// Which draws of a generated world are whose.
enum DrawKey : std::uint64_t { kShape = 1U << 20U, kDoors };

constexpr double kDoorWidth_m = 0.9;
constexpr double kDoorHeight_m = 2.0;
constexpr double kDoorOffset_m = 0.02;  // in front of its wall

void append_closed(const std::vector<Vector2d>& corners_m, double height_m, Material material,
                   std::vector<Wall>& walls) {
  for (std::size_t i = 0; i < corners_m.size(); ++i)
    walls.push_back({corners_m[i], corners_m[(i + 1) % corners_m.size()], height_m, material});
}

Vector2d left_of(const Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

/// A loop of right angles moved to its left everywhere.
std::vector<Vector2d> moved_left(const std::vector<Vector2d>& loop_m, double by_m) {
  std::vector<Vector2d> moved;
  const std::size_t n = loop_m.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d in = (loop_m[i] - loop_m[(i + n - 1) % n]).normalized();
    const Vector2d out = (loop_m[(i + 1) % n] - loop_m[i]).normalized();
    moved.push_back(loop_m[i] + by_m * (left_of(in) + left_of(out)));
  }
  return moved;
}

void require_room(const LatticeConfig& config) {
  if (config.pitch_m < 2.0 * config.width_m)
    throw std::invalid_argument("expected a pitch_m of at least two widths of its corridors");
}

Layout loop_tour(const LatticeConfig& config) {
  require_room(config);
  slam::RandomStream draws(config.seed, slam::Stream::kWorld, kShape);
  Layout layout;
  for (const Vector2i& corner : random_loop(config.columns, config.rows, config.turns, draws))
    layout.tour_m.push_back(config.pitch_m * corner.cast<double>());
  if (layout.tour_m.empty())
    throw std::invalid_argument("expected fewer turns, or more columns and rows: no loop has so many");
  layout.closed = true;
  layout.corner_radius_m = 0.5 * config.width_m;
  return layout;
}

/// Panels of wood in front of a corridor's walls.
void append_doors(const LatticeConfig& config, const std::vector<Wall>& walls, std::vector<Wall>& doors) {
  slam::RandomStream draws(config.seed, slam::Stream::kWorld, kDoors);
  for (int i = 0; i < config.doors; ++i) {
    const auto chosen = static_cast<std::size_t>(draws.uniform() * static_cast<double>(walls.size()));
    const Wall& wall = walls[chosen];
    const Vector2d along = (wall.to_m - wall.from_m).normalized();
    const double room_m = (wall.to_m - wall.from_m).norm() - kDoorWidth_m;
    const double side = chosen < walls.size() / 2 ? 1.0 : -1.0;  // the outer walls come first
    const Vector2d from =
        wall.from_m + draws.uniform() * room_m * along + side * kDoorOffset_m * left_of(along);
    doors.push_back(
        {from, from + kDoorWidth_m * along, std::min(kDoorHeight_m, wall.height_m), Material::kWood});
  }
}

}  // namespace

Layout make_corridor_loop(const LatticeConfig& config) {
  Layout layout = loop_tour(config);
  const double half_m = 0.5 * config.width_m;
  append_closed(moved_left(layout.tour_m, -half_m), config.height_m, Material::kPlaster, layout.walls);
  append_closed(moved_left(layout.tour_m, half_m), config.height_m, Material::kBricks, layout.walls);
  append_doors(config, std::vector<Wall>(layout.walls), layout.walls);
  return layout;
}

Layout make_office_grid(const LatticeConfig& config) {
  Layout layout = loop_tour(config);
  const double half_m = 0.5 * config.width_m;
  const auto box = [&](const Vector2d& low, const Vector2d& high, Material material) {
    append_closed({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, config.height_m, material,
                  layout.walls);
  };
  const Vector2d margin = Vector2d::Constant(half_m);
  box(-margin, config.pitch_m * Vector2d(config.columns, config.rows) + margin, Material::kPlaster);
  for (int row = 0; row < config.rows; ++row)
    for (int column = 0; column < config.columns; ++column)
      box(config.pitch_m * Vector2d(column, row) + margin,
          config.pitch_m * Vector2d(column + 1, row + 1) - margin,
          (row + column) % 2 == 0 ? Material::kPlaster : Material::kBricks);
  return layout;
}

Layout make_maze(const LatticeConfig& config) {
  if (config.columns * config.rows < 2) throw std::invalid_argument("expected a maze of at least two cells");
  slam::RandomStream draws(config.seed, slam::Stream::kWorld, kShape);
  const std::vector<Passage> passages = random_tree(config.columns, config.rows, draws);
  Layout layout;
  append_closed({{0.0, 0.0},
                 {config.columns * config.pitch_m, 0.0},
                 {config.columns * config.pitch_m, config.rows * config.pitch_m},
                 {0.0, config.rows * config.pitch_m}},
                config.height_m, Material::kBricks, layout.walls);
  const auto is_open = [&](const Vector2i& a, const Vector2i& b) {
    return std::ranges::any_of(passages, [&](const Passage& p) {
      return (p.first == a && p.second == b) || (p.first == b && p.second == a);
    });
  };
  const auto separate = [&](const Vector2i& cell, const Vector2i& other, const Vector2i& from) {
    if (other.x() >= config.columns || other.y() >= config.rows || is_open(cell, other)) return;
    layout.walls.push_back({config.pitch_m * from.cast<double>(),
                            config.pitch_m * (cell + Vector2i(1, 1)).cast<double>(), config.height_m,
                            Material::kPlaster});
  };
  for (int row = 0; row < config.rows; ++row) {
    for (int column = 0; column < config.columns; ++column) {
      const Vector2i cell(column, row);
      separate(cell, {column + 1, row}, {column + 1, row});
      separate(cell, {column, row + 1}, {column, row + 1});
    }
  }
  const std::vector<Vector2i> way = longest_way(config.columns, config.rows, passages);
  for (const Vector2i& cell : corners_of(way, false))
    layout.tour_m.push_back(config.pitch_m * (cell.cast<double>() + Vector2d(0.5, 0.5)));
  layout.corner_radius_m = 0.35 * config.pitch_m;
  return layout;
}

}  // namespace stereobench::worlds
