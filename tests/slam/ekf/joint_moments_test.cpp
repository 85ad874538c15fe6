// What a sighting says of a joint belief, against Monte Carlo.
#include "slam/ekf/joint_moments.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/models/measurement.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

constexpr int kMomentDraws = 40000;

// A pose and two landmarks that are tied through it, uncertain by centimetres and hundredths of a radian.
class Tied {
 public:
  Tied() {
    RandomStream random(7, Stream::kWorld);
    long repairs = 0;
    belief.pose = {1.0, -2.0, 3.0};
    belief.landmarks = {{-5.0, -2.5}, {4.0, 3.0}};
    Eigen::Matrix3d spread;
    for (double& x : spread.reshaped()) x = 0.01 * random.normal();
    belief.covariance.move_pose(Eigen::Vector2d::Zero(), spread * spread.transpose());
    for (int j = 0; j < 2; ++j) {
      Eigen::Matrix<double, 2, 3> by_pose;
      for (double& x : by_pose.reshaped()) x = random.normal();
      belief.covariance.place(j, by_pose, 2e-4 * Eigen::Matrix2d::Identity(), repairs);
    }
    Eigen::Matrix<double, 7, 7> all;
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        const Eigen::Matrix<double, 5, 5> block = belief.covariance.between(i, j);
        all.topLeftCorner<3, 3>() = block.topLeftCorner<3, 3>();
        all.block<3, 2>(0, 3 + 2 * j) = block.topRightCorner<3, 2>();
        all.block<2, 3>(3 + 2 * i, 0) = block.bottomLeftCorner<2, 3>();
        all.block<2, 2>(3 + 2 * i, 3 + 2 * j) = block.bottomRightCorner<2, 2>();
      }
    }
    root_ = all.llt().matrixL();
  }

  Eigen::Matrix<double, 7, 1> draw(RandomStream& random) const {
    Eigen::Matrix<double, 7, 1> normals;
    for (double& x : normals) x = random.normal();
    return root_ * normals;
  }

  JointBelief belief;

 private:
  Eigen::Matrix<double, 7, 7> root_;
};

// What a sighting shares with pose and landmarks.
Eigen::MatrixXd shared_with(const JointBelief& belief, const JointInnovation& seen) {
  JointCovariance::Columns shared;
  belief.covariance.with_sighting(0, seen.slope, seen.near, shared);
  return shared;
}

// By slopes at the mean: no model is needed.
JointInnovation innovation(const Linearised&, const JointBelief& belief, int landmark,
                           const Observation& observation, long& repairs) {
  return slam::innovation(belief, landmark, observation, repairs);
}

template <class Model>
class JointMoments : public ::testing::Test {};
using BothModels = ::testing::Types<Linearised, Unscented>;
TYPED_TEST_SUITE(JointMoments, BothModels);

// Where noise is small both have the moments of 40,000 sightings: expected, S, and what the sighting shares
// with the pose, its landmark and the other one, within five standard errors. Mutation: sigma points of pose
// and landmark as if neither knew of the other.
TYPED_TEST(JointMoments, AreThoseOfManySightings) {
  const Tied tied;
  long repairs = 0;
  RandomStream random(3, Stream::kWorld);
  const Eigen::Matrix2d noise = Eigen::Vector2d(1e-4, 4e-6).asDiagonal();
  const JointInnovation seen =
      innovation(TypeParam(), tied.belief, 0, {Eigen::Vector2d::Zero(), noise}, repairs);
  const Eigen::Matrix<double, 7, 2> shared = shared_with(tied.belief, seen);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 7, 2> cross = Eigen::Matrix<double, 7, 2>::Zero();
  for (int i = 0; i < kMomentDraws; ++i) {
    const Eigen::Matrix<double, 7, 1> off = tied.draw(random);
    const Eigen::Vector2d error(1e-2 * random.normal(), 2e-3 * random.normal());
    const Eigen::Vector2d exact = predict_sighting(boxplus(tied.belief.pose, off.head<3>()),
                                                   tied.belief.landmarks[0] + off.segment<2>(3));
    // Nothing was seen, so the residual is what was expected, with the other sign.
    const Eigen::Vector2d innovation = sighting_residual(exact + error, -seen.residual);
    mean += innovation / kMomentDraws;
    square += innovation * innovation.transpose() / kMomentDraws;
    cross += off * innovation.transpose() / kMomentDraws;
  }
  const Eigen::Vector2d by_sd = seen.covariance.diagonal().cwiseSqrt().cwiseInverse();
  const double error = 5.0 / std::sqrt(static_cast<double>(kMomentDraws));
  EXPECT_LT((by_sd.asDiagonal() * mean).cwiseAbs().maxCoeff(), error);
  EXPECT_LT((by_sd.asDiagonal() * (square - seen.covariance) * by_sd.asDiagonal()).cwiseAbs().maxCoeff(),
            std::sqrt(2.0) * error);
  EXPECT_TRUE(near(by_sd.asDiagonal() * (cross - shared).transpose(), Eigen::Matrix<double, 2, 7>::Zero(),
                   0.05 * std::sqrt(2.0) * error));
  EXPECT_EQ(repairs, 0);
}

// Found from an uncertain pose: the landmark, and what it shares with the pose, of 40,000 finds. Mutation:
// the pose's part of the uncertainty counted twice.
TYPED_TEST(JointMoments, AreThoseOfManyFinds) {
  const Tied tied;
  JointBelief belief = tied.belief;
  const Observation seen{{6.0, 0.4}, Eigen::Vector2d(1e-4, 4e-6).asDiagonal()};
  long repairs = 0;
  find(TypeParam(), belief, 2, seen, repairs);
  ASSERT_EQ(belief.landmarks.size(), 3U);
  const Eigen::Matrix<double, 5, 5> expected = belief.covariance.pose_and_landmark(2);
  RandomStream random(3, Stream::kWorld);
  Eigen::Matrix<double, 5, 1> mean = Eigen::Matrix<double, 5, 1>::Zero();
  Eigen::Matrix<double, 5, 5> square = Eigen::Matrix<double, 5, 5>::Zero();
  for (int i = 0; i < kMomentDraws; ++i) {
    const Eigen::Vector3d step = tied.draw(random).template head<3>();
    const Eigen::Vector2d error(1e-2 * random.normal(), 2e-3 * random.normal());
    Eigen::Matrix<double, 5, 1> off;
    off << step, locate(boxplus(belief.pose, step), seen.range_bearing + error) - belief.landmarks[2];
    mean += off / kMomentDraws;
    square += off * off.transpose() / kMomentDraws;
  }
  const Eigen::Matrix<double, 5, 1> by_sd = expected.diagonal().cwiseSqrt().cwiseInverse();
  const double error = 5.0 / std::sqrt(static_cast<double>(kMomentDraws));
  EXPECT_LT((by_sd.asDiagonal() * mean).cwiseAbs().maxCoeff(), error);
  EXPECT_LT((by_sd.asDiagonal() * (square - expected) * by_sd.asDiagonal()).cwiseAbs().maxCoeff(),
            std::sqrt(2.0) * error);
}

// A motion of one control has rank two and a known pose rank zero: the slope is that of what is uncertain.
TYPED_TEST(JointMoments, NeedNoInverseOfTheCovariance) {
  JointBelief belief;
  long repairs = 0;
  find(TypeParam(), belief, 0, {{5.0, 0.3}, Eigen::Vector2d(1e-4, 1e-6).asDiagonal()}, repairs);
  follow(belief, Linearised().move({}, {1.0, 0.2, 0.5}, {0.01, 0.01}, repairs));
  const JointInnovation seen =
      innovation(TypeParam(), belief, 0, {{5.0, 0.3}, Eigen::Vector2d(1e-4, 1e-6).asDiagonal()}, repairs);
  const JointInnovation exact =
      innovation(Linearised(), belief, 0, {{5.0, 0.3}, Eigen::Vector2d(1e-4, 1e-6).asDiagonal()}, repairs);
  EXPECT_TRUE(near(shared_with(belief, seen), shared_with(belief, exact), 1e-6));
  EXPECT_EQ(repairs, 0);
}

}  // namespace
}  // namespace stereobench::slam
