// The mode of a frame against a search that knows nothing of gains, and what each sighting says of the
// others.
#include "slam/ekf/frame_mode.h"

#include <functional>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/models/measurement.h"
#include "slam/models/noise_law.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

/// A belief of a pose and three landmarks, a coarse motion, and precise sightings of where it led.
struct Frame {
  JointBelief before;
  ChordBelief motion;
  std::vector<SeenLandmark> seen;
};

Eigen::MatrixXd random_covariance(Eigen::Index size, double sd, RandomStream& random) {
  Eigen::MatrixXd root(size, size);
  for (Eigen::Index i = 0; i < root.size(); ++i) root.data()[i] = sd * random.normal();
  return root * root.transpose() + 0.01 * sd * sd * Eigen::MatrixXd::Identity(size, size);
}

/// @param coarse sd of the motion's error, of itself @param sensor_sd m and rad
Frame random_frame(std::uint64_t seed, double coarse, double sensor_sd) {
  RandomStream random(seed, Stream::kWorld);
  Frame frame;
  long repairs = 0;
  frame.before.pose = {random.normal(), random.normal(), wrap_angle(3.0 * random.normal())};
  frame.before.covariance.move_pose(Eigen::Vector2d::Zero(), random_covariance(3, 0.02, random));
  for (int j = 0; j < 3; ++j) {
    const Eigen::Vector2d place(frame.before.pose.x_m + 3.0 * random.normal(),
                                frame.before.pose.y_m + 3.0 * random.normal());
    slam::place(frame.before, j, {place, random_covariance(2, 0.02, random)}, repairs);
  }
  frame.motion.mean = {1.0, 0.0, 0.5};
  frame.motion.covariance = Eigen::Vector3d(coarse, 0.01 * coarse, coarse).cwiseAbs2().asDiagonal();
  const Pose robot =
      end_of(frame.before.pose,
             frame.motion.mean + Eigen::Vector3d(coarse * random.normal(), 0.0, coarse * random.normal()));
  for (const int j : {0, 1, 2, 1}) {  // one is seen twice
    const Eigen::Vector2d exact =
        predict_sighting(robot, frame.before.landmarks[static_cast<std::size_t>(j)]);
    const Eigen::Vector2d seen = exact + sensor_sd * Eigen::Vector2d(random.normal(), random.normal());
    frame.seen.push_back({j, {seen, sensor_sd * sensor_sd * Eigen::Matrix2d::Identity()}});
  }
  return frame;
}

/// All residuals of a frame with unit variance, as functions of (pose before, chord, landmarks).
class Residuals {
 public:
  explicit Residuals(const Frame& frame) : frame_(frame) {
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(12, 12);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Eigen::Matrix<double, 5, 5> both = frame.before.covariance.between(i, j);
        covariance.topLeftCorner<3, 3>() = both.topLeftCorner<3, 3>();
        covariance.block<3, 2>(0, 6 + 2 * j) = both.topRightCorner<3, 2>();
        covariance.block<2, 3>(6 + 2 * i, 0) = both.bottomLeftCorner<2, 3>();
        covariance.block<2, 2>(6 + 2 * i, 6 + 2 * j) = both.bottomRightCorner<2, 2>();
      }
    }
    covariance.block<3, 3>(3, 3) = frame.motion.covariance;
    whitener_ = Eigen::MatrixXd(covariance.llt().matrixL()).inverse();
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& off) const {
    Eigen::VectorXd all(12 + 2 * static_cast<Eigen::Index>(frame_.seen.size()));
    all.head(12) = whitener_ * off;
    const Pose robot =
        end_of(boxplus(frame_.before.pose, off.head<3>()), frame_.motion.mean + off.segment<3>(3));
    Eigen::Index row = 12;
    for (const auto& [landmark, observation] : frame_.seen) {
      const Eigen::Vector2d place =
          frame_.before.landmarks[static_cast<std::size_t>(landmark)] + off.segment<2>(6 + 2 * landmark);
      all.segment<2>(row) = sighting_residual(predict_sighting(robot, place), observation.range_bearing)
                                .cwiseQuotient(observation.noise.diagonal().cwiseSqrt());
      row += 2;
    }
    return all;
  }

 private:
  const Frame& frame_;
  Eigen::MatrixXd whitener_;
};

/// The least squares by Levenberg and Marquardt with numeric slopes.
Eigen::VectorXd least_squares(const Residuals& residuals) {
  Eigen::VectorXd at = Eigen::VectorXd::Zero(12);
  double damping = 1e-3;
  for (int step = 0; step < 300; ++step) {
    const Eigen::VectorXd value = residuals(at);
    Eigen::MatrixXd slope(value.size(), 12);
    for (Eigen::Index i = 0; i < 12; ++i) {
      const Eigen::VectorXd by = 1e-6 * Eigen::VectorXd::Unit(12, i);
      slope.col(i) = (residuals(at + by) - residuals(at - by)) / 2e-6;
    }
    Eigen::MatrixXd normal = slope.transpose() * slope;
    normal.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd next = at - normal.ldlt().solve(slope.transpose() * value);
    const bool better = residuals(next).squaredNorm() < value.squaredNorm();
    if (better) at = next;
    damping *= better ? 0.3 : 4.0;
    if (damping > 1e12) break;
  }
  return at;
}

// Odometry off by 14 % and a sensor of 0.2 mm: the first linearisation is off by hundreds of deviations. The
// mode is found to a fraction of the sensor's deviation.
// Mutations: one step alone; the chord's slope without the half turn.
TEST(FrameMode, ExplainsAFrameBest) {
  constexpr double kNear = 5e-5;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Frame frame = random_frame(seed, 0.14, 2e-4);
    const Eigen::VectorXd best = least_squares(Residuals(frame));
    const auto mode = frame_mode(frame.before, frame.motion, frame.seen);
    ASSERT_TRUE(mode) << seed;
    EXPECT_TRUE(near(mode->from, boxplus(frame.before.pose, best.head<3>()), kNear)) << seed;
    EXPECT_LT((mode->chord - frame.motion.mean - best.segment<3>(3)).norm(), kNear) << seed;
    for (std::size_t i = 0; i < frame.seen.size(); ++i) {
      const int j = frame.seen[i].landmark;
      const Eigen::Vector2d place =
          frame.before.landmarks[static_cast<std::size_t>(j)] + best.segment<2>(6 + 2 * j);
      EXPECT_LT((mode->landmarks[i] - place).norm(), kNear) << seed;
    }
  }
}

// Where all is nearly linear, a sighting's length is that of its innovation from a belief that has seen all
// others. Mutations: the marginal block of S in place of the inverse's; the residual in place of S^-1 v.
TEST(FrameMode, HoldsEachSightingAgainstAllOthers) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Frame frame = random_frame(seed, 1e-4, 0.01);
    const auto mode = frame_mode(frame.before, frame.motion, frame.seen);
    ASSERT_TRUE(mode);
    for (std::size_t left_out = 0; left_out < frame.seen.size(); ++left_out) {
      long repairs = 0;
      JointBelief belief = frame.before;
      const Pose robot = end_of(belief.pose, frame.motion.mean);
      const Eigen::Matrix3d by_chord = end_by_chord(belief.pose, frame.motion.mean);
      belief.covariance.move_pose(heading_lever(belief.pose, {robot.x_m, robot.y_m}),
                                  by_chord * frame.motion.covariance * by_chord.transpose());
      belief.pose = robot;
      for (std::size_t i = 0; i < frame.seen.size(); ++i) {
        if (i == left_out) continue;
        const auto& [landmark, observation] = frame.seen[i];
        correct(belief, landmark, innovation(belief, landmark, observation, repairs), repairs);
      }
      const auto& [landmark, observation] = frame.seen[left_out];
      const double length = innovation(belief, landmark, observation, repairs).squared_length();
      EXPECT_NEAR(mode->squared_lengths[left_out], length, 0.05 * length + 0.01);
    }
  }
}

// Mutation: frames are linearised anew however straight they are.
TEST(FrameMode, StaysAtThePredictionWhereAFrameIsNearlyLinear) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Frame frame = random_frame(seed, 1e-4, 0.01);
    const auto mode = frame_mode(frame.before, frame.motion, frame.seen);
    ASSERT_TRUE(mode);
    EXPECT_TRUE(near(mode->from, frame.before.pose, 0.0)) << seed;
    EXPECT_EQ(mode->chord, frame.motion.mean) << seed;
  }
}

// A pose that is certain and landmarks that are certain: the motion alone explains the frame.
TEST(FrameMode, NeedsNoInverseOfAPrior) {
  Frame frame = random_frame(3, 0.14, 2e-4);
  const Pose pose = frame.before.pose;
  const std::vector<Eigen::Vector2d> places = frame.before.landmarks;
  frame.before = {pose, {}, {}};
  long repairs = 0;
  for (int j = 0; j < 3; ++j)
    place(frame.before, j, {places[static_cast<std::size_t>(j)], Eigen::Matrix2d::Zero()}, repairs);
  const auto mode = frame_mode(frame.before, frame.motion, frame.seen);
  ASSERT_TRUE(mode);
  EXPECT_EQ(mode->from.x_m, pose.x_m);
  EXPECT_EQ(mode->landmarks[0], places[0]);
  const Pose robot = end_of(mode->from, mode->chord);
  EXPECT_LT(
      sighting_residual(predict_sighting(robot, places[0]), frame.seen[0].observation.range_bearing).norm(),
      1e-3);
}

TEST(FrameMode, OfNothingSeenIsThePrior) {
  const Frame frame = random_frame(4, 0.1, 1e-3);
  const auto mode = frame_mode(frame.before, frame.motion, {});
  ASSERT_TRUE(mode);
  EXPECT_TRUE(near(mode->from, frame.before.pose, 0.0));
  EXPECT_EQ(mode->chord, frame.motion.mean);
}

}  // namespace
}  // namespace stereobench::slam
