#include "harness/scoring/consistency.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "slam/motion.h"
#include "slam/random.h"

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
    sum += normalised_error(estimate, scale_of_covariance * root * root.transpose(), truth).value();
  }
  return sum / 20'000.0;
}

const Eigen::Matrix3d kRoot{{0.3, 0.0, 0.0}, {-0.1, 0.2, 0.0}, {0.004, -0.003, 0.01}};

// 20,000 draws of chi-square(3) / 3 have a mean of 1 +- 0.0058: five deviations. Mutations: dividing by 3
// whatever the rank, no wrapping, P in place of its inverse.
TEST(NormalisedError, IsOneOnAverageWhenTheCovarianceIsHonest) {
  EXPECT_NEAR(mean_over_draws<3>(kRoot), 1.0, 0.03);
  EXPECT_NEAR(mean_over_draws<3>(kRoot, 0.25), 4.0, 0.12);
}

// P of rank 2 and 1: the degrees of freedom are those that there are (chi-square(1) has a deviation of 0.01).
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
    EXPECT_NEAR(*metres / expected, 1.0, 1e-9);
    EXPECT_NEAR(*other / expected, 1.0, 1e-9);
  }
}

TEST(NormalisedError, IsNothingWithoutACovariance) {
  EXPECT_FALSE(normalised_error({1, 1, 1}, Eigen::Matrix3d::Zero(), {}).has_value());
  const Eigen::Matrix3d nan = Eigen::Matrix3d::Constant(std::nan(""));
  EXPECT_FALSE(normalised_error({1, 1, 1}, nan, {}).has_value());
  EXPECT_FALSE(normalised_error({std::nan(""), 1, 1}, Eigen::Matrix3d::Identity(), {}).has_value());
}

// Mutation: scoring the first steps, where the start is given and P is zero, and where one control was too
// few.
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
  EXPECT_DOUBLE_EQ(errors[2].value(), 3.0);
  EXPECT_FALSE(errors[3].has_value());
  EXPECT_DOUBLE_EQ(errors[4].value(), 3.0);
}

TEST(AverageOverSeeds, IsStepByStepOverThoseThatHaveAValue) {
  const std::vector<std::vector<std::optional<double>>> runs = {
      {{}, 1.0, 4.0}, {{}, 3.0}, {{}, {}, 8.0, 5.0}};
  const auto averages = average_over_seeds(runs);
  ASSERT_EQ(averages.size(), 4U);
  EXPECT_FALSE(averages[0].has_value());
  EXPECT_DOUBLE_EQ(*averages[1], 2.0);
  EXPECT_DOUBLE_EQ(*averages[2], 6.0);
  EXPECT_DOUBLE_EQ(*averages[3], 5.0);
  EXPECT_TRUE(average_over_seeds({}).empty());
}

}  // namespace
}  // namespace stereobench::harness
