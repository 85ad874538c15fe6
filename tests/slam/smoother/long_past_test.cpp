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
// asked for, are those of the whole log at once. Mutation: the past is never linearised anew as a whole.
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

// A straight drive of 612 m by an odometer whose scale alone is uncertain, and one last look at the first
// landmark, 9.5 m farther back: all that lies between moves by its share, and most is left behind. The next
// frame sees some of it, far from where it was left. Mutation: landmarks that a frame may show are not
// brought to where they belong first.
TEST(LongPast, IsBroughtInBeforeItIsSeenAgain) {
  constexpr int kSteps = 612;  // the graph is not linearised anew as a whole in the last two frames
  constexpr double kFarther_m = 9.5;
  Smoother smoother({.odometry_noise = {0.1, 0.0, 0.0, 1e-7, 0.0, 0.0}, .range_floor_m = 0.0}, {});
  const auto see = [](int id, double x_m) {
    RangeBearing one{.range_m = std::hypot(x_m, 3.0), .bearing_rad = std::atan2(3.0, x_m), .landmark_id = id};
    one.covariance = Eigen::Vector2d(1e-4, 1e-8).asDiagonal();
    return one;
  };
  const double stretch = 1.0 + kFarther_m / (kSteps - 1);
  for (int k = 1; k <= kSteps + 1; ++k) {
    smoother.predict({1.0, 0.0, 1.0});
    std::vector<RangeBearing> frame{see(k, 0.0)};
    if (k == kSteps) frame.push_back(see(1, -(kSteps - 1) * stretch));
    if (k == kSteps + 1) {
      for (int id = kSteps / 6; id < kSteps; id += kSteps / 6)
        frame.push_back(see(id, -(kSteps - id) * stretch - 1.0));
    }
    smoother.update(frame);
  }
  const std::vector<Decision> last = smoother.last_decisions().sightings;
  ASSERT_EQ(last.size(), 6U);
  for (std::size_t i = 1; i < last.size(); ++i) EXPECT_EQ(last[i].outcome, Outcome::kUse) << i;
}

}  // namespace
}  // namespace stereobench::slam
