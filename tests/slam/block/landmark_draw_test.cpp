// Landmarks that are drawn together, against the Gaussian that they are drawn from.
#include "slam/block/landmark_draw.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

// Three landmarks tied by the pose that they were found from, of millimetres and of metres.
JointBelief tied() {
  RandomStream random(7, Stream::kWorld);
  JointBelief belief;
  long repairs = 0;
  belief.covariance.move_pose(Eigen::Vector2d::Zero(), Eigen::Vector3d(0.04, 0.01, 4e-4).asDiagonal());
  for (const double sd_m : {1e-3, 0.1, 3.0}) {
    Eigen::Matrix<double, 2, 3> by_pose;
    for (double& x : by_pose.reshaped()) x = random.normal();
    belief.covariance.place(static_cast<int>(belief.landmarks.size()), by_pose,
                            sd_m * sd_m * Eigen::Matrix2d::Identity(), repairs);
    belief.landmarks.emplace_back(4.0 * random.normal(), 4.0 * random.normal());
  }
  return belief;
}

// Mean and covariance of 20,000 draws, within five standard errors. Mutations: each landmark by itself;
// draws about the origin.
TEST(DrawLandmarks, HasTheMomentsOfTheBelief) {
  constexpr int kDraws = 20000;
  const JointBelief belief = tied();
  Eigen::Matrix<double, 6, 6> covariance;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      covariance.block<2, 2>(2 * i, 2 * j) = belief.covariance.between(i, j).bottomRightCorner<2, 2>();
  }
  RandomStream random(3, Stream::kFilter);
  long repairs = 0;
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  for (int k = 0; k < kDraws; ++k) {
    const std::vector<Eigen::Vector2d> places = draw_landmarks(belief, random, repairs);
    Eigen::Matrix<double, 6, 1> off;
    for (std::size_t j = 0; j < 3; ++j)
      off.segment<2>(2 * static_cast<Eigen::Index>(j)) = places[j] - belief.landmarks[j];
    sum += off;
    squares += off * off.transpose();
  }
  const auto by_sd = covariance.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
  const double error = 5.0 / std::sqrt(static_cast<double>(kDraws));
  EXPECT_LT((by_sd * sum / kDraws).cwiseAbs().maxCoeff(), error);
  EXPECT_LT((by_sd * (squares / kDraws - covariance) * by_sd).cwiseAbs().maxCoeff(), std::sqrt(2.0) * error);
  EXPECT_EQ(repairs, 0);
}

// Landmarks that are known are where they are, and none are nowhere.
TEST(DrawLandmarks, MovesNothingThatIsCertain) {
  JointBelief belief;
  RandomStream random(3, Stream::kFilter);
  long repairs = 0;
  EXPECT_TRUE(draw_landmarks(belief, random, repairs).empty());
  belief.landmarks = {{1.0, 2.0}, {3.0, 4.0}};
  for (int j = 0; j < 2; ++j)
    belief.covariance.place(j, Eigen::Matrix<double, 2, 3>::Zero(), Eigen::Matrix2d::Zero(), repairs);
  EXPECT_EQ(draw_landmarks(belief, random, repairs), belief.landmarks);
  EXPECT_EQ(repairs, 0);
}

}  // namespace
}  // namespace stereobench::slam
