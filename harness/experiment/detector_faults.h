/// What is made worse of a detector's answers before anybody uses them: `detector_noise:` of a scenario.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace stereobench::harness {

/// A share of the errors is larger than the others.
struct HeavyTail {
  double share = 0.0;     ///< of the detections, in [0, 1]
  double sd_scale = 1.0;  ///< by how much their standard deviation is larger

  bool operator==(const HeavyTail&) const = default;
};

/// What a detection's covariance says of the error that was added.
enum class StatedCovariance {
  kHonest,    ///< the covariance of what was added is added
  kAsStated,  ///< nothing: it is the detector's own
};

/// Faults of a detector, whoever it is. As they are here, none does anything.
struct DetectorFaults {
  double centre_sd_px = 0.0;  ///< of each coordinate of a centre, in each camera
  /// What each camera's centres are off by: (column, row) of the left one, of the right one.
  std::vector<Eigen::Vector2d> centre_bias_px = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  HeavyTail heavy_tail;
  double correlated_s = 0.0;  ///< how long an error of a centre lasts; 0: each frame has its own
  double quantise_px = 0.0;   ///< centres are multiples of it; 0: they are not
  double range_scale = 1.0;   ///< measured ranges are so many times the range

  double miss_probability = 0.0;
  /// (visible fraction, probability to be missed), interpolated; empty: never for that reason
  std::vector<Eigen::Vector2d> miss_by_visible;
  std::vector<Eigen::Vector2d> miss_by_range;  ///< the same by range, m
  int miss_burst_frames = 1;                   ///< a ball that is missed is missed for so many frames

  double false_per_frame = 0.0;  ///< detections of nothing, on average
  double false_within_m = 5.0;   ///< how far away those are at most

  double identity_swap_probability = 0.0;  ///< that a pair of detections has each other's name
  /// Row: the colour that was seen; column: what it is called. Of the first colours of the palette.
  std::vector<std::vector<double>> confusion;

  int latency_frames = 0;  ///< so many frames after the look its detections arrive
  StatedCovariance covariance = StatedCovariance::kHonest;
  double covariance_scale = 1.0;
};

}  // namespace stereobench::harness
