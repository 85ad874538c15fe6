#include "harness/scoring/consistency.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

Eigen::Vector3d normals(slam::RandomStream& random) {
  return {random.normal(), random.normal(), random.normal()};
}

slam::Pose pose(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), slam::wrap_angle(v.z())};
}

/// The mean over many draws of the normalised error of errors root * n with covariance root * root'.
template <int Columns>
double mean_over_draws(const Eigen::Matrix<double, 3, Columns>& root, double scale_of_covariance = 1.0) {
  slam::RandomStream random(11, slam::Stream::kWorld);
  double sum = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    Eigen::Matrix<double, Columns, 1> n;
    for (int k = 0; k < Columns; ++k) n[k] = random.normal();
    const slam::Pose truth{1.0, 2.0, M_PI - 1e-4};  // errors of heading cross the seam
    const Eigen::Vector3d error = root * n;
    const slam::Pose estimate{truth.x_m + error.x(), truth.y_m + error.y(),
                              slam::wrap_angle(truth.heading_rad + error.z())};
    sum += normalised_error(estimate, scale_of_covariance * root * root.transpose(), truth).value().ratio();
  }
  return sum / 20'000.0;
}

const Eigen::Matrix3d kRoot{{0.3, 0.0, 0.0}, {-0.1, 0.2, 0.0}, {0.004, -0.003, 0.01}};

// 20,000 draws of chi-square(3) / 3 have a mean of 1 +- 0.0058: five deviations. Mutations: no wrapping;
// P in place of its inverse.
TEST(NormalisedError, IsOneOnAverageWhenTheCovarianceIsConsistent) {
  EXPECT_NEAR(mean_over_draws<3>(kRoot), 1.0, 0.03);
  EXPECT_NEAR(mean_over_draws<3>(kRoot, 0.25), 4.0, 0.12);
}

// P of rank 2 and 1: the degrees of freedom are those that there are (chi-square(1) has a deviation of 0.01).
// Mutation: dividing by 3 whatever the rank.
TEST(NormalisedError, CountsTheDegreesOfFreedomThatThereAre) {
  EXPECT_NEAR((mean_over_draws<2>(kRoot.leftCols<2>())), 1.0, 0.04);
  EXPECT_NEAR((mean_over_draws<1>(kRoot.leftCols<1>())), 1.0, 0.05);
  EXPECT_NEAR((mean_over_draws<1>(kRoot.rightCols<1>())), 1.0, 0.05);
}

// Full rank in metres and in units of 10 km; mutation: a rank tolerance on P itself, whose units do not
// compare.
TEST(NormalisedError, DoesNotDependOnUnits) {
  slam::RandomStream random(3, slam::Stream::kWorld);
  for (int i = 0; i < 200; ++i) {
    Eigen::Matrix3d root;
    root << normals(random), normals(random), normals(random);
    const Eigen::Matrix3d covariance = 1e-3 * root * root.transpose() + 1e-5 * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d error = 0.1 * normals(random);
    const Eigen::Vector3d unit(1e-4, 1e-4, 1.0);
    const auto metres = normalised_error(pose(error), covariance, {});
    const Eigen::Vector3d scaled = error.cwiseProduct(unit);
    const Eigen::Matrix3d scaled_covariance = unit.asDiagonal() * covariance * unit.asDiagonal();
    const auto other = normalised_error(pose(scaled), scaled_covariance, {});
    const double expected = error.dot(covariance.ldlt().solve(error)) / 3.0;  // an independent way
    EXPECT_NEAR(metres->ratio() / expected, 1.0, 1e-9);
    EXPECT_NEAR(other->ratio() / expected, 1.0, 1e-9);
  }
}

TEST(NormalisedError, IsNothingWithoutACovariance) {
  EXPECT_FALSE(normalised_error({1, 1, 1}, Eigen::Matrix3d::Zero(), {}).has_value());
  const Eigen::Matrix3d nan = Eigen::Matrix3d::Constant(std::nan(""));
  EXPECT_FALSE(normalised_error({1, 1, 1}, nan, {}).has_value());
  EXPECT_FALSE(normalised_error({std::nan(""), 1, 1}, Eigen::Matrix3d::Identity(), {}).has_value());
}

// Mutations: scoring the first steps, where the start is given and P is zero, and where one control was
// too few.
TEST(NormalisedErrors, SkipTheFirstTwoStepsAndThoseWithoutTruth) {
  MeasurementLog log;
  log.steps.resize(5);
  for (const std::size_t i : {0U, 1U, 2U, 4U}) log.steps[i].truth = slam::Pose{};
  FilterRun run;
  run.poses.assign(5, slam::Pose{0.0, 3.0, 0.0});
  run.covariances.assign(5, Eigen::Matrix3d::Identity());
  const auto errors = normalised_errors(run, log);
  ASSERT_EQ(errors.size(), 5U);
  EXPECT_FALSE(errors[0].has_value());
  EXPECT_FALSE(errors[1].has_value());
  EXPECT_DOUBLE_EQ(errors[2].value().sum, 9.0);
  EXPECT_EQ(errors[2]->degrees_of_freedom, 3);
  EXPECT_FALSE(errors[3].has_value());
  EXPECT_DOUBLE_EQ(errors[4].value().ratio(), 3.0);
}

// Mutation: the mean of ratios, in which a seed of rank 1 counts as much as one of rank 3.
TEST(AddSteps, IsStepByStepOverThoseThatHaveAValue) {
  const std::vector<std::vector<std::optional<SquaredSum>>> runs = {
      {{}, SquaredSum{1.0, 3}, SquaredSum{4.0, 1}}, {{}, SquaredSum{3.0, 3}}, {{}, {}, SquaredSum{8.0, 3}}};
  std::vector<SquaredSum> sums;
  for (const auto& run : runs) add_steps(sums, run);
  ASSERT_EQ(sums.size(), 3U);
  EXPECT_EQ(sums[0].degrees_of_freedom, 0);
  EXPECT_DOUBLE_EQ(sums[1].ratio(), 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(sums[2].ratio(), 12.0 / 4.0);
}

TEST(NormalisedError, OfAPositionIsItsMahalanobisLength) {
  const Eigen::Matrix2d covariance{{0.04, 0.01}, {0.01, 0.09}};
  const Eigen::Vector2d error(0.1, -0.4);
  const auto squared = normalised_error(error, covariance);
  EXPECT_NEAR(squared.value().sum, error.dot(covariance.inverse() * error), 1e-12);
  EXPECT_EQ(squared->degrees_of_freedom, 2);
  EXPECT_EQ(normalised_error(error, Eigen::Matrix2d{{0.04, 0.0}, {0.0, 0.0}}).value().degrees_of_freedom, 1);
}

/// Steps at which seeds are consistent, or have errors a factor too large.
std::vector<SquaredSum> steps_of(std::uint64_t seed, std::size_t count, double factor_from_half) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  std::vector<SquaredSum> steps(count);
  for (std::size_t step = 0; step < count; ++step)
    for (int i = 0; i < 30; ++i) {
      const double n = (step < count / 2 ? 1.0 : factor_from_half) * random.normal();
      steps[step] += {n * n, 1};
    }
  return steps;
}

// 300 families of 40 consistent steps: with Holm's correction one in twenty has any step outside, 15 +- 3.8:
// four deviations (Holm is a little cautious). Without it 260 would. Mutation: no correction.
TEST(JudgeSteps, OneConsistentFamilyInTwentyHasAnyStepOutside) {
  int families = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed)
    families += judge_steps(steps_of(seed, 40, 1.0)).first_outside ? 1 : 0;
  EXPECT_LT(families, 15 + 16);
  EXPECT_GT(families, 15 - 15);
}

TEST(JudgeSteps, FindsWhenErrorsBecomeTooLarge) {
  std::vector<SquaredSum> steps = steps_of(1, 40, 3.0);
  steps[0] = {};
  const StepVerdict verdict = judge_steps(steps);
  EXPECT_EQ(verdict.steps, 39);
  EXPECT_EQ(verdict.first_outside, std::optional<std::size_t>(20));
  EXPECT_NEAR(verdict.fraction_outside, 20.0 / 39.0, 1e-12);
  EXPECT_TRUE(std::isnan(judge_steps({}).fraction_outside));
}

// Mutation: p-values of one side, by which errors that are too small are no fault. (They are: the filter
// throws away what it knows.)
TEST(JudgeSteps, ErrorsThatAreTooSmallLieOutsideToo) {
  EXPECT_EQ(judge_steps(steps_of(2, 40, 0.2)).first_outside, std::optional<std::size_t>(20));
}

}  // namespace
}  // namespace stereobench::harness
