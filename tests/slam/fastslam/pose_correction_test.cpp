// What one particle makes of a frame: likelihood, gate, contradictions, and whose sighting it is.
#include "slam/fastslam/pose_correction.h"

#include <functional>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/models/chord.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

template <class Model>
class Corrections : public ::testing::Test {
 protected:
  FilterConfig config_;
  Particle particle_;
  PoseBelief predicted_{{0.0, 0.0, 0.3}, Eigen::Vector3d(4e-4, 1e-4, 1e-4).asDiagonal()};
  std::vector<Target> targets_;
  FilterCounters counters_;

  void know(const Eigen::Vector2d& place, std::uint16_t uses = 5) {
    particle_.known.push_back({{place, 1e-4 * Eigen::Matrix2d::Identity()}, {kUnknown, {uses, 0}}});
  }
  void know_well(const Eigen::Vector2d& place) {
    particle_.known.push_back({{place, 1e-6 * Eigen::Matrix2d::Identity()}, {kUnknown, {5, 0}}});
  }
  void change(std::size_t slot, const std::function<void(Landmark&)>& by) {
    Landmark landmark = particle_.known[slot];
    by(landmark);
    particle_.known.replace(slot, landmark);
  }
  void know_colour(const Eigen::Vector2d& place, int colour) {
    particle_.classed.push_back({{place, 1e-4 * Eigen::Matrix2d::Identity()}, {colour, {5, 0}}});
  }
  // What is seen of a place from the predicted pose, with an error in range and bearing.
  Sighting see(const Eigen::Vector2d& place, int slot,
               const Eigen::Vector2d& error = Eigen::Vector2d::Zero()) const {
    const Eigen::Vector2d exact = predict_sighting(predicted_.mean, place);
    return {{exact + error, Eigen::Vector2d(1e-4, 1e-4).asDiagonal()}, slot, kUnknown};
  }
  Sighting see_colour(const Eigen::Vector2d& place, int colour) const {
    Sighting seen = see(place, kUnknown);
    seen.colour_class = colour;
    return seen;
  }
  /// The pose before is the origin.
  Posterior correct(const std::vector<Sighting>& frame, Updates updates = Updates::kOneByOne) {
    targets_.assign(frame.size(), Target{});
    return PoseCorrection<Model>(config_, updates)
        .correct(particle_, predicted_, chord_of(predicted_), frame, targets_, counters_);
  }
};
using BothModels = ::testing::Types<Linearised, Unscented>;
TYPED_TEST_SUITE(Corrections, BothModels);

// The likelihood and posterior of a frame, from one joint Gaussian of all its sightings: another route to the
// same numbers. Errata: eq. 35 (no determinant) and Table 1 (weight overwritten by each landmark); public
// code takes the weight from the updated P. Each of these, moments not redrawn after the first landmark (eq.
// 24), and the first landmark's Jacobian used for all, shows here.
TYPED_TEST(Corrections, OneByOneIsTheSameAsAllAtOnce) {
  const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {2.0, -2.0}, {5.0, 4.0}};
  std::vector<Sighting> frame;
  for (std::size_t i = 0; i < places.size(); ++i) {
    this->know(places[i]);
    frame.push_back(this->see(places[i], static_cast<int>(i), {0.005 * static_cast<double>(i), -0.004}));
  }
  Eigen::Matrix<double, 6, 3> slope;
  Eigen::Matrix<double, 6, 6> joint = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> residual;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d& place = places[static_cast<std::size_t>(i)];
    const Observation& seen = frame[static_cast<std::size_t>(i)].observation;
    const double r = place.norm();
    Eigen::Matrix2d by_place;
    by_place << place.x() / r, place.y() / r, -place.y() / (r * r), place.x() / (r * r);
    slope.block<2, 3>(2 * i, 0) << -by_place, Eigen::Vector2d(0.0, -1.0);
    joint.block<2, 2>(2 * i, 2 * i) = 1e-4 * by_place * by_place.transpose() + seen.noise;
    residual.segment<2>(2 * i) =
        sighting_residual(seen.range_bearing, predict_sighting(this->predicted_.mean, place));
  }
  joint += slope * this->predicted_.covariance * slope.transpose();
  const double expected = -0.5 * (residual.dot(joint.ldlt().solve(residual)) + std::log(joint.determinant()) +
                                  6.0 * std::log(2.0 * M_PI));
  const Eigen::Matrix<double, 3, 6> gain = this->predicted_.covariance * slope.transpose() * joint.inverse();
  const Posterior posterior = this->correct(frame);
  EXPECT_NEAR(posterior.log_likelihood, expected, 0.05);
  EXPECT_TRUE(near(boxminus(posterior.pose.mean, this->predicted_.mean), gain * residual, 3e-4));
  const Eigen::Matrix3d covariance = this->predicted_.covariance - gain * slope * this->predicted_.covariance;
  EXPECT_TRUE(near(posterior.pose.covariance, covariance, 5e-6));
}

// Catches landmarks that are used in the order of the frame and not of their age.
TYPED_TEST(Corrections, OrderInTheFrameDoesNotMatter) {
  this->know({3.0, 1.0});
  this->know({-2.0, 4.0});
  const Sighting a = this->see({3.0, 1.0}, 0, {0.01, 0.005});
  const Sighting b = this->see({-2.0, 4.0}, 1, {-0.01, 0.01});
  const Posterior one = this->correct({a, b});
  const Posterior other = this->correct({b, a});
  EXPECT_TRUE(near(one.pose.mean, other.pose.mean, 1e-15));
  EXPECT_EQ(one.log_likelihood, other.log_likelihood);
}

// P = 0 and rank 2: catches a gain that needs the inverse of P.
TYPED_TEST(Corrections, SingularCovariancesAreNothingSpecial) {
  this->know({3.0, 1.0});
  for (const Eigen::Vector3d& variances : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e-4, 0, 1e-4)}) {
    this->predicted_.covariance = variances.asDiagonal();
    const Posterior posterior = this->correct({this->see({3.0, 1.0}, 0, {0.01, 0.0})});
    EXPECT_TRUE(std::isfinite(posterior.log_likelihood));
    EXPECT_EQ(this->targets_[0].outcome, Outcome::kUse);
    const bool moved = boxminus(posterior.pose.mean, this->predicted_.mean).norm() > 1e-6;
    EXPECT_EQ(moved, variances.sum() > 0.0);
  }
}

// Catches a refusal that is free, one that costs what the sighting would have, and a cost without the gate or
// without the determinant.
TYPED_TEST(Corrections, AnOutlierMovesNothingCostsTheGateAndIsCounted) {
  this->know({3.0, 1.0});
  const Posterior posterior = this->correct({this->see({3.0, 1.0}, 0, {1.0, 0.0})});
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kRefuse);
  EXPECT_TRUE(near(posterior.pose.mean, this->predicted_.mean, 0.0));
  EXPECT_EQ(this->counters_.gated_measurements, 1);
  long repairs = 0;
  const Observation seen = this->see({3.0, 1.0}, 0).observation;
  const PredictedMeasurement expected =
      TypeParam().expect(this->predicted_, this->particle_.known[0].belief, seen, repairs);
  EXPECT_NEAR(posterior.log_likelihood,
              std::log1p(-this->config_.gate_probability) -  // half the gate, by chi-square(2)
                  0.5 * std::log((2.0 * M_PI * expected.covariance).determinant()),
              1e-9);
  const Posterior farther = this->correct({this->see({3.0, 1.0}, 0, {2.0, 0.0})});
  EXPECT_NEAR(farther.log_likelihood, posterior.log_likelihood, 1e-9);  // no matter how far
}

// Seven deviations off: one landmark alone is refused, two that agree on a pose overrule the odometry, and
// two that do not agree are both refused. One by one all are. Mutations: each sighting tested against the
// motion alone; the worst one left out but its match kept; sightings that are used and still counted as
// refused.
TYPED_TEST(Corrections, OnlyLandmarksThatAgreeOverruleTheOdometry) {
  this->predicted_.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();
  const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {2.0, -2.0}};
  const Pose truth = boxplus(this->predicted_.mean, {0.0, 0.0, 0.07});
  std::vector<Sighting> frame;
  for (const Eigen::Vector2d& place : places) {
    const auto slot = static_cast<int>(frame.size());
    this->know_well(place);
    frame.push_back({{predict_sighting(truth, place), 1e-6 * Eigen::Matrix2d::Identity()}, slot, kUnknown});
  }
  this->correct({frame[0]}, Updates::kIterated);
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kRefuse);
  EXPECT_EQ(this->counters_.gated_measurements, 1);
  const Posterior slipped = this->correct(frame, Updates::kIterated);
  EXPECT_TRUE(near(slipped.pose.mean, truth, 5e-3));
  for (const Target& target : this->targets_) EXPECT_EQ(target.outcome, Outcome::kUse);
  EXPECT_EQ(this->counters_.gated_measurements, 1) << "a sighting that is used was not refused";
  EXPECT_TRUE(near(this->correct(frame).pose.mean, this->predicted_.mean, 0.0)) << "one by one";
  EXPECT_EQ(this->counters_.gated_measurements, 3);
  frame[1].observation.range_bearing.y() -= 0.14;
  EXPECT_TRUE(near(this->correct(frame, Updates::kIterated).pose.mean, this->predicted_.mean, 0.0));
  for (const Target& target : this->targets_) EXPECT_EQ(target.outcome, Outcome::kRefuse);
}

// Three landmarks, one of which was seen half a metre too far: the other two correct the pose, to the last
// bit as if they alone had been seen. The outlier costs the likelihood at the gate. Mutations: the first
// sighting left out in place of the worst; an outlier that is used in the end; one that costs nothing; a
// fit that is repeated and not counted.
TYPED_TEST(Corrections, AnOutlierIsLeftOutOfTheFit) {
  const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {2.0, -2.0}, {4.0, 0.5}};
  std::vector<Sighting> frame;
  for (std::size_t i = 0; i < places.size(); ++i) {
    this->know_well(places[i]);
    frame.push_back(this->see(places[i], static_cast<int>(i), {0.004, -0.003}));
  }
  const Posterior without = this->correct({frame[0], frame[2]}, Updates::kIterated);
  frame[1].observation.range_bearing.x() += 0.5;
  const Posterior with = this->correct(frame, Updates::kIterated);
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kUse);
  EXPECT_EQ(this->targets_[1].outcome, Outcome::kRefuse);
  EXPECT_EQ(this->targets_[2].outcome, Outcome::kUse);
  EXPECT_EQ(this->counters_.refitted_frames, 1);
  EXPECT_EQ(boxminus(with.pose.mean, without.pose.mean).norm(), 0.0);
  EXPECT_EQ((with.pose.covariance - without.pose.covariance).norm(), 0.0);
  long repairs = 0;
  const PredictedMeasurement expected =
      TypeParam().expect(without.pose, this->particle_.known[1].belief, frame[1].observation, repairs);
  EXPECT_NEAR(with.log_likelihood - without.log_likelihood,
              std::log1p(-this->config_.gate_probability) -
                  0.5 * std::log((2.0 * M_PI * expected.covariance).determinant()),
              1e-9);
}

// A landmark that is contradicted for the fifth time, beside two that fit. Where it is the oldest, nothing
// older speaks for the pose, and the pose has drifted; where it is the youngest, it is found anew. Mutation:
// any landmark of the fit speaks for the pose.
TYPED_TEST(Corrections, OnlyOlderLandmarksSpeakForThePose) {
  const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {2.0, -2.0}, {4.0, 0.5}};
  for (const Eigen::Vector2d& place : places) this->know_well(place);
  for (const std::size_t contradicted : {0U, 2U}) {
    std::vector<Sighting> frame;
    for (std::size_t i = 0; i < places.size(); ++i) {
      this->change(i, [&](Landmark& known) { known.status.record.refusals = i == contradicted ? 4 : 0; });
      frame.push_back(this->see(places[i], static_cast<int>(i), {i == contradicted ? 0.5 : 0.0, 0.0}));
    }
    const Posterior posterior = this->correct(frame, Updates::kIterated);
    EXPECT_EQ(this->targets_[contradicted].outcome, contradicted == 0 ? Outcome::kUse : Outcome::kMove);
    EXPECT_EQ(posterior.relocalised, contradicted == 0);
  }
}

// What is new says nothing of the motion, which is drawn along its chord all the same. Mutation: the pose
// drawn from x, y and heading where nothing is fitted.
TYPED_TEST(Corrections, AFrameOfNewLandmarksLeavesTheMotion) {
  const Posterior posterior = this->correct({this->see({3.0, 1.0}, 0)}, Updates::kIterated);
  ASSERT_TRUE(posterior.motion.has_value());
  EXPECT_EQ(posterior.motion->mean, chord_of(this->predicted_).mean);
  EXPECT_EQ(posterior.motion->covariance, chord_of(this->predicted_).covariance);
  EXPECT_FALSE(this->correct({this->see({3.0, 1.0}, 0)}).motion.has_value());
}

// A map of a thousand landmarks, searched through its bounds, and the same search done one by one. Catches a
// search that is narrower than the gate.
TYPED_TEST(Corrections, TheSearchOfALargeMapMissesNothing) {
  this->config_.association = Association::kIndividual;
  RandomStream random(5, Stream::kWorld);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d place(20.0 * random.uniform(), 20.0 * random.uniform());
    const double sd_m = 0.3 * random.uniform();
    this->particle_.classed.push_back({{place, sd_m * sd_m * Eigen::Matrix2d::Identity()}, i % 3, 5, 0});
  }
  int found = 0;
  for (int look = 0; look < 300; ++look) {
    const double sd_rad = 0.5 * random.uniform();
    const Pose mean{20.0 * random.uniform(), 20.0 * random.uniform(), 6.0 * random.uniform()};
    this->predicted_ = {mean, Eigen::Vector3d(0.01, 0.02, sd_rad * sd_rad).asDiagonal()};
    const Eigen::Vector2d seen(8.0 * random.uniform(), wrap_angle(6.0 * random.uniform()));
    const Sighting sighting{{seen, Eigen::Vector2d(0.01, 0.01).asDiagonal()}, kUnknown, look % 3};
    Target expected;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < 1000; ++j) {
      const Landmark& landmark = this->particle_.classed[j];
      long repairs = 0;
      const PredictedMeasurement innovation =
          TypeParam().expect(this->predicted_, landmark.belief, sighting.observation, repairs);
      const Eigen::Vector2d off = sighting_residual(seen, innovation.expected);
      const double squared = off.dot(innovation.covariance.inverse() * off);
      const double cost = squared + std::log(innovation.covariance.determinant());
      if (landmark.status.colour_class != sighting.colour_class || !(squared <= 18.4206807439524) ||
          cost >= least)
        continue;
      least = cost;
      expected = {Outcome::kUse, static_cast<int>(j)};
    }
    this->correct({sighting});
    ASSERT_EQ(this->targets_[0].landmark, expected.landmark) << look;
    found += expected.landmark >= 0 ? 1 : 0;
  }
  EXPECT_GT(found, 150);
}

TYPED_TEST(Corrections, AGateOfOneRefusesNothing) {
  this->config_.gate_probability = 1.0;
  this->know({3.0, 1.0});
  this->correct({this->see({3.0, 1.0}, 0, {1.0, 0.0})});
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kUse);
}

// A landmark that is contradicted again and again: who is wrong depends on who else was seen.
TYPED_TEST(Corrections, APersistentContradictionMovesTheLandmarkWhenThePoseIsVouchedFor) {
  this->know({3.0, 1.0});
  this->know({3.0, -1.0});
  this->change(1, [](Landmark& landmark) { landmark.status.record.refusals = 10; });
  this->correct({this->see({3.0, 1.0}, 0), this->see({3.0, -1.0}, 1, {1.0, 0.0})});
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kUse);
  EXPECT_EQ(this->targets_[1].outcome, Outcome::kMove);
}

TYPED_TEST(Corrections, APersistentContradictionPullsThePoseWhenTheLandmarkIsConfirmed) {
  this->know({3.0, 1.0});
  this->change(0, [](Landmark& landmark) { landmark.status.record.refusals = 10; });
  const Posterior relocalised = this->correct({this->see({3.0, 1.0}, 0, {1.0, 0.0})});
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kUse);
  EXPECT_GT(boxminus(relocalised.pose.mean, this->predicted_.mean).norm(), 0.5);
  this->change(0, [](Landmark& landmark) { landmark.status.record.uses = 1; });
  this->correct({this->see({3.0, 1.0}, 0, {1.0, 0.0})});
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kMove);
}

TYPED_TEST(Corrections, AColourIsMatchedToTheLikeliestLandmarkOfThatColour) {
  this->know_colour({3.0, 1.0}, 4);
  this->know_colour({3.1, 1.0}, 5);
  this->know_colour({9.0, 1.0}, 4);
  this->correct(
      {this->see_colour({3.02, 1.0}, 4), this->see_colour({9.0, 1.0}, 4), this->see_colour({3.02, 1.0}, 6)});
  EXPECT_EQ(this->targets_[0].landmark, 0);
  EXPECT_EQ(this->targets_[1].landmark, 2);
  EXPECT_EQ(this->targets_[2].outcome, Outcome::kAdd);
}

// Mutual exclusion. Catches two sightings of one frame that take the same landmark.
TYPED_TEST(Corrections, ALandmarkIsSeenOnceInAFrame) {
  this->know_colour({3.0, 1.0}, 4);
  const std::vector<Sighting> twins = {this->see_colour({3.03, 1.0}, 4), this->see_colour({3.0, 1.0}, 4)};
  this->correct(twins);
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kAdd);  // nothing is known of spacing: there may be two
  EXPECT_EQ(this->targets_[1].landmark, 0);
  this->config_.colour_spacing_m = 10.0;
  this->correct(twins);
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kIgnore);
  EXPECT_EQ(this->targets_[1].landmark, 0);
}

// The end of a loop: the drift is a hundred times what the filter believes of it.
TYPED_TEST(Corrections, WithinHalfTheColourSpacingItIsTheSameLandmark) {
  this->know_colour({3.0, 1.0}, 4);
  const std::vector<Sighting> off = {this->see_colour({3.0, 2.0}, 4)};
  this->correct(off);
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kAdd);
  this->config_.colour_spacing_m = 10.0;
  const Posterior relocalised = this->correct(off);
  EXPECT_EQ(this->targets_[0].landmark, 0);
  const Eigen::Vector2d place = locate(relocalised.pose.mean, off[0].observation.range_bearing);
  EXPECT_LT((place - Eigen::Vector2d(3.0, 1.0)).norm(), 0.5) << "pulled back by more than half";
  const Posterior nearer = this->correct({this->see_colour({3.0, 1.4}, 4)});
  EXPECT_GT(nearer.log_likelihood, relocalised.log_likelihood) << "less drift, more weight";
  this->correct({this->see_colour({3.0, 7.0}, 4)});
  EXPECT_EQ(this->targets_[0].outcome, Outcome::kAdd);
}

}  // namespace
}  // namespace stereobench::slam
