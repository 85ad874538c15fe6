// Every filter, with 1 to 1,000 particles, through drives that have everything that goes wrong.
//
// The usual run takes as many seeds as seconds allow; STEREOBENCH_STRESS_SEEDS=1000 takes so many for each.
#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>
#include <tuple>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/slam/checks.h"
#include "tests/slam/nasty_drive.h"

namespace stereobench::slam {
namespace {

int seeds_for(int particles) {
  const char* wanted = std::getenv("STEREOBENCH_STRESS_SEEDS");
  return wanted != nullptr ? std::atoi(wanted) : std::clamp(1200 / particles, 2, 60);
}

// Symmetric to the last digits, and no direction has less than no variance. Each coordinate is measured in
// its own deviations, for a metre and a radian, or a kilometre and a millimetre, are not to be compared.
bool is_semidefinite(const Eigen::MatrixXd& covariance) {
  if ((covariance.diagonal().array() < 0.0).any()) return false;
  Eigen::VectorXd by_sd = covariance.diagonal().cwiseSqrt();
  constexpr double kNothing = 1e-140;  // its square is near the smallest number there is
  for (double& value : by_sd) value = value > kNothing ? 1.0 / value : 0.0;
  const Eigen::MatrixXd correlation = by_sd.asDiagonal() * covariance * by_sd.asDiagonal();
  return (correlation - correlation.transpose()).cwiseAbs().maxCoeff() <= 1e-12 &&
         Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(correlation).eigenvalues()(0) >= -1e-6;
}

bool no_counter_fell(const FilterCounters& before, const FilterCounters& now) {
  return before.resamplings <= now.resamplings && before.covariance_repairs <= now.covariance_repairs &&
         before.weight_collapses <= now.weight_collapses &&
         before.gated_measurements <= now.gated_measurements && before.rejected_inputs <= now.rejected_inputs;
}

std::string text_of(const char* what, const Eigen::MatrixXd& covariance) {
  std::ostringstream text;
  text << std::setprecision(17) << what << "\n" << covariance;
  return text.str();
}

// What must be so at any time; a word for what is not.
std::string fault_of(const Estimate& estimate, const Estimate& before, int particles) {
  if (!all_finite(estimate)) return "not finite";
  const double heading_rad = estimate.pose.heading_rad;
  if (!(heading_rad > -std::numbers::pi && heading_rad <= std::numbers::pi)) return "heading not wrapped";
  if (!is_semidefinite(estimate.covariance)) return text_of("pose", estimate.covariance);
  for (const LandmarkEstimate& landmark : estimate.landmarks)
    if (!is_semidefinite(landmark.covariance)) return text_of("landmark", landmark.covariance);
  const double effective = estimate.effective_particles;
  if (!(effective >= 1.0 && effective <= particles)) return "effective particles";
  return no_counter_fell(before.counters, estimate.counters) ? "" : "a counter fell";
}

class Stress : public ::testing::TestWithParam<std::tuple<std::string, int>> {};

// Mutations: blocks of the joint covariance that are not repaired; a sighting that cannot be and is not
// counted; with 1,000 seeds, a landmark refined by a sighting when neither is uncertain.
TEST_P(Stress, NeitherThrowsNorLosesANumber) {
  const auto [name, particles] = GetParam();
  for (int seed = 0; seed < seeds_for(particles); ++seed) {
    NastyDrive drive(static_cast<std::uint64_t>(seed));
    drive.config.particles = particles;
    Filter filter = make_filter(name, drive.config, {}, static_cast<std::uint64_t>(seed));
    const int count = particle_count(filter);
    Estimate before = estimate(filter);
    long impossible = 0;
    for (std::size_t k = 0; k < drive.steps.size(); ++k) {
      for (const Control& control : drive.steps[k].controls) predict(filter, control);
      for (const std::vector<RangeBearing>& frame : drive.steps[k].frames) update(filter, frame);
      impossible += drive.steps[k].impossible;
      const Estimate now = estimate(filter);
      const std::string fault = fault_of(now, before, count);
      ASSERT_TRUE(fault.empty()) << fault << "\nseed " << seed << ", step " << k;
      ASSERT_EQ(now.counters.rejected_inputs, impossible) << "seed " << seed << ", step " << k;
      before = now;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Filters, Stress,
                         ::testing::Combine(::testing::ValuesIn(filter_names()),
                                            ::testing::Values(1, 2, 3, 10, 30, 100, 1000)),
                         [](const auto& drive) {
                           return std::get<0>(drive.param) + "_" + std::to_string(std::get<1>(drive.param));
                         });

// The drives are as nasty as they claim to be: each counter has something to count. Mutation: drives without
// noise, or without sightings that cannot be.
TEST(NastyDrives, GiveEachCounterSomethingToCount) {
  FilterCounters sum;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    NastyDrive drive(seed);
    drive.config.particles = 3;
    Filter filter = make_filter("ufastslam", drive.config, {}, seed);
    for (const NastyStep& step : drive.steps) {
      for (const Control& control : step.controls) predict(filter, control);
      for (const std::vector<RangeBearing>& frame : step.frames) update(filter, frame);
    }
    const FilterCounters counters = estimate(filter).counters;
    sum.resamplings += counters.resamplings;
    sum.covariance_repairs += counters.covariance_repairs;
    sum.gated_measurements += counters.gated_measurements;
    sum.rejected_inputs += counters.rejected_inputs;
  }
  EXPECT_GT(sum.resamplings, 10);
  EXPECT_GT(sum.covariance_repairs, 10);
  EXPECT_GT(sum.gated_measurements, 10);
  EXPECT_GT(sum.rejected_inputs, 100);
}

}  // namespace
}  // namespace stereobench::slam
