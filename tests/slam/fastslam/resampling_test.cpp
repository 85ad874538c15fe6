#include "slam/fastslam/resampling.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "slam/fastslam/mixture.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

std::vector<double> any_weights(RandomStream& random, std::size_t count, double spread) {
  std::vector<double> log_weights(count);
  for (double& w : log_weights) w = spread * random.normal();
  std::vector<double> weights(count);
  EXPECT_TRUE(normalise(log_weights, weights));
  return weights;
}

// A public implementation loops over floats and yields the wrong count. Catches that, and rounding at both
// ends.
TEST(SystematicDescendants, KeepCountAndExpectation) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomStream random(seed, Stream::kFilter);
    const std::size_t count = 1 + random.bits() % 300;
    const std::vector<double> weights = any_weights(random, count, 3.0 * random.uniform());
    for (const double uniform : {0.0, random.uniform(), 1.0 - 0x1p-53}) {
      const std::vector<int> descendants = systematic_descendants(weights, uniform);
      ASSERT_EQ(std::accumulate(descendants.begin(), descendants.end(), 0), static_cast<int>(count));
      for (std::size_t i = 0; i < count; ++i) {
        const double expected = static_cast<double>(count) * weights[i];
        ASSERT_GE(descendants[i], std::floor(expected - 1e-9));
        ASSERT_LE(descendants[i], std::ceil(expected + 1e-9));
      }
    }
  }
}

TEST(AncestorsInPlace, SurvivorsStayAndCountsHold) {
  const std::vector<int> descendants = {0, 3, 0, 2, 1, 0};
  const std::vector<int> ancestors = ancestors_in_place(descendants);
  std::vector<int> counted(descendants.size(), 0);
  for (const int ancestor : ancestors) ++counted[static_cast<std::size_t>(ancestor)];
  EXPECT_EQ(counted, descendants);
  for (const int survivor : {1, 3, 4}) EXPECT_EQ(ancestors[static_cast<std::size_t>(survivor)], survivor);
}

// Weights of exp(-5000) underflow in a public implementation. Catches weights that are not kept as
// logarithms.
TEST(Normalise, SurvivesWeightsThatUnderflow) {
  std::vector<double> log_weights = {-5000.0, -5001.0, -9000.0};
  std::vector<double> weights(log_weights.size());
  EXPECT_TRUE(normalise(log_weights, weights));
  EXPECT_NEAR(std::exp(log_weights[0]), 1.0 / (1.0 + std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(effective_particles(weights), std::pow(1.0 + std::exp(-1.0), 2) / (1.0 + std::exp(-2.0)),
              1e-12);
}

TEST(Normalise, MakesVanishedWeightsEqualAndSaysSo) {
  const double none = -std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> vanished = {none, nan, none, none};
  std::vector<double> weights(vanished.size());
  EXPECT_FALSE(normalise(vanished, weights));
  EXPECT_NEAR(effective_particles(weights), 4.0, 1e-12);
  std::vector<double> partly = {nan, 0.0, none};
  weights.resize(partly.size());
  EXPECT_TRUE(normalise(partly, weights));
  EXPECT_EQ(std::exp(partly[0]), 0.0);
  EXPECT_EQ(weights, (std::vector<double>{0.0, 1.0, 0.0}));
}

// A public implementation lets all copies share one landmark array. Catches a map that is referred to, not
// owned, by a copy or by a descendant.
TEST(Particle, NeitherCopiesNorDescendantsChangeEachOthersMaps) {
  Particle original;
  original.known.push_back({{{1.0, 2.0}, Eigen::Matrix2d::Zero()}});
  Particle copy = original;
  Particle descendant = original.descendant();
  copy.known.replace(0, {{{9.0, 2.0}, Eigen::Matrix2d::Zero()}});
  descendant.known.replace(0, {{{8.0, 2.0}, Eigen::Matrix2d::Zero()}});
  EXPECT_EQ(original.known[0].belief.mean.x(), 1.0);
  EXPECT_EQ(copy.known[0].belief.mean.x(), 9.0);
  EXPECT_EQ(descendant.known[0].belief.mean.x(), 8.0);
}

// Catches a mean of headings taken as numbers: the mean of 3.1 and -3.1 is pi, not 0.
TEST(MixedPose, MeansHeadingsAcrossTheSeamAndAddsSpread) {
  std::vector<Posterior> posteriors(2);
  posteriors[0].pose = {{1.0, 0.0, 3.1}, Eigen::Matrix3d::Identity()};
  posteriors[1].pose = {{3.0, 0.0, -3.1}, Eigen::Matrix3d::Identity()};
  const PoseBelief mixed = mixed_pose(posteriors, {0.5, 0.5});
  EXPECT_TRUE(near(mixed.mean, Pose{2.0, 0.0, M_PI}, 1e-12));
  EXPECT_NEAR(mixed.covariance(0, 0), 2.0, 1e-12);
  EXPECT_NEAR(mixed.covariance(2, 2), 1.0 + std::pow(M_PI - 3.1, 2), 1e-12);
}

}  // namespace
}  // namespace stereobench::slam
