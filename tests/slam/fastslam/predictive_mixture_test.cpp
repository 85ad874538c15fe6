// The mixture of what particles expect, against closed forms.
#include "slam/fastslam/predictive_mixture.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/fastslam/pose_correction.h"
#include "slam/models/measurement.h"

namespace stereobench::slam {
namespace {

const Eigen::Matrix2d kS{{0.04, 0.003}, {0.003, 0.01}};

// Particles that see landmark 0, 1, ... at the sightings of a frame.
struct Mixture {
  std::vector<Sighting> frame;
  std::vector<Target> targets;
  std::vector<ExpectedSighting> expected;
  std::vector<double> log_weights;

  explicit Mixture(const std::vector<Eigen::Vector2d>& seen) {
    for (std::size_t k = 0; k < seen.size(); ++k)
      frame.push_back({{seen[k], Eigen::Matrix2d::Identity()},
                       static_cast<int>(k),
                       kUnknown,
                       static_cast<int>(k),
                       static_cast<int>(k)});
  }
  void add_particle(double weight, const std::vector<ExpectedSighting>& by_sighting) {
    log_weights.push_back(std::log(weight));
    for (std::size_t k = 0; k < by_sighting.size(); ++k) {
      expected.push_back(by_sighting[k]);
      targets.push_back(by_sighting[k].exists ? Target{Outcome::kUse, static_cast<int>(k)} : Target{});
    }
  }
  std::vector<NormalisedInnovation> innovations() const {
    return normalised_innovations(frame, targets, expected, log_weights);
  }
};

double squared_length(const Eigen::Vector2d& off, const Eigen::Matrix2d& s) {
  return off.dot(s.inverse() * off);
}

TEST(PredictiveMixture, OfOneParticleIsThatParticles) {
  const Eigen::Vector2d off(0.3, -0.05);
  Mixture one({Eigen::Vector2d(5.0, 1.0) + off});
  one.add_particle(1.0, {{true, {5.0, 1.0}, kS}});
  ASSERT_EQ(one.innovations().size(), 1u);
  EXPECT_NEAR(one.innovations()[0].squared_length, squared_length(off, kS), 1e-12);
  Mixture copies(std::vector<Eigen::Vector2d>{Eigen::Vector2d(5.0, 1.0) + off});
  for (const double weight : {0.5, 0.3, 0.2}) copies.add_particle(weight, {{true, {5.0, 1.0}, kS}});
  EXPECT_NEAR(copies.innovations().at(0).squared_length, squared_length(off, kS), 1e-12);
}

// Mean and covariance of a mixture, by their definitions. Mutations: the spread of the means left out; equal
// weights.
TEST(PredictiveMixture, HasTheMomentsOfAllParticles) {
  const Eigen::Vector2d a(5.0, 1.0), b(5.5, 0.8), seen(5.3, 1.1);
  Mixture mixture({seen});
  mixture.add_particle(0.8, {{true, a, kS}});
  mixture.add_particle(0.2, {{true, b, 2.0 * kS}});
  const Eigen::Vector2d mean = 0.8 * a + 0.2 * b;
  const Eigen::Matrix2d s = 0.8 * (kS + (a - mean) * (a - mean).transpose()) +
                            0.2 * (2.0 * kS + (b - mean) * (b - mean).transpose());
  EXPECT_NEAR(mixture.innovations().at(0).squared_length, squared_length(seen - mean, s), 1e-12);
}

// Mutation: bearings averaged as numbers, which puts the mean ahead of the robot.
TEST(PredictiveMixture, BearingsAreAveragedAroundTheCircle) {
  Mixture mixture({{5.0, M_PI - 0.01}});
  mixture.add_particle(0.5, {{true, {5.0, M_PI - 0.02}, kS}});
  mixture.add_particle(0.5, {{true, {5.0, -M_PI + 0.02}, kS}});
  Eigen::Matrix2d s = kS;
  s(1, 1) += 0.02 * 0.02;
  EXPECT_NEAR(mixture.innovations().at(0).squared_length, squared_length({0.0, -0.01}, s), 1e-9);
}

// The first sighting rules one particle out, so that the second is held against the other's expectation.
// Mutations: the weights of before the frame for all sightings; the second sighting's likelihood for its own.
TEST(PredictiveMixture, WeighsByTheSightingsBefore) {
  Mixture mixture({{5.0, 1.0}, {3.0, 0.0}});
  mixture.add_particle(0.5, {{true, {5.0, 1.0}, kS, 0.0}, {true, {3.1, 0.0}, kS, -80.0}});
  mixture.add_particle(0.5, {{true, {7.0, 1.0}, kS, -60.0}, {true, {4.0, 0.0}, kS, 0.0}});
  const auto both = mixture.innovations();
  ASSERT_EQ(both.size(), 2u);
  EXPECT_LT(both[0].squared_length, 2.0);  // two particles, wide apart
  EXPECT_NEAR(both[1].squared_length, squared_length({-0.1, 0.0}, kS), 1e-9);
}

// Oldest landmarks first, whatever the order in the frame. Mutation: the frame's order.
TEST(PredictiveMixture, GoesByTheAgeOfTheLandmarks) {
  Mixture mixture({{5.0, 1.0}, {3.0, 0.0}});
  mixture.add_particle(1.0, {{true, {5.0, 1.0}, kS}, {true, {3.0, 0.0}, kS}});
  mixture.targets[0].landmark = 4;
  mixture.targets[1].landmark = 2;
  const auto both = mixture.innovations();
  EXPECT_EQ(both.at(0).sighting, 1);
  EXPECT_EQ(both.at(1).sighting, 0);
}

// Mutation: counting what particles without the landmark expect as a sighting at the origin.
TEST(PredictiveMixture, LeavesOutParticlesThatExpectNothing) {
  Mixture mixture({{5.1, 1.0}});
  mixture.add_particle(0.4, {{}});
  mixture.add_particle(0.6, {{true, {5.0, 1.0}, kS}});
  EXPECT_NEAR(mixture.innovations().at(0).squared_length, squared_length({0.1, 0.0}, kS), 1e-12);
  mixture.log_weights = {std::log(0.6), std::log(0.4)};
  EXPECT_TRUE(mixture.innovations().empty());  // most take it for a new landmark
}

TEST(PredictiveMixture, IsRefusedByHalfOfTheWeight) {
  Mixture mixture({{5.0, 1.0}});
  mixture.add_particle(0.4, {{true, {5.0, 1.0}, kS}});
  mixture.add_particle(0.6, {{true, {5.0, 1.0}, kS}});
  mixture.targets[0].outcome = Outcome::kRefuse;
  EXPECT_FALSE(mixture.innovations().at(0).refused);
  mixture.targets = {{Outcome::kUse, 0}, {Outcome::kMove, 0}};
  EXPECT_TRUE(mixture.innovations().at(0).refused);
}

// What a frame is worth to a particle is what its sightings are, one by one. Mutation: the sum so far in
// place of each.
TEST(PredictiveMixture, SightingsAreWorthWhatTheFrameIs) {
  PoseCorrection<Linearised> correction({.report_updates = true});
  Particle particle;
  std::vector<Sighting> frame;
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(3.0, 1.0), Eigen::Vector2d(2.0, -2.0)}) {
    particle.known.push_back({{place, 1e-2 * Eigen::Matrix2d::Identity()}});
    frame.push_back(
        {{predict_sighting({}, place) + Eigen::Vector2d(0.05, 0.02), 1e-2 * Eigen::Matrix2d::Identity()},
         static_cast<int>(frame.size())});
  }
  std::vector<Target> targets(frame.size());
  FilterCounters counters;
  const PoseBelief predicted{{}, 1e-3 * Eigen::Matrix3d::Identity()};
  const Posterior posterior =
      correction.correct(particle, predicted, chord_of(predicted), frame, targets, counters);
  double sum = 0.0;
  for (const ExpectedSighting& one : correction.expected()) sum += one.log_likelihood;
  EXPECT_NEAR(sum, posterior.log_likelihood, 1e-12);
}

TEST(PredictiveMixture, WeightsThatVanishAreNoNumbersInTheReport) {
  Mixture mixture({{5.0, 1.0}, {3.0, 0.0}});
  const double nan = std::nan("");
  mixture.add_particle(0.5, {{true, {5.0, 1.0}, kS, nan}, {true, {3.0, 0.0}, kS}});
  mixture.add_particle(0.5, {{true, {5.0, 1.0}, kS, -5000.0}, {true, {3.1, 0.0}, kS}});
  const auto both = mixture.innovations();
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[1].squared_length, squared_length({-0.1, 0.0}, kS), 1e-9);
  mixture.expected[2].log_likelihood = nan;  // no particle is left
  EXPECT_EQ(mixture.innovations().size(), 1u);
}

}  // namespace
}  // namespace stereobench::slam
