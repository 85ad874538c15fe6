/// What it costs to ask which balls are in view along a drive through a building: one of walls, one whose
/// walls are a mesh of as many triangles as the argument says, and reading that mesh's triangles into a tree.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "worlds/drive/path.h"
#include "worlds/generate/layout.h"
#include "worlds/visibility/occluders.h"
#include "worlds/visibility/visibility.h"

namespace stereobench {
namespace {

constexpr int kBalls = 30;
constexpr std::size_t kPoses = 200;

/// A drive through an office with balls along it.
worlds::Scenario office() {
  const worlds::Layout layout =
      worlds::make_office_grid({.seed = 1, .columns = 6, .rows = 5, .pitch_m = 6.0, .turns = 8});
  worlds::Scenario scenario;
  scenario.rig = {.intrinsics = {1024, 768, 887.0, 511.5, 383.5}, .baseline_m = 0.12, .height_m = 0.4};
  scenario.world.walls = layout.walls;
  scenario.path = worlds::drive_polyline({.points_m = layout.tour_m,
                                          .closed = layout.closed,
                                          .corner_radius_m = layout.corner_radius_m,
                                          .speed_mps = 1.0,
                                          .step_s = 0.25});
  for (int i = 0; i < kBalls; ++i) {
    const slam::Pose& pose = scenario.path[static_cast<std::size_t>(i) * scenario.path.size() / kBalls].pose;
    scenario.world.balls.push_back({{pose.x_m + 0.5, pose.y_m + 0.6, 0.1}, 0.1, i % 18});
  }
  scenario.path.resize(std::min(kPoses, scenario.path.size()));
  return scenario;
}

/// Walls as upright strips of two triangles, about so many in all.
std::vector<worlds::TriangleCorners> strips_of(const std::vector<worlds::Wall>& walls, int triangles) {
  const int strips = triangles / 2 / static_cast<int>(walls.size());
  std::vector<worlds::TriangleCorners> corners;
  for (const worlds::Wall& wall : walls) {
    const auto at = [&](int strip, double z_m) {
      const Eigen::Vector2d foot = wall.from_m + (wall.to_m - wall.from_m) * strip / strips;
      return Eigen::Vector3d(foot.x(), foot.y(), z_m);
    };
    for (int i = 0; i < strips; ++i) {
      corners.push_back({at(i, 0.0), at(i + 1, 0.0), at(i + 1, wall.height_m)});
      corners.push_back({at(i, 0.0), at(i + 1, wall.height_m), at(i, wall.height_m)});
    }
  }
  return corners;
}

void look_along(benchmark::State& state, const worlds::Scenario& scenario) {
  std::size_t in_view = 0;
  for (auto _ : state) {
    in_view = 0;
    for (const worlds::PathStep& step : scenario.path)
      in_view += worlds::balls_in_view(scenario, scenario.world, step.pose).size();
    benchmark::DoNotOptimize(in_view);
  }
  state.counters["poses"] = static_cast<double>(scenario.path.size());
  state.counters["in_view"] = static_cast<double>(in_view);
}

void look_along_walls(benchmark::State& state) {
  look_along(state, office());
}

void look_along_a_mesh(benchmark::State& state) {
  worlds::Scenario scenario = office();
  worlds::MeshInstance mesh;
  mesh.occluder = std::make_shared<const worlds::TriangleBvh>(
      strips_of(scenario.world.walls, static_cast<int>(state.range(0))));
  scenario.world.meshes = {mesh};
  scenario.world.walls.clear();
  look_along(state, scenario);
}

void grow_a_tree(benchmark::State& state) {
  const auto corners = strips_of(office().world.walls, static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(worlds::TriangleBvh(corners));
}

BENCHMARK(look_along_walls)->Name("sight/30_balls/walls")->Unit(benchmark::kMillisecond);
BENCHMARK(look_along_a_mesh)
    ->Name("sight/30_balls/mesh")
    ->Arg(1000)
    ->Arg(30000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(grow_a_tree)->Name("sight/tree")->Arg(30000)->Arg(1000000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stereobench
