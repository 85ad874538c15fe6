// What a frame says of a motion, as a whole: mode, spread, likelihood, and what speaks against it.
#include "slam/fastslam/frame_fit.h"

#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/math/gaussian.h"
#include "slam/math/random.h"
#include "slam/models/measurement.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

const Eigen::Matrix2d kPrecise = Eigen::Vector2d(1e-3 * 1e-3, 2e-4 * 2e-4).asDiagonal();
const std::vector<Eigen::Vector2d> kPlaces = {{1.5, 0.4}, {2.2, -0.7}, {0.9, -0.3}};

/// A frame of three landmarks, well known, from `truth`.
std::vector<Match> frame_from(const Pose& truth, const Eigen::Matrix2d& noise) {
  std::vector<Match> matches;
  for (const Eigen::Vector2d& place : kPlaces)
    matches.push_back({{place, Eigen::Matrix2d::Identity() * 1e-8}, {predict_sighting(truth, place), noise}});
  return matches;
}

template <class Model>
class FrameFits : public ::testing::Test {
 protected:
  const Model model_{UnscentedParameters{}};
  long repairs_ = 0;

  FrameFit fit(const ChordBelief& motion, const std::vector<Match>& matches) {
    return fit_frame(model_, {}, motion, matches, repairs_);
  }
};
using Models = ::testing::Types<Linearised, Unscented>;
TYPED_TEST_SUITE(FrameFits, Models);

/// Sightings of a linear sensor: errors so small that nothing bends.
struct LinearFrame {
  ChordBelief motion{{0.1, 0.0, 0.3}, Eigen::Vector3d(1e-8, 2e-8, 1e-8).asDiagonal()};
  std::vector<Match> matches;
  Eigen::MatrixXd slope = Eigen::MatrixXd(6, 3);             ///< by the chord
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6, 6);  ///< of all innovations together
  Eigen::VectorXd innovation = Eigen::VectorXd(6);

  explicit LinearFrame(std::uint64_t seed) {
    RandomStream random(seed, Stream::kFilter);
    const Pose predicted = end_of({}, motion.mean);
    matches = frame_from(predicted, Eigen::Vector2d(1e-8, 2e-8).asDiagonal());
    for (int i = 0; i < 3; ++i) {
      Match& match = matches[static_cast<std::size_t>(i)];
      const LinearSighting linear = linearise_sighting(predicted, match.landmark.mean);
      innovation.segment<2>(2 * i) = 1e-4 * Eigen::Vector2d(random.normal(), random.normal());
      match.observation.range_bearing += innovation.segment<2>(2 * i);
      slope.block<2, 3>(2 * i, 0) = linear.by_pose() * end_by_chord({}, motion.mean);
      covariance.block<2, 2>(2 * i, 2 * i) = match.observation.noise + linear.by_landmark *
                                                                           match.landmark.covariance *
                                                                           linear.by_landmark.transpose();
    }
    covariance += slope * motion.covariance * slope.transpose();
  }
};

// One joint Gaussian of all innovations: another route to the same numbers. Mutations: the determinant of the
// information left out, the prior's cost counted twice, noise that the mode does not share.
TYPED_TEST(FrameFits, IsTheConditionedGaussianWhereTheSensorIsLinear) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const LinearFrame frame(seed);
    const FrameFit fit = this->fit(frame.motion, frame.matches);
    const Eigen::MatrixXd gain =
        frame.motion.covariance * frame.slope.transpose() * frame.covariance.inverse();
    EXPECT_TRUE(near(fit.motion.mean, frame.motion.mean + gain * frame.innovation, 3e-7));
    EXPECT_TRUE(near(fit.motion.covariance,
                     (Eigen::Matrix3d::Identity() - gain * frame.slope) * frame.motion.covariance, 1e-11));
    const double log_likelihood =
        -0.5 * (frame.innovation.dot(frame.covariance.inverse() * frame.innovation) +
                std::log((2.0 * M_PI * frame.covariance).determinant()));
    EXPECT_NEAR(fit.log_likelihood, log_likelihood, 0.02);
    double in_turn = 0.0;
    for (const ExpectedSighting& expected : expected_in_turn(fit)) in_turn += expected.log_likelihood;
    EXPECT_NEAR(in_turn, log_likelihood, 0.02);
  }
  EXPECT_EQ(this->repairs_, 0);
}

// The innovation of one sighting, given the other two, by conditioning the joint Gaussian. Mutations: the
// covariance of what is left not reduced by the mode's; that of the innovation with the sighting itself.
TYPED_TEST(FrameFits, EachSightingIsHeldAgainstTheOthers) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const LinearFrame frame(seed);
    const FrameFit fit = this->fit(frame.motion, frame.matches);
    const Eigen::MatrixXd inverse = frame.covariance.inverse();
    const Eigen::VectorXd solved = inverse * frame.innovation;
    for (int i = 0; i < 3; ++i) {
      // [S^-1]_ii is the inverse of S_ii given the rest, and (S^-1 v)_i that times v_i given the rest.
      const Eigen::Vector2d mine = solved.segment<2>(2 * i);
      const double expected = mine.dot(inverse.block<2, 2>(2 * i, 2 * i).inverse() * mine);
      EXPECT_NEAR(squared_length_without(fit, static_cast<std::size_t>(i)), expected,
                  0.01 * (1.0 + expected));
    }
  }
}

// A way of 0.35 m with a turn of 0.35 rad, both off by 14 % and more. Mutations: a single step, slopes kept
// from the prediction, and the pose's error taken along x, y and heading in place of the chord.
TYPED_TEST(FrameFits, FindsAMotionThatBendsAway) {
  const ChordBelief motion{{0.35, 0.0, 0.35}, Eigen::Vector3d(2.5e-3, 1e-12, 2.5e-3).asDiagonal()};
  const Eigen::Vector3d truth(0.43, 0.0, 0.23);
  const FrameFit fit = this->fit(motion, frame_from(end_of({}, truth), kPrecise));
  EXPECT_TRUE(near(fit.motion.mean, truth, 2e-4));
  EXPECT_NEAR(fit.u.squaredNorm(), (0.08 * 0.08 + 0.12 * 0.12) / 2.5e-3, 0.1);
  for (const LinearMatch& match : fit.matches) EXPECT_LE(match.residual.norm(), 2e-4);
  EXPECT_LE(fit.motion.covariance(1, 1), 1.0001e-12) << "a control moves nothing across its chord";
}

// One landmark, seen a thousand times as precisely as the odometry foresees: what is off is the odometry, and
// no sighting is refused that the model itself drew. Mutation: the fit left where the last step would save
// little.
TYPED_TEST(FrameFits, APreciseSightingIsHeldAgainstTheOdometryAlone) {
  const ChordBelief motion{{0.35, 0.0, 0.35}, Eigen::Vector3d(1.2e-3, 1e-11, 1.2e-3).asDiagonal()};
  const Eigen::Matrix2d noise = Eigen::Vector2d(5e-5 * 5e-5, 2.5e-6 * 2.5e-6).asDiagonal();
  RandomStream random(11, Stream::kFilter);
  double sum = 0.0;
  constexpr int kDraws = 400;
  for (int i = 0; i < kDraws; ++i) {
    Eigen::Vector3d truth = motion.mean;
    truth.x() += 0.035 * random.normal();
    truth.z() += 0.035 * random.normal();
    Match match{{{1.5, 0.4}, 1e-10 * Eigen::Matrix2d::Identity()}, {{}, noise}};
    const Eigen::Vector2d place =
        match.landmark.mean + 1e-5 * Eigen::Vector2d(random.normal(), random.normal());
    match.observation.range_bearing = predict_sighting(end_of({}, truth), place) +
                                      Eigen::Vector2d(5e-5 * random.normal(), 2.5e-6 * random.normal());
    const double squared_length = squared_length_without(this->fit(motion, {match}), 0);
    EXPECT_LT(squared_length, chi_square_2_quantile(0.999999));
    sum += squared_length;
  }
  EXPECT_NEAR(sum / kDraws, 2.0, 5.0 * 2.0 / std::sqrt(kDraws));  // chi-square(2): mean 2, deviation 2
}

TYPED_TEST(FrameFits, AMotionThatIsKnownStaysWhatItIs) {
  const ChordBelief known{{1.0, 0.0, 0.2}, Eigen::Matrix3d::Zero()};
  const FrameFit fit = this->fit(known, frame_from(end_of({}, {1.1, 0.0, 0.2}), kPrecise));
  EXPECT_EQ((fit.motion.mean - known.mean).norm(), 0.0);
  EXPECT_EQ(fit.motion.covariance.norm(), 0.0);
  EXPECT_GT(squared_length_without(fit, 0), 100.0);
}

// Nothing seen: the prior, whose likelihood is one.
TYPED_TEST(FrameFits, OfNothingIsThePrior) {
  const ChordBelief motion{{1.0, 0.0, 0.2}, Eigen::Vector3d(0.01, 0.0, 0.02).asDiagonal()};
  const FrameFit fit = this->fit(motion, {});
  EXPECT_TRUE(near(fit.motion.covariance, motion.covariance, 1e-16));
  EXPECT_EQ(fit.log_likelihood, 0.0);
}

/// Moments of the posterior of (along, turn), and the log of its norm, by sums over a grid.
struct ByGrid {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double log_likelihood = 0.0;
};

ByGrid by_grid(const ChordBelief& motion, const Match& match) {
  constexpr int kHalf = 150;
  constexpr double kReach = 6.0;
  double sum = 0.0;
  ByGrid result;
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      const Eigen::Vector2d u(kReach * i / kHalf, kReach * j / kHalf);
      const Eigen::Vector3d chord =
          motion.mean + Eigen::Vector3d(std::sqrt(motion.covariance(0, 0)) * u.x(), 0.0,
                                        std::sqrt(motion.covariance(2, 2)) * u.y());
      const Eigen::Vector2d off = sighting_residual(match.observation.range_bearing,
                                                    predict_sighting(end_of({}, chord), match.landmark.mean));
      const Eigen::Matrix2d& noise = match.observation.noise;
      const double density = std::exp(-0.5 * (u.squaredNorm() + off.dot(noise.inverse() * off))) /
                             (2.0 * M_PI * std::sqrt((2.0 * M_PI * noise).determinant()));
      const double cell = (kReach / kHalf) * (kReach / kHalf);
      sum += density * cell;
      result.mean += density * cell * Eigen::Vector2d(chord.x(), chord.z());
    }
  }
  result.mean /= sum;
  result.log_likelihood = std::log(sum);
  return result;
}

// A landmark so near that its bearing bends over what the frame leaves of the way. Lines through sigma points
// come nearer to the true mean than the mode does. Mutations: no wider look; points of the prior in place of
// those around the mode; the spread about the line left out of the noise (its likelihood is off).
TEST(FrameFit, SigmaPointsComeNearerToTheMeanThanTheModeDoes) {
  const ChordBelief motion{{0.5, 0.0, 0.0}, Eigen::Vector3d(0.04, 0.0, 1e-4).asDiagonal()};
  const Match match{
      {{0.8, 0.25}, Eigen::Matrix2d::Zero()},
      {predict_sighting({0.6, 0.0, 0.0}, {0.8, 0.25}), Eigen::Vector2d(0.04, 0.06).asDiagonal()}};
  const ByGrid exact = by_grid(motion, match);
  long repairs = 0;
  const std::vector<Match> matches{match};
  const FrameFit mode = fit_frame(Linearised(), {}, motion, matches, repairs);
  const FrameFit wide = fit_frame(Unscented(), {}, motion, matches, repairs);
  const auto off = [&](const FrameFit& fit) { return std::abs(fit.motion.mean.x() - exact.mean.x()); };
  EXPECT_LE(off(wide), 0.75 * off(mode));
  EXPECT_NEAR(wide.log_likelihood, exact.log_likelihood, 0.1);
}

}  // namespace
}  // namespace stereobench::slam
