/// What a whole process of its own needs to render: threads, memory, the first picture.
#include <chrono>
#include <filesystem>
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "tests/bench/render_process.h"
#include "tests/renderer/folder.h"

namespace stereobench {
namespace {

constexpr double kSeconds = 1.0;

/// The usual pair, with this many threads of the rasteriser's.
void render_pair_threads(benchmark::State& state) {
  RenderReport report;
  for (auto _ : state) {
    report = RenderProcess("LP_NUM_THREADS=" + std::to_string(state.range(0)), kSeconds).report();
    state.SetIterationTime(1e-3 * report.pair_ms);
  }
  state.counters["resident_MB"] = report.resident_mb;
  state.counters["own_MB"] = report.own_mb;
}

/// The time of a pair where two processes render, which is half of what each takes.
void render_pair_processes(benchmark::State& state) {
  double pairs = 0.0;
  for (auto _ : state) {
    RenderProcess one("LP_NUM_THREADS=0", kSeconds), other("LP_NUM_THREADS=0", kSeconds);
    const double pairs_per_s = one.report().pairs_per_s + other.report().pairs_per_s;
    state.SetIterationTime(1.0 / pairs_per_s);
    pairs += pairs_per_s;
  }
  state.counters["pairs_per_s"] = benchmark::Counter(pairs, benchmark::Counter::kAvgIterations);
}

/// From the start of a process to its first pair, and its end; the cache of shaders empty, or not.
void render_pair_first(benchmark::State& state, bool warm) {
  for (auto _ : state) {
    const renderer::test::Folder cache;
    const std::string environment = "LP_NUM_THREADS=0 MESA_SHADER_CACHE_DIR=" + cache.path().string();
    if (warm) RenderProcess(environment, 0.0).report();
    const auto begin = std::chrono::steady_clock::now();
    RenderProcess(environment, 0.0).report();
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
}

BENCHMARK(render_pair_threads)
    ->Name("render_pair/eighteen_balls_alone")
    ->ArgName("threads")
    ->Arg(0)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(3);
BENCHMARK(render_pair_processes)
    ->Name("render_pair/eighteen_balls_by_two_processes")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(3);
BENCHMARK_CAPTURE(render_pair_first, warm, true)
    ->Name("render_pair/first_image_warm")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(5);
BENCHMARK_CAPTURE(render_pair_first, cold, false)
    ->Name("render_pair/first_image_cold")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime()
    ->Iterations(5);

}  // namespace
}  // namespace stereobench
