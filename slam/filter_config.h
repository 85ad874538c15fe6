/// What a filter is told before it starts.
#pragma once

#include <optional>

#include "slam/types.h"

namespace stereobench::slam {

/// Spread and weights of sigma points (eq. 7, 8 and 14).
///
/// The paper's alpha = 0.002 puts weights of about -250,000 on the centre, which costs ten digits and can
/// make a covariance indefinite. With alpha = 1 and kappa = 0 all weights are >= 0 and every covariance is
/// semidefinite by construction; the results of the filters are the same within their scatter.
struct UnscentedParameters {
  double alpha = 1.0;
  double beta = 2.0;
  double kappa = 0.0;
};

/// What a sensor's noise depends on, where sightings are not taken at their word: independent deviations of
/// range and bearing. The paper's sensor has constant ones. A stereo pair's range is off by r^2 sd(disparity)
/// / (focal length x baseline), and its bearing by sd(pixel) / (focal length).
///
/// The part that grows is taken at the range where a landmark should be seen (see noise_at), not where it
/// was: a reading that is too short would claim too little noise for itself, and what is fused come out
/// short.
struct NoiseLaw {
  double range_sd_m = 0.0;       ///< at any range
  double range_sd_per_m2 = 0.0;  ///< times the square of the range, 1/m
  double bearing_sd_rad = 0.0;
};

/// How the sightings of a frame are given to landmarks where identities are not known.
enum class Association {
  kIndividual,  ///< each pair for itself, likeliest first
  kJoint,       ///< where sightings or landmarks compete, the largest set of pairs that one pose explains
};

/// What a filter believes of its sensor: how far and wide it sees, and how well.
struct SensorSector {
  double range_m = 0.0;           ///< 0 = nothing is declared, and every landmark is real
  double half_angle_rad = 0.0;    ///< to each side of straight ahead
  double miss_probability = 0.0;  ///< 1 = what is not seen may be hidden, and says nothing
  double false_per_look = 0.0;    ///< sightings of nothing, on average
};

/// Settings of a filter; dead reckoning reads the odometry's noise only.
struct FilterConfig {
  int particles = 100;           ///< M >= 1
  OdometryNoise odometry_noise;  ///< what the filter believes of its odometry
  /// Of the start pose (x, y, heading), in the world. It changes what is claimed, and no estimate.
  Eigen::Matrix3d start_covariance = Eigen::Matrix3d::Zero();

  std::optional<NoiseLaw> noise_law;  ///< of all sightings; none = each is believed what it states
  /// By how much the standard deviations of (range, bearing) are larger than sightings state them.
  Eigen::Vector2d stated_sd_scale = Eigen::Vector2d::Ones();

  /// Floor under the measurement noise, added as a variance: a sensor that claims 0.02 mm would make weights
  /// vanish in all particles but one. 1 mm and 0.05 mrad are about a good rig's calibration error.
  double range_floor_m = 1e-3;
  double bearing_floor_rad = 5e-5;

  /// Filters in blocks (slam/block/block_slam.h) draw the poses of at most so many frames together; all
  /// others draw each by itself.
  int draw_every = 1000;

  double resample_below = 0.5;  ///< resample when the effective particles fall below this fraction of M
  double gate_probability =
      0.9999;  ///< a sighting is refused beyond this quantile of chi-square(2); 1 = never

  /// Two landmarks of one colour class are known to be at least this far apart; 0 = nothing is known. A
  /// sighting that lies within half of it of a landmark of its colour is that landmark, however sure the
  /// filter was.
  double colour_spacing_m = 0.0;

  Association association = Association::kJoint;
  bool merge_doubles = true;  ///< see AssociationPolicy
  SensorSector sector;

  /// Whether updates leave an UpdateReport. It changes nothing else.
  bool report_updates = false;

  UnscentedParameters unscented;
};

}  // namespace stereobench::slam
