// A course for what is computed from the truth or from a whole log.
#pragma once

#include <vector>

#include "slam/reference/batch.h"
#include "tests/slam/dense_drive.h"

namespace stereobench::slam {

inline const std::vector<Eigen::Vector2d> kCoursePlaces = {
    {3.0, 1.0}, {5.0, -1.5}, {1.0, 3.0}, {-1.0, 2.0}, {4.0, 4.0}};

// A curved drive of a few controls a step, with landmarks coming and going, one of them seen twice in a
// frame, and a step that sees nothing. Nothing in it is noisy yet.
struct Course {
  Pose start{0.3, -0.2, 0.4};
  OdometryNoise noise{0.05, 0.1, 0.02, 0.04, 0.03, 0.1};
  std::vector<DenseStep> steps;

  explicit Course(std::uint64_t seed, int controls = 1) {
    RandomStream random(seed, Stream::kWorld);
    Pose truth = start;
    for (int k = 0; k < 8; ++k) {
      DenseStep step;
      for (int i = 0; i < controls; ++i) {
        step.controls.push_back({0.8 + 0.2 * random.normal(), 0.5 * random.normal(), 0.5});
        truth = advance(truth, step.controls.back());
      }
      for (int landmark = 0; landmark < 5 && k != 3; ++landmark) {
        if ((k + landmark) % 3 == 0) see(step, truth, landmark, random);
      }
      if (k == 5) see(step, truth, step.sightings.front().landmark, random);
      steps.push_back(step);
    }
  }

  static void see(DenseStep& step, const Pose& truth, int landmark, RandomStream& random) {
    const double a = 0.05 + 0.1 * random.uniform();
    const double b = 0.01 + 0.05 * random.uniform();
    Eigen::Matrix2d noise;
    noise << a * a, 0.5 * a * b, 0.5 * a * b, b * b;
    step.sightings.push_back(
        {landmark, predict_sighting(truth, kCoursePlaces[static_cast<std::size_t>(landmark)]), noise});
  }

  // What is measured on it.
  Course measured(std::uint64_t seed) const {
    RandomStream odometry(seed, Stream::kOdometry);
    RandomStream sensor(seed, Stream::kOracle);
    Course noisy = *this;
    for (DenseStep& step : noisy.steps) {
      for (Control& control : step.controls) control = perturb(control, noise, odometry);
      for (DenseSighting& sighting : step.sightings) {
        const Eigen::Matrix2d root = sighting.noise.llt().matrixL();
        sighting.range_bearing += root * Eigen::Vector2d(sensor.normal(), sensor.normal());
      }
    }
    return noisy;
  }
};

// A course as the batch reads it, with identities.
inline std::vector<BatchStep> batch_log(const Course& course) {
  std::vector<BatchStep> log;
  for (const DenseStep& step : course.steps) {
    BatchStep out{step.controls, {}};
    for (const DenseSighting& seen : step.sightings) {
      RangeBearing sighting;
      sighting.range_m = seen.range_bearing.x();
      sighting.bearing_rad = seen.range_bearing.y();
      sighting.covariance = seen.noise;
      sighting.landmark_id = seen.landmark;
      out.sightings.push_back(sighting);
    }
    log.push_back(out);
  }
  return log;
}

}  // namespace stereobench::slam
