#include "slam/math/gaussian.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "slam/math/sigma_points.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

template <int kRows, int kColumns>
Eigen::Matrix<double, kRows, kColumns> any_matrix(RandomStream& random) {
  Eigen::Matrix<double, kRows, kColumns> matrix;
  for (double& entry : matrix.reshaped()) entry = random.normal();
  return matrix;
}

class GaussianLaws : public ::testing::TestWithParam<int> {
 protected:
  RandomStream random_{static_cast<std::uint64_t>(GetParam()), Stream::kWorld};
};
INSTANTIATE_TEST_SUITE_P(Gaussian, GaussianLaws, ::testing::Range(0, 100));

// Ranks 0 to 3, rows of scales 1e-6 to 1e6. Catches a factorisation that needs a positive definite matrix:
// the process noise of one control has rank 2.
TEST_P(GaussianLaws, RootTimesItsTransposeIsTheCovarianceOfAnyRank) {
  for (int rank = 0; rank <= 3; ++rank) {
    Eigen::Matrix3d spread = any_matrix<3, 3>(random_);
    for (int j = rank; j < 3; ++j) spread.col(j).setZero();
    const Eigen::Vector3d scale(std::pow(10.0, 2.0 * random_.normal()), 1.0,
                                std::pow(10.0, 2.0 * random_.normal()));
    spread = scale.asDiagonal() * spread;
    const Eigen::Matrix3d covariance = spread * spread.transpose();
    long repairs = 0;
    const Eigen::Matrix3d root = semidefinite_root<3>(covariance, repairs);
    const Eigen::Matrix3d relative = scale.cwiseInverse().asDiagonal() *
                                     (root * root.transpose() - covariance) *
                                     scale.cwiseInverse().asDiagonal();
    EXPECT_TRUE(near(relative, Eigen::Matrix3d::Zero(), 1e-12));
    EXPECT_EQ(repairs, 0);
  }
}

// A L = b, of any rank, for b that is in the reach of L. Mutation: columns solved from the first on.
TEST_P(GaussianLaws, RootIsUndoneWithinItsReach) {
  for (int rank = 0; rank <= 3; ++rank) {
    Eigen::Matrix3d spread = any_matrix<3, 3>(random_);
    for (int j = rank; j < 3; ++j) spread.col(j).setZero();
    const Eigen::Matrix3d covariance = spread * spread.transpose();
    long repairs = 0;
    const PivotedRoot<3> root = pivoted_root<3>(covariance, covariance.diagonal(), repairs);
    EXPECT_EQ(root.rank, rank);
    const Eigen::Matrix<double, 2, 3> b = any_matrix<2, 3>(random_) * root.lower;
    const Eigen::Matrix<double, 2, 3> a = root.divide<2>(b);
    EXPECT_TRUE(near(a * root.lower, b, 1e-9 * (1.0 + a.cwiseAbs().maxCoeff())));
  }
}

// What is left of a variance of 1 is rounding, and no more to be drawn from than to be repaired.
TEST(PivotedRoot, PassesOverTheRoundingOfWhatItWasTakenFrom) {
  Eigen::Matrix2d left;
  left << 1e-17, 2e-17, 2e-17, 1e-17;
  long repairs = 0;
  EXPECT_EQ(pivoted_root<2>(left, Eigen::Vector2d::Ones(), repairs).rank, 0);
  EXPECT_EQ(repairs, 0);
  EXPECT_EQ(pivoted_root<2>(left, left.diagonal(), repairs).rank, 1);
  EXPECT_EQ(repairs, 1);
}

TEST(SemidefiniteRoot, CountsWhatItHadToRepair) {
  long repairs = 0;
  const Eigen::Matrix3d root = semidefinite_root<3>(Eigen::Vector3d(1.0, -0.5, 4.0).asDiagonal(), repairs);
  EXPECT_EQ(repairs, 1);
  const Eigen::Matrix3d square = root * root.transpose();
  EXPECT_TRUE(near(square, Eigen::Matrix3d(Eigen::Vector3d(1.0, 0.0, 4.0).asDiagonal()), 1e-15));
}

// A pivot that is rounding error must not be divided by: seen on a robot that stands still.
TEST(SemidefiniteRoot, DoesNotBlowUpRoundingErrors) {
  Eigen::Matrix3d covariance;
  covariance << 3.7444101946245291e-11, -1.2164602333812248e-10, 3.4240799153318204e-15,
      -1.2164602333812248e-10, 3.9519588482727322e-10, 1.1130097388897191e-15, 3.4240799153318204e-15,
      1.1130097388897191e-15, 8.9999757756067888e-10;
  long repairs = 0;
  const Eigen::Matrix3d root = semidefinite_root<3>(covariance, repairs);
  const Eigen::Matrix3d square = root * root.transpose();
  EXPECT_TRUE(near(square, covariance, 1e-17));
  EXPECT_EQ(repairs, 0);
}

TEST_P(GaussianLaws, FactorGivesInverseAndDeterminant) {
  const Eigen::Matrix2d spread = any_matrix<2, 2>(random_) + 3.0 * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d covariance = spread * spread.transpose();
  const Eigen::Vector2d v = any_matrix<2, 1>(random_);
  const Eigen::Matrix<double, 3, 2> a = any_matrix<3, 2>(random_);
  long repairs = 0;
  const Factor2 factor(covariance, repairs);
  EXPECT_NEAR(factor.squared_length(v), v.dot(covariance.inverse() * v), 1e-9);
  EXPECT_NEAR(factor.log_det_2_pi(), std::log(4.0 * M_PI * M_PI * covariance.determinant()), 1e-9);
  EXPECT_TRUE(near(factor.divide<3>(a), a * covariance.inverse(), 1e-9));
  EXPECT_EQ(repairs, 0);
}

TEST(Factor2, RepairsASingularMatrixAndCounts) {
  long repairs = 0;
  Eigen::Matrix2d singular;
  singular << 1.0, 1.0, 1.0, 1.0;
  EXPECT_TRUE(std::isfinite(Factor2(singular, repairs).squared_length({1.0, 2.0})));
  EXPECT_TRUE(std::isfinite(Factor2(Eigen::Matrix2d::Zero(), repairs).log_det_2_pi()));
  EXPECT_EQ(repairs, 2);
}

// Errata: eq. 14 has the denominator n - lambda, with which the moments of a linear map are wrong unless
// lambda is 0.
TEST_P(GaussianLaws, UnscentedTransformIsExactForLinearMaps) {
  for (const double alpha : {0.002, 0.1, 1.0}) {
    const SigmaWeights<3> weights(UnscentedParameters{alpha, 2.0, 0.0});
    const Eigen::Matrix3d root = any_matrix<3, 3>(random_);
    const Eigen::Matrix<double, 2, 3> map = any_matrix<2, 3>(random_);
    SigmaResiduals<2, 3> residuals;
    for (int i = 0; i < 3; ++i) {
      residuals.col(2 * i) = map * (weights.spread * root.col(i));
      residuals.col(2 * i + 1) = map * (-weights.spread * root.col(i));
    }
    const Eigen::Vector2d mean = sigma_mean<2, 3>(residuals, weights);
    const Eigen::Matrix3d covariance = root * root.transpose();
    EXPECT_TRUE(near(mean, Eigen::Vector2d::Zero(), 1e-9));
    EXPECT_TRUE(
        near(sigma_covariance<2, 3>(residuals, mean, weights), map * covariance * map.transpose(), 1e-9));
    EXPECT_TRUE(near(sigma_cross<3, 2, 3>(root, 0, residuals, weights), covariance * map.transpose(), 1e-9));
  }
}

// The mean of x^2 is the variance, its covariance 2 sd^4 with beta = 2. Catches the centre's weight (eq. 15).
TEST(SigmaPoints, GetTheMomentsOfASquare) {
  const SigmaWeights<1> weights(UnscentedParameters{0.5, 2.0, 0.0});
  const double sd = 0.7;
  SigmaResiduals<1, 1> residuals;
  residuals << std::pow(weights.spread * sd, 2), std::pow(-weights.spread * sd, 2);
  const auto mean = sigma_mean<1, 1>(residuals, weights);
  EXPECT_NEAR(mean(0), sd * sd, 1e-14);
  EXPECT_NEAR((sigma_covariance<1, 1>(residuals, mean, weights)(0)), 2.0 * std::pow(sd, 4), 1e-13);
}

TEST(ChiSquare, HasTheTabulatedQuantiles) {
  EXPECT_NEAR(chi_square_2_quantile(0.95), 5.991, 1e-3);
  EXPECT_NEAR(chi_square_2_quantile(0.99), 9.210, 1e-3);
}

// The tail of chi-square has a closed form for an even number of degrees of freedom.
double chi_square_tail(double x, int half_the_degrees_of_freedom) {
  double term = std::exp(-0.5 * x);
  double sum = 0.0;
  for (int j = 0; j < half_the_degrees_of_freedom; ++j) {
    sum += term;
    term *= 0.5 * x / (j + 1);
  }
  return sum;
}

// Catches either term of Wilson and Hilferty's cube left out or halved.
TEST(ChiSquare, QuantileOfManyDegreesLeavesTheTailItWasAskedFor) {
  for (const int half : {1, 2, 3, 10, 18}) {
    for (const double probability : {0.95, 0.99, 0.9999}) {
      const double within = probability > 0.99 ? 0.05 : 0.02;
      const double quantile = approximate_chi_square_quantile(probability, 2.0 * half);
      EXPECT_GE(chi_square_tail((1.0 - within) * quantile, half), 1.0 - probability);
      EXPECT_LE(chi_square_tail((1.0 + within) * quantile, half), 1.0 - probability);
    }
    EXPECT_TRUE(std::isinf(approximate_chi_square_quantile(1.0, 2.0 * half)));
  }
}

}  // namespace
}  // namespace stereobench::slam
