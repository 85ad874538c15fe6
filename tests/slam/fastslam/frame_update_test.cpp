// A whole frame in one update, against the joint Gaussian of all its sightings written out.
#include "slam/fastslam/frame_update.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/fastslam/pose_correction.h"
#include "slam/models/linearised.h"
#include "slam/models/unscented.h"
#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

// A frame of landmarks around the robot, seen from near a predicted pose.
struct Scene {
  PoseBelief predicted{{0.2, -0.1, 0.3}, Eigen::Matrix3d::Zero()};
  std::vector<LandmarkBelief> landmarks;
  std::vector<Observation> seen;

  // rank: of the pose's covariance
  Scene(std::uint64_t seed, int count, int rank, double scale = 1.0) {
    RandomStream random(seed, Stream::kWorld);
    for (int column = 0; column < rank; ++column) {
      const Eigen::Vector3d way =
          scale * Eigen::Vector3d(0.1 * random.normal(), 0.1 * random.normal(), 0.05 * random.normal());
      predicted.covariance += way * way.transpose();
    }
    for (int i = 0; i < count; ++i) {
      const double direction_rad = 6.28 * random.uniform();
      const double range_m = 1.0 + 4.0 * random.uniform();
      Eigen::Matrix2d root;
      root << 0.1 * random.normal(), 0.0, 0.05 * random.normal(), 0.1 * random.normal();
      const Eigen::Vector2d place(range_m * std::cos(direction_rad), range_m * std::sin(direction_rad));
      landmarks.push_back({place, scale * scale * root * root.transpose()});
      const Eigen::Vector2d off = scale * Eigen::Vector2d(0.1 * random.normal(), 0.03 * random.normal());
      seen.push_back({predict_sighting(predicted.mean, place) + off,
                      scale * scale * Eigen::Vector2d(0.01, 0.0016).asDiagonal().toDenseMatrix()});
    }
  }

  template <class Model>
  Posterior at_once() const {
    long repairs = 0;
    std::vector<Expectation> frame;
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const PredictedMeasurement expected = Model().expect(predicted, landmarks[i], seen[i], repairs);
      frame.push_back({expected, sighting_residual(seen[i].range_bearing, expected.expected)});
    }
    const Posterior posterior = correct_at_once(predicted, frame, repairs);
    EXPECT_EQ(repairs, 0);
    return posterior;
  }
};

// P - P H' S^-1 H P and N(residuals; 0, S), S of all sightings with the pose as what they have in common.
// Mutations: the determinant of the information left out; evidence counted twice in the cost; a root that is
// divided by without its scale (metres and radians); landmarks of a frame on the same sigma columns, as
// published (W_i' W_j plus what their own uncertainties would have in common).
TEST(CorrectAtOnce, IsTheJointGaussianOfTheFrame) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const int count = 1 + static_cast<int>(seed % 6);
    const Scene scene(seed, count, static_cast<int>(seed % 5));
    const Eigen::Matrix3d& p = scene.predicted.covariance;
    Eigen::MatrixXd slope(2 * count, 3);
    Eigen::MatrixXd s = Eigen::MatrixXd::Zero(2 * count, 2 * count);
    Eigen::VectorXd residual(2 * count);
    for (int i = 0; i < count; ++i) {
      const LandmarkBelief& landmark = scene.landmarks[static_cast<std::size_t>(i)];
      const Observation& seen = scene.seen[static_cast<std::size_t>(i)];
      const Eigen::Vector2d arm =
          landmark.mean - Eigen::Vector2d(scene.predicted.mean.x_m, scene.predicted.mean.y_m);
      const double r = arm.norm();
      Eigen::Matrix2d by_place;
      by_place << arm.x() / r, arm.y() / r, -arm.y() / (r * r), arm.x() / (r * r);
      slope.block<2, 3>(2 * i, 0) << -by_place, Eigen::Vector2d(0.0, -1.0);
      s.block<2, 2>(2 * i, 2 * i) = by_place * landmark.covariance * by_place.transpose() + seen.noise;
      residual.segment<2>(2 * i) =
          sighting_residual(seen.range_bearing, predict_sighting(scene.predicted.mean, landmark.mean));
    }
    s += slope * p * slope.transpose();
    const Eigen::MatrixXd gain = p * slope.transpose() * s.inverse();
    const double likelihood =
        -0.5 * (residual.dot(s.inverse() * residual) + std::log((2.0 * M_PI * s).determinant()));
    const Posterior posterior = scene.at_once<Linearised>();
    EXPECT_TRUE(near(boxminus(posterior.pose.mean, scene.predicted.mean), gain * residual, 1e-10));
    EXPECT_TRUE(near(posterior.pose.covariance, p - gain * slope * p, 1e-12));
    EXPECT_NEAR(posterior.log_likelihood, likelihood, 1e-8);
  }
}

// Mutations: as above, where sigma points are used.
TEST(CorrectAtOnce, IsTheSameForBothModelsWhenNoiseIsSmall) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Scene scene(seed, 4, 3, 1e-3);
    const Posterior a = scene.at_once<Linearised>(), b = scene.at_once<Unscented>();
    EXPECT_TRUE(near(a.pose.mean, b.pose.mean, 1e-6));
    EXPECT_TRUE(near(a.pose.covariance, b.pose.covariance, 1e-3 * a.pose.covariance.norm()));
    EXPECT_NEAR(a.log_likelihood, b.log_likelihood, 0.02);
  }
}

// What becomes of a frame, with both ways of using it.
struct Corrected {
  Posterior posterior;
  std::vector<Target> targets;
  FilterCounters counters;

  Corrected(const Scene& scene, Updates updates) : targets(scene.seen.size()) {
    Particle particle;
    std::vector<Sighting> frame;
    for (std::size_t i = 0; i < scene.seen.size(); ++i) {
      particle.known.push_back({scene.landmarks[i], kUnknown, 5, 0});
      frame.push_back({scene.seen[i], static_cast<int>(i), kUnknown});
    }
    posterior = PoseCorrection<Unscented>({}, updates)
                    .correct(particle, scene.predicted, chord_of(scene.predicted), frame, targets, counters);
  }
};

// Mutations: a gain or likelihood of the stack that is not the single landmark's.
TEST(CorrectAtOnce, OneLandmarkIsOneLandmark) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Scene scene(seed, 1, static_cast<int>(seed % 4));
    const Corrected a(scene, Updates::kOneByOne), b(scene, Updates::kAtOnce);
    EXPECT_TRUE(near(a.posterior.pose.mean, b.posterior.pose.mean, 1e-11));
    EXPECT_TRUE(near(a.posterior.pose.covariance, b.posterior.pose.covariance, 1e-13));
    EXPECT_NEAR(a.posterior.log_likelihood, b.posterior.log_likelihood, 1e-8);
  }
}

// With several the moments differ, for those of the second are not drawn anew. Mutations: kAtOnce that goes
// one by one; an outlier that is used with the rest, or neither refused nor counted.
TEST(CorrectAtOnce, SeveralAreLookedAtFromThePredictionAndOutliersAreLeftOut) {
  Scene scene(3, 4, 3);
  const Corrected a(scene, Updates::kOneByOne), b(scene, Updates::kAtOnce);
  EXPECT_FALSE(near(a.posterior.pose.mean, b.posterior.pose.mean, 1e-6));
  EXPECT_TRUE(near(a.posterior.pose.mean, b.posterior.pose.mean, 0.05));
  Scene without = scene;
  without.landmarks.pop_back();
  without.seen.pop_back();
  scene.seen.back().range_bearing.x() += 5.0;
  const Corrected outlier(scene, Updates::kAtOnce), clean(without, Updates::kAtOnce);
  EXPECT_EQ(outlier.targets.back().outcome, Outcome::kRefuse);
  EXPECT_EQ(outlier.counters.gated_measurements, 1);
  EXPECT_TRUE(near(outlier.posterior.pose.mean, clean.posterior.pose.mean, 0.0));
  EXPECT_LT(outlier.posterior.log_likelihood, clean.posterior.log_likelihood);
}

}  // namespace
}  // namespace stereobench::slam
