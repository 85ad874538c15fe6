/// Stages that are timed on a scene, beside copying the same pair of images.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include <benchmark/benchmark.h>

#include "renderer/renderer.h"
#include "tests/bench/scenes.h"

namespace stereobench {

/// A rendered pair and what copying it costs.
struct Bench {
  explicit Bench(Scene shown, renderer::Backend backend = renderer::Backend::kSoftware,
                 renderer::LightDepth depth = renderer::LightDepth::kEightBits)
      : scene(std::move(shown)),
        renderer(scene.world, scene.rig, backend, depth),
        frame(renderer.render(scene.pose)) {}

  /// Times `stage`, and the copy right after it, so that both see the same machine. The fastest of the times
  /// is that of a core of one's own, where others' work comes and goes; the mean is not.
  template <typename Stage>
  void run(benchmark::State& state, Stage stage) {
    double stage_s = 0.0;
    double copy_s = 0.0;
    double fastest_s = std::numeric_limits<double>::infinity();
    for (auto _ : state) {
      using Clock = std::chrono::steady_clock;
      const auto begin = Clock::now();
      stage();
      const auto middle = Clock::now();
      frame.left.colour.copyTo(left);
      frame.right.colour.copyTo(right);
      benchmark::ClobberMemory();
      const double this_s = std::chrono::duration<double>(middle - begin).count();
      copy_s += std::chrono::duration<double>(Clock::now() - middle).count();
      stage_s += this_s;
      fastest_s = std::min(fastest_s, this_s);
      state.SetIterationTime(this_s);
    }
    state.counters["copies"] = stage_s / copy_s;
    state.counters["fastest_ms"] = 1e3 * fastest_s;
  }

  Scene scene;
  renderer::Renderer renderer;
  renderer::StereoFrame frame;
  cv::Mat left, right;
};

}  // namespace stereobench
