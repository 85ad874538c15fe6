// An estimate depends on the log up to its step, and on nothing that only a simulator knows.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "harness/drive/recording.h"
#include "harness/experiment/experiment.h"
#include "harness/scoring/replay.h"

namespace stereobench::harness {
namespace {

struct Case {
  std::string filter;
  std::string identity;
};

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const std::string& filter : slam::filter_names())
    for (const char* identity : {"known", "colour_class", "none"}) cases.push_back({filter, identity});
  return cases;
}

/// A part of a drive through open_field, and what filters make of it.
class Causality : public testing::TestWithParam<Case> {
 protected:
  MeasurementLog log_ = record(read_experiment(STEREOBENCH_SOURCE_DIR "/assets/scenarios/open_field.yaml",
                                               {"identity=" + GetParam().identity, "path.speed_mps=2",
                                                "oracle.miss_probability=0.1", "oracle.false_per_look=0.3"}),
                               3, {})
                            .log;

  Causality() { log_.steps.resize(80); }

  static FilterRun run_on(const MeasurementLog& log) {
    slam::FilterConfig config;
    config.particles = 5;
    config.odometry_noise = {0.02, 0.0, 0.0, 0.0035, 0.0, 0.0};
    return replay(log, GetParam().filter, config, 7);
  }
};

/// The same to the bit.
void expect_same(const FilterRun& run, const FilterRun& other, std::size_t step) {
  const slam::Pose& pose = run.poses.at(step);
  const slam::Pose& other_pose = other.poses.at(step);
  EXPECT_EQ(pose.x_m, other_pose.x_m) << "step " << step;
  EXPECT_EQ(pose.y_m, other_pose.y_m) << "step " << step;
  EXPECT_EQ(pose.heading_rad, other_pose.heading_rad) << "step " << step;
  EXPECT_EQ(run.covariances.at(step), other.covariances.at(step)) << "step " << step;
}

// Mutations: each step's sightings replaced by those of the next step, if there is one; a filter that is told
// how many steps there are as its number of particles.
TEST_P(Causality, EstimatesAreTheSameWhereTheLogEndsThere) {
  const FilterRun whole = run_on(log_);
  ASSERT_FALSE(whole.failed) << whole.failure;
  for (const std::size_t steps : {1U, 2U, 30U, 79U}) {
    MeasurementLog prefix = log_;
    prefix.steps.resize(steps);
    expect_same(run_on(prefix), whole, steps - 1);
  }
}

// Mutations: a filter that starts from the first step's true pose; poses of which a thousandth is the truth;
// sightings that are told whose they are.
TEST_P(Causality, FalseTruthChangesNoEstimate) {
  MeasurementLog lies = log_;
  for (LandmarkTruth& landmark : lies.landmarks) {
    landmark.position_m = -2.0 * landmark.position_m;
    landmark.colour_class += 1;
  }
  for (LogStep& step : lies.steps) {
    step.truth = slam::Pose{-step.truth->y_m, 3.0 + step.truth->x_m, 0.5};
    for (int& landmark : step.true_landmarks) landmark = 0;
  }
  const FilterRun run = run_on(log_);
  const FilterRun misled = run_on(lies);
  ASSERT_EQ(run.poses.size(), log_.steps.size());
  for (std::size_t k = 0; k < run.poses.size(); ++k) expect_same(run, misled, k);
  ASSERT_EQ(run.last.landmarks.size(), misled.last.landmarks.size());
  for (std::size_t i = 0; i < run.last.landmarks.size(); ++i)
    EXPECT_EQ(run.last.landmarks[i].position_m, misled.last.landmarks[i].position_m);
}

INSTANTIATE_TEST_SUITE_P(All, Causality, testing::ValuesIn(all_cases()), [](const auto& tested) {
  return tested.param.filter + "_" + tested.param.identity;
});

}  // namespace
}  // namespace stereobench::harness
