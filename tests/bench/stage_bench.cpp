/// The stages that touch pixels, beside a plain copy of the same images.
#include <cstring>
#include <string>

#include <benchmark/benchmark.h>

#include "renderer/expose.h"
#include "renderer/renderer.h"
#include "vision/observe.h"
#include "worlds/scenario.h"

namespace stereobench {
namespace {

const std::string kScenarios = std::string(STEREOBENCH_SOURCE_DIR) + "/assets/scenarios/";

/// A scenario, its world, and a pair rendered from a place on its path.
struct Scene {
  explicit Scene(const std::string& name)
      : scenario(worlds::read_scenario(kScenarios + name + ".yaml")),
        renderer(scenario.world, scenario.rig),
        pose(scenario.path[scenario.path.size() / 4].pose),
        frame(renderer.render(pose)) {}
  worlds::Scenario scenario;
  renderer::Renderer renderer;
  slam::Pose pose;
  renderer::StereoFrame frame;
};

void copy_pair(benchmark::State& state, const std::string& name) {
  const Scene scene(name);
  cv::Mat left, right;
  for (auto _ : state) {
    scene.frame.left.colour.copyTo(left);
    scene.frame.right.colour.copyTo(right);
    benchmark::ClobberMemory();
  }
}

void render_pair(benchmark::State& state, const std::string& name) {
  Scene scene(name);
  for (auto _ : state) benchmark::DoNotOptimize(scene.renderer.render(scene.pose));
}

void expose_pair(benchmark::State& state, const std::string& name, double noise_sd_levels) {
  const Scene scene(name);
  const worlds::CameraSensor sensor{.noise_sd_levels = noise_sd_levels};
  std::uint64_t index = 0;
  for (auto _ : state) benchmark::DoNotOptimize(renderer::expose(scene.frame, sensor, 0, index++));
}

void observe_pair(benchmark::State& state, const std::string& name, double noise_sd_levels) {
  const Scene scene(name);
  const auto pair = renderer::expose(scene.frame, {.noise_sd_levels = noise_sd_levels}, 0, 0);
  const vision::ObserverSettings settings{.ball_radius_m = scene.scenario.world.balls.front().radius_m,
                                          .noise_sd_levels = noise_sd_levels};
  std::size_t balls = 0;
  for (auto _ : state) balls = vision::observe(pair, scene.scenario.rig, settings).size();
  state.counters["balls"] = static_cast<double>(balls);
}

#define STEREOBENCH_STAGE(function, ...) \
  BENCHMARK_CAPTURE(function, __VA_ARGS__)->Unit(benchmark::kMillisecond)

STEREOBENCH_STAGE(copy_pair, ball_circle, "ball_circle");
STEREOBENCH_STAGE(render_pair, ball_circle, "ball_circle");
STEREOBENCH_STAGE(render_pair, corridor, "corridor");
STEREOBENCH_STAGE(expose_pair, noise_0, "ball_circle", 0.0);
STEREOBENCH_STAGE(expose_pair, noise_2, "ball_circle", 2.0);
STEREOBENCH_STAGE(observe_pair, ball_circle_noise_2, "ball_circle", 2.0);
STEREOBENCH_STAGE(observe_pair, ball_circle_noise_8, "ball_circle", 8.0);
STEREOBENCH_STAGE(observe_pair, corridor_noise_2, "corridor", 2.0);

}  // namespace
}  // namespace stereobench
