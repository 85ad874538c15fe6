// The triangle that stands for a matrix, against the matrix.
#include "slam/ekf/joint_covariance.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/math/gaussian.h"
#include "slam/math/random.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

// The same covariance twice: as a triangle, and as the matrix that the formulas are written for.
class Twice {
 public:
  explicit Twice(std::uint64_t seed) : random_(seed, Stream::kWorld) {}

  void move_pose() {
    const Eigen::Vector2d heading_lever = random<2, 1>();
    const Eigen::Matrix<double, 3, 2> noise = random<3, 2>();  // of rank 2, like odometry's
    triangle_.move_pose(heading_lever, noise * noise.transpose());
    Eigen::MatrixXd by_all = Eigen::MatrixXd::Identity(matrix_.rows(), matrix_.rows());
    by_all.block<2, 1>(0, 2) = heading_lever;
    matrix_ = (by_all * matrix_ * by_all.transpose()).eval();
    matrix_.topLeftCorner<3, 3>() += noise * noise.transpose();
  }

  void place(int landmark) {
    const Eigen::Matrix<double, 2, 3> by_pose = random<2, 3>();
    const Eigen::Matrix2d noise = random<2, 2>();
    long repairs = 0;
    triangle_.place(landmark, by_pose, noise * noise.transpose(), repairs);
    const Eigen::Index first = 3 + 2 * landmark;
    const Eigen::Index size = std::max(matrix_.rows(), first + 2);
    Eigen::MatrixXd by_all = Eigen::MatrixXd::Identity(size, matrix_.rows());
    by_all.middleRows<2>(first).setZero();
    by_all.block<2, 3>(first, 0) = by_pose;
    matrix_ = (by_all * matrix_ * by_all.transpose()).eval();
    matrix_.block<2, 2>(first, first) += noise * noise.transpose();
  }

  void correct(int landmark) {
    const Eigen::Matrix<double, 2, 5> slope = random<2, 5>();
    Eigen::MatrixXd by_all = Eigen::MatrixXd::Zero(2, matrix_.rows());
    by_all.leftCols<3>() = slope.leftCols<3>();
    by_all.middleCols<2>(3 + 2 * landmark) = slope.rightCols<2>();
    JointCovariance::Columns columns;
    triangle_.with_sighting(landmark, slope, slope * triangle_.pose_and_landmark(landmark), columns);
    EXPECT_TRUE(near(columns, matrix_ * by_all.transpose(), 1e-12 * scale()));
    const Eigen::Matrix2d innovation = by_all * matrix_ * by_all.transpose() + Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d root = innovation.llt().matrixL();
    long repairs = 0;
    triangle_.subtract(columns * root.transpose().inverse(), repairs);
    EXPECT_EQ(repairs, 0);
    matrix_ -= (matrix_ * by_all.transpose() * innovation.inverse() * by_all * matrix_).eval();
  }

  void expect_equal() const {
    const double tolerance = 1e-12 * scale();
    EXPECT_TRUE(near(triangle_.pose(), matrix_.topLeftCorner<3, 3>(), tolerance));
    for (int j = 0; j < landmarks(); ++j) {
      const Eigen::Index first = 3 + 2 * j;
      Eigen::Matrix<double, 5, 5> both;
      both << matrix_.topLeftCorner<3, 3>(), matrix_.block<3, 2>(0, first), matrix_.block<2, 3>(first, 0),
          matrix_.block<2, 2>(first, first);
      EXPECT_TRUE(near(triangle_.pose_and_landmark(j), both, tolerance));
      EXPECT_TRUE(near(triangle_.landmark(j), matrix_.block<2, 2>(first, first), tolerance));
    }
  }

  int landmarks() const { return static_cast<int>(matrix_.rows() - 3) / 2; }
  int some_landmark() { return static_cast<int>(random_.bits() % static_cast<unsigned>(landmarks())); }

 private:
  template <int kRows, int kColumns>
  Eigen::Matrix<double, kRows, kColumns> random() {
    Eigen::Matrix<double, kRows, kColumns> matrix;
    for (double& entry : matrix.reshaped()) entry = random_.normal();
    return matrix;
  }
  double scale() const { return std::fmax(1.0, matrix_.cwiseAbs().maxCoeff()); }

  RandomStream random_;
  JointCovariance triangle_;
  Eigen::MatrixXd matrix_ = Eigen::MatrixXd::Zero(3, 3);
};

// Law: whatever happens in whatever order, the triangle is the matrix. Catches a row or a column that is left
// out, an old landmark's covariances that stay, and H applied to the wrong rows.
TEST(JointCovariance, IsTheDenseMatrix) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Twice both(seed);
    for (int round = 0; round < 12; ++round) {
      both.move_pose();
      if (round % 3 != 2) both.place(both.landmarks());
      both.correct(both.some_landmark());
      if (round % 5 == 4) both.place(both.some_landmark());
      both.expect_equal();
    }
  }
}

// Catches rounding that leaves a variance below zero, and a repair that nobody hears of.
TEST(JointCovariance, AVarianceBelowZeroBecomesZeroAndIsCounted) {
  JointCovariance covariance;
  covariance.move_pose(Eigen::Vector2d::Zero(), Eigen::Vector3d(1.0, 4.0, 9.0).asDiagonal());
  long repairs = 0;
  covariance.place(0, Eigen::Matrix<double, 2, 3>::Identity(), Eigen::Matrix2d::Identity(), repairs);
  JointCovariance::Columns too_much = JointCovariance::Columns::Zero(5, 2);
  too_much(1, 0) = 2.0 + 1e-9;
  covariance.subtract(too_much, repairs);
  EXPECT_EQ(repairs, 1);
  EXPECT_TRUE(near(covariance.pose(), Eigen::Vector3d(1.0, 0.0, 9.0).asDiagonal().toDenseMatrix(), 0.0));
  EXPECT_EQ(covariance.pose_and_landmark(0)(1, 4), 0.0);  // nothing varies with what does not vary
  EXPECT_EQ(covariance.pose_and_landmark(0)(0, 3), 1.0);
}

// Law: what is passed over without a look at its root is what project_to_psd() would leave as it is, for
// poses of rank two that have lost a little or got a little more. Mutation: a slack of 1e-5.
TEST(JointCovariance, APoseIsRepairedWhereAndOnlyWhereItsMatrixIs) {
  RandomStream random(3, Stream::kWorld);
  int repaired = 0;
  for (int round = 0; round < 5000; ++round) {
    Eigen::Matrix3d root = Eigen::Matrix3d::Zero();
    for (double& entry : root.leftCols<2>().reshaped()) entry = random.normal();
    Eigen::Vector3d off;
    for (double& entry : off) entry = random.normal();
    const double change = (random.uniform() - 0.5) * std::pow(10.0, -16.0 * random.uniform());
    Eigen::Matrix3d pose = root * root.transpose() + change * off * off.transpose();
    if (!(pose.diagonal().minCoeff() > 0.0)) continue;
    JointCovariance covariance;
    covariance.move_pose(Eigen::Vector2d::Zero(), pose);
    long repairs = 0;
    covariance.subtract(JointCovariance::Columns::Zero(3, 2), repairs);
    long expected = 0;
    project_to_psd<3>(pose, expected);
    ASSERT_EQ(repairs, expected) << change << "\n" << pose;
    repaired += static_cast<int>(expected);
  }
  EXPECT_GT(repaired, 500);
  EXPECT_LT(repaired, 4000);
}

// Two coordinates that lose what they do not have in common: each keeps a variance, and together they have
// less than none. Mutation: blocks that are not repaired.
TEST(JointCovariance, ABlockThatIsIndefiniteIsRepairedAndCounted) {
  JointCovariance covariance;
  long repairs = 0;
  covariance.move_pose(Eigen::Vector2d::Zero(), Eigen::Vector3d(1.0, 4.0, 9.0).asDiagonal());
  covariance.place(0, Eigen::Matrix<double, 2, 3>::Identity(), Eigen::Matrix2d::Identity(), repairs);
  JointCovariance::Columns too_much = JointCovariance::Columns::Zero(5, 2);
  too_much.col(0) << 0.9, -1.8, 0.0, 1.2, -2.0;
  covariance.subtract(too_much, repairs);
  EXPECT_EQ(repairs, 2);
  EXPECT_LE(std::abs(covariance.pose()(0, 1)), std::sqrt(covariance.pose()(0, 0) * covariance.pose()(1, 1)));
  const Eigen::Matrix2d landmark = covariance.landmark(0);
  EXPECT_GE(landmark.determinant(), -1e-12);
  EXPECT_GE(landmark(0, 0), 2.0 - 1.2 * 1.2);
}

}  // namespace
}  // namespace stereobench::slam
