/// The stages that touch pixels, on one core, as times and as multiples of copying the same pair of images.
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "renderer/backend.h"
#include "renderer/camera/expose.h"
#include "renderer/pictures/png_picture.h"
#include "tests/bench/bench_scene.h"
#include "tests/bench/textured_scene.h"
#include "vision/observe.h"

namespace stereobench {
namespace {

constexpr int kLastBackend = static_cast<int>(renderer::kBackends.size()) - 1;

/// The argument is an index into kBackends; one that this machine does not have is skipped.
void render_pair(benchmark::State& state, const Scene& scene) {
  const renderer::Backend backend = renderer::kBackends.at(static_cast<std::size_t>(state.range(0)));
  state.SetLabel(renderer::name_of(backend));
  try {
    Bench bench(scene, backend);
    bench.run(state, [&] { benchmark::DoNotOptimize(bench.renderer.render(scene.pose)); });
  } catch (const std::runtime_error& error) {
    state.SkipWithError(error.what());
  }
}

/// With light of 16 bits, for cameras that do not store it as it is.
void render_pair_fine(benchmark::State& state, const Scene& scene) {
  Bench bench(scene, renderer::Backend::kSoftware, renderer::LightDepth::kSixteenBits);
  bench.run(state, [&] { benchmark::DoNotOptimize(bench.renderer.render(scene.pose)); });
}

/// Behind a lens that bends straight lines by tens of pixels.
Scene behind_a_lens() {
  Scene scene = scenario_scene("ball_circle");
  scene.rig.distortion = {.k1 = -0.25, .k2 = 0.08, .p1 = 0.001};
  return scene;
}

void expose_pair(benchmark::State& state, const Scene& scene, const worlds::CameraSensor& sensor) {
  Bench bench(scene);
  std::uint64_t index = 0;
  bench.run(state, [&] { benchmark::DoNotOptimize(renderer::expose(bench.frame, sensor, 0, index++)); });
}

worlds::CameraSensor plain_noise() {
  return {.noise_sd_levels = 2.0};
}

/// The same noise for a camera that also darkens its corners: it is developed pixel by pixel.
worlds::CameraSensor noise_and_vignette() {
  return {.noise_sd_levels = 2.0, .vignette = 0.2};
}

/// A camera that does everything.
worlds::CameraSensor whole_camera() {
  return {.defocus_sd_px = 0.7,
          .vignette = 0.2,
          .full_well_electrons = 10000.0,
          .read_noise_electrons = 10.0,
          .encoding = worlds::Encoding::kSrgb};
}

void observe_pair(benchmark::State& state, const Scene& scene, double noise_sd_levels) {
  Bench bench(scene);
  const auto pair = renderer::expose(bench.frame, {.noise_sd_levels = noise_sd_levels}, 0, 0);
  const vision::ObserverSettings settings{.ball_radius_m = scene.world.ball_radius_m(),
                                          .noise_sd_levels = noise_sd_levels};
  std::size_t balls = 0;
  bench.run(state, [&] { balls = vision::observe(pair, scene.rig, settings).size(); });
  state.counters["balls"] = static_cast<double>(balls);
}

/// As PNG files, in memory.
void pack_pair(benchmark::State& state, double noise_sd_levels, renderer::PngPacking packing) {
  Bench bench(scenario_scene("ball_circle"));
  const auto pair = renderer::expose(bench.frame, {.noise_sd_levels = noise_sd_levels}, 0, 0);
  std::size_t bytes = 0;
  bench.run(state, [&] {
    bytes =
        renderer::encode_png(pair.left, packing).size() + renderer::encode_png(pair.right, packing).size();
  });
  state.counters["bytes"] = static_cast<double>(bytes);
}

#define STEREOBENCH_STAGE(function, ...) \
  BENCHMARK_CAPTURE(function, __VA_ARGS__)->Unit(benchmark::kMillisecond)->UseManualTime()

STEREOBENCH_STAGE(render_pair, eighteen_balls, eighteen_balls())->DenseRange(0, kLastBackend);
STEREOBENCH_STAGE(render_pair, hundred_balls, hundred_balls())->DenseRange(0, 0);
STEREOBENCH_STAGE(render_pair, ball_circle, scenario_scene("ball_circle"))->DenseRange(0, kLastBackend);
STEREOBENCH_STAGE(render_pair, behind_a_lens, behind_a_lens())->DenseRange(0, 0);
STEREOBENCH_STAGE(render_pair, textured, textured_scene())->DenseRange(0, kLastBackend);
STEREOBENCH_STAGE(render_pair, image_textured, image_textured_scene())->DenseRange(0, kLastBackend);
STEREOBENCH_STAGE(render_pair, corridor, scenario_scene("corridor"))->DenseRange(0, kLastBackend);
STEREOBENCH_STAGE(render_pair_fine, ball_circle, scenario_scene("ball_circle"));
STEREOBENCH_STAGE(render_pair_fine, behind_a_lens, behind_a_lens());
STEREOBENCH_STAGE(render_pair_fine, image_textured, image_textured_scene());
STEREOBENCH_STAGE(render_pair_fine, corridor, scenario_scene("corridor"));
STEREOBENCH_STAGE(expose_pair, noise_2, scenario_scene("ball_circle"), plain_noise());
STEREOBENCH_STAGE(expose_pair, noise_2_and_vignette, scenario_scene("ball_circle"), noise_and_vignette());
STEREOBENCH_STAGE(expose_pair, whole_camera, scenario_scene("ball_circle"), whole_camera());
STEREOBENCH_STAGE(pack_pair, noise_0, 0.0, renderer::PngPacking::kRuns);
STEREOBENCH_STAGE(pack_pair, noise_2, 2.0, renderer::PngPacking::kRuns);
STEREOBENCH_STAGE(pack_pair, noise_2_stored, 2.0, renderer::PngPacking::kStored);
STEREOBENCH_STAGE(observe_pair, eighteen_balls_noise_2, eighteen_balls(), 2.0);
STEREOBENCH_STAGE(observe_pair, eighteen_balls_noise_8, eighteen_balls(), 8.0);
STEREOBENCH_STAGE(observe_pair, hundred_balls_noise_2, hundred_balls(), 2.0);
STEREOBENCH_STAGE(observe_pair, no_balls_noise_2, no_balls(), 2.0);
STEREOBENCH_STAGE(observe_pair, corridor_noise_2, scenario_scene("corridor"), 2.0);

}  // namespace
}  // namespace stereobench
