#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/models/measurement.h"
#include "slam/models/motion.h"
#include "slam/reference/batch.h"
#include "slam/smoother/smoother.h"

namespace stereobench::slam {
namespace {

constexpr int kLapSteps = 500;
constexpr int kPlaces = 120;

/// Rather more than a lap of a circle of landmarks: what closes it moves all of a long past.
class Lap {
 public:
  Lap() {
    const double radius_m = kLapSteps / (2.0 * M_PI);
    for (int i = 0; i < kPlaces; ++i) {
      const double angle = 2.0 * M_PI * i / kPlaces;
      const double at_m = radius_m + (i % 2 == 0 ? 3.0 : -3.0);
      places_.emplace_back(at_m * std::sin(angle), radius_m - at_m * std::cos(angle));
    }
    RandomStream random(3, Stream::kOracle);
    Pose truth;
    for (int k = 0; k < kLapSteps + 40; ++k) {
      const Control control{1.0, 1.0 / radius_m, 1.0};
      truth = advance(truth, control);
      steps_.push_back({{perturb(control, noise, random)}, look(truth, random)});
    }
  }

  const std::vector<BatchStep>& steps() const { return steps_; }

  /// @return the step at which something of the start is seen again
  std::size_t closes() const {
    const int first = steps_.front().sightings.front().landmark_id;
    for (std::size_t k = kLapSteps / 2;; ++k) {
      for (const RangeBearing& one : steps_[k].sightings)
        if (one.landmark_id == first) return k;
    }
  }

  const OdometryNoise noise{0.05, 0.0, 0.0, 0.01, 0.0, 0.0};

 private:
  std::vector<RangeBearing> look(const Pose& truth, RandomStream& random) const {
    std::vector<RangeBearing> seen;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Eigen::Vector2d exact = predict_sighting(truth, places_[i]);
      if (exact.x() > 8.0) continue;
      RangeBearing one;
      one.landmark_id = static_cast<int>(i);
      one.range_m = exact.x() + 0.1 * random.normal();
      one.bearing_rad = wrap_angle(exact.y() + 0.02 * random.normal());
      one.covariance = Eigen::Vector2d(0.01, 0.0004).asDiagonal();
      seen.push_back(one);
    }
    return seen;
  }

  std::vector<Eigen::Vector2d> places_;
  std::vector<BatchStep> steps_;
};

// A loop that closes moves more variables than a frame may solve anew. Poses at once, and the map when it is
// asked for, are those of the whole log at once. Mutations: a map of what was left behind; landmarks that a
// frame sees again not brought up to where they belong.
TEST(LongPast, FollowsWhenALoopCloses) {
  const Lap lap;
  const FilterConfig config{.odometry_noise = lap.noise, .gate_probability = 1.0};
  Smoother smoother(config, {});
  const std::vector<BatchStep>& steps = lap.steps();
  for (std::size_t k = 0; k < steps.size(); ++k) {
    smoother.predict(steps[k].controls.front());
    smoother.update(steps[k].sightings);
    if (k < lap.closes() || (k > lap.closes() + 2 && k + 1 < steps.size())) continue;
    const BatchEstimate best = estimate_batch(config, {}, std::span(steps).first(k + 1));
    ASSERT_TRUE(best.converged);
    const Estimate estimate = smoother.estimate();
    const Eigen::Vector3d off = boxminus(estimate.pose, best.path.back());
    EXPECT_LE(off.dot(estimate.covariance.ldlt().solve(off)), 0.01) << k;
    ASSERT_EQ(estimate.landmarks.size(), best.landmarks.size());
    for (std::size_t i = 0; i < best.landmarks.size(); ++i) {
      const LandmarkEstimate& one = estimate.landmarks[i];
      const Eigen::Vector2d astray = one.position_m - best.landmarks[i].position_m;
      EXPECT_LE(astray.dot(one.covariance.ldlt().solve(astray)), 0.01) << k << ", " << i;
    }
  }
}

}  // namespace
}  // namespace stereobench::slam
