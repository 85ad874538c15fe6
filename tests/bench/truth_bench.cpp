/// What truth costs beyond a frame's own, and what smoothing edges does, for both cameras.
#include "renderer/surfaces/edge_smoother.h"
#include "renderer/truth/ball_truth.h"
#include "renderer/truth/correspondence.h"
#include "renderer/truth/pixel_truth.h"
#include "tests/bench/bench_scene.h"

namespace stereobench {
namespace {

/// A bench that knows what its cameras see.
struct TruthBench : Bench {
  explicit TruthBench(const std::string& scenario)
      : Bench(scenario_scene(scenario)),
        geometry(scene.world),
        ids(renderer.id_buffers(scene.pose, scene.pose)) {}

  renderer::SceneGeometry geometry;
  renderer::StereoIdBuffers ids;
};

void truth_pair_sight(benchmark::State& state, const std::string& scenario) {
  TruthBench bench(scenario);
  bench.run(state,
            [&] { benchmark::DoNotOptimize(bench.renderer.id_buffers(bench.scene.pose, bench.scene.pose)); });
}

void truth_pair_range_normal_surface(benchmark::State& state, const std::string& scenario) {
  TruthBench bench(scenario);
  bench.run(state, [&] {
    benchmark::DoNotOptimize(renderer::pixel_truth(bench.geometry, bench.ids.left));
    benchmark::DoNotOptimize(renderer::pixel_truth(bench.geometry, bench.ids.right));
  });
}

void truth_pair_disparity(benchmark::State& state, const std::string& scenario) {
  TruthBench bench(scenario);
  bench.run(state, [&] {
    benchmark::DoNotOptimize(renderer::correspond(bench.geometry, bench.ids.left, bench.ids.right));
    benchmark::DoNotOptimize(renderer::correspond(bench.geometry, bench.ids.right, bench.ids.left));
  });
}

void truth_pair_balls(benchmark::State& state, const std::string& scenario) {
  TruthBench bench(scenario);
  bench.run(state, [&] {
    const worlds::World& world = bench.scene.world;
    const auto& [left, right] = bench.ids;
    benchmark::DoNotOptimize(renderer::ball_truths(world, left.view, bench.frame.left.ball_id));
    benchmark::DoNotOptimize(renderer::ball_truths(world, right.view, bench.frame.right.ball_id));
  });
}

/// Part of render_pair; here the edges of pictures that are smooth already, which costs the same.
void smooth_pair(benchmark::State& state, const std::string& scenario) {
  TruthBench bench(scenario);
  const renderer::EdgeSmoother smoother(bench.scene.world, renderer::place_meshes(bench.scene.world));
  bench.run(state, [&] {
    const auto smooth = [&](const renderer::CameraView& view, renderer::RenderedImage& frame) {
      renderer::mix_edges(smoother.mixes(view, frame), {}, frame);
    };
    smooth(bench.ids.left.view, bench.frame.left);
    smooth(bench.ids.right.view, bench.frame.right);
  });
}

#define STEREOBENCH_TRUTH(function)                                                                        \
  BENCHMARK_CAPTURE(function, ball_circle, "ball_circle")->Unit(benchmark::kMillisecond)->UseManualTime(); \
  BENCHMARK_CAPTURE(function, corridor, "corridor")->Unit(benchmark::kMillisecond)->UseManualTime()

STEREOBENCH_TRUTH(truth_pair_sight);
STEREOBENCH_TRUTH(truth_pair_range_normal_surface);
STEREOBENCH_TRUTH(truth_pair_disparity);
STEREOBENCH_TRUTH(truth_pair_balls);
STEREOBENCH_TRUTH(smooth_pair);

}  // namespace
}  // namespace stereobench
