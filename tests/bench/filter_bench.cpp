/// The filters' cycle: eight predictions and one observed landmark, with the noise of Bailey's web map
/// (0.3 m/s, 3 deg of steering about 0.25 rad/s of turn rate here, 0.1 m, 1 deg).
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "slam/filter_registry.h"
#include "slam/models/motion.h"

namespace stereobench {
namespace {

constexpr int kPredictions = 8;

/// Landmarks in a circle of 10 m radius, numbered from the one ahead on.
std::vector<slam::RangeBearing> circle_of(int landmarks) {
  std::vector<slam::RangeBearing> seen;
  for (int i = 0; i < landmarks; ++i) {
    const double bearing_rad = slam::wrap_angle(2.0 * std::numbers::pi * i / landmarks + 0.3);
    slam::RangeBearing sighting{.range_m = 10.0, .bearing_rad = bearing_rad, .landmark_id = i};
    sighting.covariance.diagonal() << 0.1 * 0.1, std::pow(std::numbers::pi / 180.0, 2);
    seen.push_back(sighting);
  }
  return seen;
}

/// @param landmarks in the map; one of them is seen in each cycle, all of them in turn
/// @param reports whether each update reports its innovations
void cycle(benchmark::State& state, const std::string& name, int landmarks, bool reports) {
  slam::FilterConfig config;
  config.report_updates = reports;
  config.particles = static_cast<int>(state.range(0));
  config.odometry_noise = {.v_constant_mps = 0.3, .w_constant_radps = 0.05};
  config.draw_every = 40;
  slam::Filter filter = slam::make_filter(name, config, {}, 0);
  const std::vector<slam::RangeBearing> circle = circle_of(landmarks);
  for (int i = 0; i <= config.draw_every; ++i) slam::update(filter, circle);  // particles are no longer alike
  std::size_t next = 0;
  for (auto _ : state) {
    for (int i = 0; i < kPredictions;
         ++i) {  // back and forth, so that the landmarks stay where they are seen
      slam::predict(filter, {.v_mps = i % 2 == 0 ? 3.0 : -3.0, .duration_s = 0.025});
    }
    slam::update(filter, std::span(circle).subspan(next, 1));
    next = (next + 1) % circle.size();
    benchmark::DoNotOptimize(filter);
  }
  state.counters["gated"] = static_cast<double>(slam::estimate(filter).counters.gated_measurements);
}

#define STEREOBENCH_CYCLE(name, landmarks) \
  BENCHMARK_CAPTURE(cycle, name##_##landmarks, #name, landmarks, false)->Unit(benchmark::kMillisecond)
#define STEREOBENCH_REPORTED_CYCLE(name, landmarks)                               \
  BENCHMARK_CAPTURE(cycle, name##_##landmarks##_reported, #name, landmarks, true) \
      ->Unit(benchmark::kMillisecond)

STEREOBENCH_CYCLE(ufastslam, 1)->Arg(100)->Arg(1000);
STEREOBENCH_CYCLE(fastslam2, 1)->Arg(100)->Arg(1000);
STEREOBENCH_CYCLE(fastslam1, 1)->Arg(100)->Arg(1000);
STEREOBENCH_CYCLE(ufastslam_block, 1)->Arg(100)->Arg(1000);
STEREOBENCH_CYCLE(fastslam2_block, 1)->Arg(100)->Arg(1000);
STEREOBENCH_CYCLE(ekf, 30)->Arg(1);
STEREOBENCH_CYCLE(iekf, 30)->Arg(1);
STEREOBENCH_CYCLE(smoother, 30)->Arg(1);
STEREOBENCH_REPORTED_CYCLE(ufastslam, 1)->Arg(100);
STEREOBENCH_REPORTED_CYCLE(fastslam2, 1)->Arg(100);
STEREOBENCH_REPORTED_CYCLE(fastslam1, 1)->Arg(100);
STEREOBENCH_REPORTED_CYCLE(ekf, 30)->Arg(1);

}  // namespace
}  // namespace stereobench
