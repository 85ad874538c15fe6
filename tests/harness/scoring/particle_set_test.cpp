#include "harness/scoring/particle_set.h"

#include <cmath>

#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

// By hand, from the end: the last update left 0..3, which it drew from {1, 1, 2, 3}; those are three of what
// the second update left. That one drew them from {0, 0, 2, 2}: 1 is from 0, 2 and 3 are from 2. Mutations:
// forgetting an update without resampling; ancestors composed from the front; counting before the
// update.
TEST(DistinctAncestors, OfAKnownSequence) {
  const std::vector<std::vector<int>> updates = {{}, {0, 0, 2, 2}, {}, {1, 1, 2, 3}};
  EXPECT_EQ(distinct_ancestors(updates, 4), (std::vector{2, 3, 3, 4}));
}

TEST(DistinctAncestors, OfNoResamplingAreAllAndOfOneSurvivorOne) {
  const std::vector<std::vector<int>> none(3);
  EXPECT_EQ(distinct_ancestors(none, 5), (std::vector{5, 5, 5}));
  const std::vector<std::vector<int>> one = {{}, {2, 2, 2}, {}};
  EXPECT_EQ(distinct_ancestors(one, 3), (std::vector{1, 3, 3}));
  EXPECT_TRUE(distinct_ancestors({}, 3).empty());
}

// Mutations: steps at which nothing was seen counted as updates; the quarter counted from the front.
TEST(ScoreParticles, IsOfTheUpdatesAlone) {
  MeasurementLog log;
  FilterRun run{.particles = 100};
  for (int k = 0; k < 10; ++k) {
    const bool sees = k % 2 == 1;  // five updates
    log.steps.emplace_back();
    if (sees) log.steps.back().measurements.emplace_back();
    run.updates.push_back({{}, sees ? 10.0 * k : 1.0, sees ? 10 + k : 1});
  }
  run.last.counters.resamplings = 3;
  const ParticleScore score = score_particles(run, log);
  EXPECT_NEAR(score.effective_mean, 50.0, 1e-12);
  EXPECT_EQ(score.effective_least, 10.0);
  EXPECT_EQ(score.resamplings, 3.0);
  EXPECT_EQ(score.ancestors_of_first, 11.0);
  EXPECT_EQ(score.ancestors_of_quarter, 17.0);
  EXPECT_TRUE(std::isnan(score_particles({}, {}).effective_mean));
}

}  // namespace
}  // namespace stereobench::harness
