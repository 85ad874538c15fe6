/// The filters' cycle: eight predictions and one observed landmark, with the noise of Bailey's web map
/// (0.3 m/s, 3 deg of steering about 0.25 rad/s of turn rate here, 0.1 m, 1 deg).
#include <array>
#include <cmath>
#include <string>

#include <benchmark/benchmark.h>

#include "slam/filter.h"

namespace stereobench {
namespace {

constexpr int kPredictions = 8;

void cycle(benchmark::State& state, const std::string& name) {
  slam::FilterConfig config;
  config.particles = static_cast<int>(state.range(0));
  config.odometry_noise = {.v_constant_mps = 0.3, .w_constant_radps = 0.05};
  slam::Filter filter = slam::make_filter(name, config, {}, 0);
  slam::RangeBearing sighting{.range_m = 10.0, .bearing_rad = 0.3, .landmark_id = 0};
  sighting.covariance.diagonal() << 0.1 * 0.1, std::pow(3.14159 / 180.0, 2);
  const std::array<slam::RangeBearing, 1> frame = {sighting};
  slam::update(filter, frame);
  double turn = 1.0;
  for (auto _ : state) {
    turn = -turn;  // back and forth, so that the landmark stays where it is seen
    for (int i = 0; i < kPredictions; ++i) slam::predict(filter, {.v_mps = 3.0 * turn, .duration_s = 0.025});
    slam::update(filter, frame);
    benchmark::DoNotOptimize(filter);
  }
}

BENCHMARK_CAPTURE(cycle, ufastslam, "ufastslam")->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cycle, fastslam2, "fastslam2")->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stereobench
