#include "harness/scoring/coverage.h"

#include <cmath>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

const Eigen::Matrix2d kPositionRoot{{0.3, 0.0}, {-0.1, 0.2}};

/// A run whose positions are drawn from the covariance that it states, times a factor.
struct Drawn {
  MeasurementLog log;
  FilterRun run;

  Drawn(std::uint64_t seed, std::size_t steps, double factor = 1.0) {
    slam::RandomStream random(seed, slam::Stream::kWorld);
    for (std::size_t k = 0; k < steps; ++k) {
      const Eigen::Vector2d error =
          factor * kPositionRoot * Eigen::Vector2d(random.normal(), random.normal());
      log.steps.push_back({.truth = slam::Pose{1.0, -2.0, 0.3}});
      run.poses.push_back({1.0 + error.x(), -2.0 + error.y(), 0.3});
      run.covariances.push_back(Eigen::Matrix3d::Identity());
      run.covariances.back().topLeftCorner<2, 2>() = kPositionRoot * kPositionRoot.transpose();
    }
  }
};

/// Five deviations of a fraction of so many.
double five_deviations(double p, double count) {
  return 5.0 * std::sqrt(p * (1.0 - p) / count);
}

// Mutations: the heading's variance in the ellipse; one degree of freedom; a box in place of an ellipse.
TEST(CoverPath, IsTheEllipsesProbabilityWhenTheCovarianceIsConsistent) {
  const Drawn consistent(3, 10'002);
  const EllipseCoverage coverage = cover_path(consistent.run, consistent.log);
  EXPECT_EQ(coverage.positions, 10'000);
  for (std::size_t i = 0; i < kEllipses.size(); ++i)
    EXPECT_NEAR(coverage.within[i], kEllipses[i], five_deviations(kEllipses[i], 1e4)) << kEllipses[i];
}

// Errors twice as large as claimed lie within p of chi-square at a quarter: 1 - (1 - p)^(1/4).
TEST(CoverPath, FallsWhenTheCovarianceIsTooSmall) {
  const Drawn optimistic(4, 10'002, 2.0);
  const EllipseCoverage coverage = cover_path(optimistic.run, optimistic.log);
  for (std::size_t i = 0; i < kEllipses.size(); ++i) {
    const double expected = 1.0 - std::pow(1.0 - kEllipses[i], 0.25);
    EXPECT_NEAR(coverage.within[i], expected, five_deviations(expected, 1e4));
  }
}

// Mutation: counting the steps where the start is known.
TEST(CoverPath, LeavesOutTheFirstStepsAndThoseWithoutTruth) {
  Drawn run(5, 6);
  run.log.steps[3].truth.reset();
  EXPECT_EQ(cover_path(run.run, run.log).positions, 3);
  EXPECT_TRUE(std::isnan(cover_path({}, {}).within[0]));
}

// Mutations: landmarks that are nobody's counted as far off; a landmark's place after alignment.
TEST(CoverMap, IsOfTheLandmarksThatBelongToATrueOne) {
  const std::vector<LandmarkTruth> truth = {{7, slam::kUnknown, {1.0, 2.0}}, {8, slam::kUnknown, {5.0, 5.0}}};
  const Eigen::Matrix2d unit = Eigen::Matrix2d::Identity();
  const std::vector<slam::LandmarkEstimate> estimates = {
      {7, slam::kUnknown, {1.0, 3.0}, unit},    // 1: within 50 % (1.39)
      {8, slam::kUnknown, {5.0, 8.0}, unit},    // 9: within 99 % (9.21)
      {9, slam::kUnknown, {50.0, 8.0}, unit}};  // nobody's
  const EllipseCoverage coverage = cover_map(estimates, truth);
  EXPECT_EQ(coverage.positions, 2);
  EXPECT_DOUBLE_EQ(coverage.within[0], 0.5);
  EXPECT_DOUBLE_EQ(coverage.within[1], 0.5);
  EXPECT_DOUBLE_EQ(coverage.within[2], 1.0);
}

}  // namespace
}  // namespace stereobench::harness
