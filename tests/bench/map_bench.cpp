/// What a step costs in maps of different sizes, where the same few landmarks are seen: it should not depend
/// on the size. Landmarks stand along a way; the benchmark drives it once and then goes back and forth at its
/// end.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "slam/filter_registry.h"
#include "slam/models/measurement.h"

namespace stereobench {
namespace {

constexpr int kSeen = 8;  // landmarks in view

double resident_megabytes() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0.0;
  statm >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// What is seen from the n-th metre of the way: four landmarks on either side, with or without identity.
std::vector<slam::RangeBearing> frame_at(int metre, bool known) {
  std::vector<slam::RangeBearing> frame;
  for (int i = 0; i < kSeen; ++i) {
    const Eigen::Vector2d place(metre + 1.0 + 0.25 * (i / 2), i % 2 == 0 ? 2.0 : -2.0);
    const Eigen::Vector2d seen = slam::predict_sighting({static_cast<double>(metre), 0.0, 0.0}, place);
    slam::RangeBearing sighting{.range_m = seen.x(), .bearing_rad = seen.y()};
    sighting.covariance.diagonal() << 1e-4, 1e-4;
    (known ? sighting.landmark_id : sighting.colour_class) = kSeen * metre + i;
    if (!known) sighting.colour_class %= 18;
    frame.push_back(sighting);
  }
  return frame;
}

void step_in_a_map(benchmark::State& state, const std::string& name, bool known) {
  slam::FilterConfig config;
  config.particles = static_cast<int>(state.range(0));
  config.odometry_noise = {.v_constant_mps = 0.01, .w_constant_radps = 0.001};
  config.draw_every = 40;
  slam::Filter filter = slam::make_filter(name, config, {}, 0);
  const int end = static_cast<int>(state.range(1)) / kSeen - 1;
  for (int metre = 0; metre <= end; ++metre) {
    slam::update(filter, frame_at(metre, known));
    if (metre < end) slam::predict(filter, {.v_mps = 1.0, .duration_s = 1.0});
  }
  state.counters["resident_MB"] = resident_megabytes();
  const std::vector<slam::RangeBearing> last = frame_at(end, known);
  for (int i = 0; i < config.draw_every; ++i) slam::update(filter, last);  // a block of the way's is over
  for (auto _ : state) {
    for (const double turn : {-1.0, 1.0}) slam::predict(filter, {.v_mps = turn, .duration_s = 0.1});
    slam::update(filter, last);
    benchmark::DoNotOptimize(filter);
  }
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({100, 96})
      ->Args({100, 10'000})
      ->ArgNames({"M", "landmarks"})
      ->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(step_in_a_map, fastslam2_known, "fastslam2", true)->Apply(sizes)->Args({1000, 10'000});
BENCHMARK_CAPTURE(step_in_a_map, ufastslam_known, "ufastslam", true)->Apply(sizes)->Args({1000, 10'000});
BENCHMARK_CAPTURE(step_in_a_map, fastslam2_block_known, "fastslam2_block", true)->Apply(sizes);
BENCHMARK_CAPTURE(step_in_a_map, ufastslam_block_known, "ufastslam_block", true)->Apply(sizes);
BENCHMARK_CAPTURE(step_in_a_map, fastslam2_by_colour, "fastslam2", false)->Apply(sizes);
BENCHMARK_CAPTURE(step_in_a_map, ufastslam_by_colour, "ufastslam", false)->Apply(sizes);

}  // namespace
}  // namespace stereobench
