/// What a detector made of balls whose places are known.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "harness/detector_noise/ball_bound.h"
#include "harness/experiment/types.h"
#include "harness/vision_scoring/vision_score.h"
#include "renderer/types.h"

namespace stereobench::harness {

/// One trusted observation beside the truth.
struct CalibrationSample {
  Eigen::Vector2d truth = Eigen::Vector2d::Zero();   ///< range m, bearing rad, in the robot's frame
  Eigen::Vector2d error = Eigen::Vector2d::Zero();   ///< measured minus true
  Eigen::Matrix2d stated = Eigen::Matrix2d::Zero();  ///< the covariance that it came with
  BallBounds bounds;                                 ///< the least there can be; zero for parts of balls
  double disparity_error_px = 0.0;                   ///< NaN where nothing is said of pixels, and so below
  Eigen::Vector2d radius_error_px = Eigen::Vector2d::Zero();  ///< of the outlines, left and right
  double depth_m = 0.0;
  bool whole = true;  ///< at least 95 % of the ball is seen by each camera
};

/// What one calibration scene gave.
struct CalibrationTake {
  std::vector<CalibrationSample> samples;
  VisionScore score;
};

/// Looks around in a calibration scene (worlds::calibration_scene) with the experiment's detector.
/// @param seed of the noise
CalibrationTake take_samples(const Experiment& experiment, std::uint64_t seed, renderer::Backend backend);

}  // namespace stereobench::harness
