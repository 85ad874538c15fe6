/// The vocabulary of the SLAM stage: poses, controls, range-bearing measurements, estimates.
///
/// Frames: **world** x east, y north; **robot** x forward, y left, origin on the floor under the
/// midpoint of the stereo baseline. Angles are radians in (-pi, pi], counter-clockwise.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace stereobench::slam {

/// Where the robot stands: world_from_robot in the plane.
struct Pose {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;  ///< in (-pi, pi], 0 = east, counter-clockwise
};

/// Velocities that are held for a while; several may lie between two observations.
struct Control {
  double v_mps = 0.0;       ///< forward speed
  double w_radps = 0.0;     ///< turn rate, counter-clockwise
  double duration_s = 0.0;  ///< how long they are held, >= 0

  // Of odometry that is not a wheel's, as that of cameras or scans:
  double lateral_mps = 0.0;  ///< speed to the left
  /// Of (v, lateral, w) while the control lasts, where the odometry states it; none: as OdometryNoise says
  std::optional<Eigen::Matrix3d> covariance;
};

/// Noise of the odometry as standard deviations, eq. 3 of the paper with a constant part added:
/// sd(v) = v_constant + v_per_v |v| + v_per_w |w|, and the same for w.
struct OdometryNoise {
  double v_constant_mps = 0.0;
  double v_per_v = 0.0;  ///< alpha_1, m/s per m/s
  double v_per_w = 0.0;  ///< alpha_2, m/s per rad/s
  double w_constant_radps = 0.0;
  double w_per_v = 0.0;  ///< alpha_3, rad/s per m/s
  double w_per_w = 0.0;  ///< alpha_4, rad/s per rad/s
  /// How long an error lasts: slip outlives the readings of a fast odometer, and errors drawn anew for each
  /// of them would average out. 0 = each control has an error of its own.
  double correlation_s = 0.0;
};

inline constexpr int kUnknown = -1;  ///< an identity or a colour class that is not known

/// One sighting of a landmark: horizontal range and bearing from the robot frame's origin.
struct RangeBearing {
  double range_m = 0.0;                                  ///< >= 0, horizontal
  double bearing_rad = 0.0;                              ///< in (-pi, pi], left-positive
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of (range, bearing): m^2, m rad, rad^2
  int landmark_id = kUnknown;                            ///< identity when it is known, >= 0
  int colour_class = kUnknown;  ///< colour when colours repeat and identity must be resolved, >= 0
  /// By how much the standard deviations of (range, bearing) are larger than stated: part of the error was in
  /// the sighting before already.
  Eigen::Vector2d sd_scale = Eigen::Vector2d::Ones();
};

/// A landmark of the map as a filter believes it to be.
struct LandmarkEstimate {
  int landmark_id = kUnknown;                            ///< the identity it was observed with, or kUnknown
  int colour_class = kUnknown;                           ///< the colour it was observed with, or kUnknown
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< in the world frame
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< m^2, symmetric, semidefinite
  int origin = kUnknown;  ///< the sighting that founded it, counted from 0 over all a filter was given
};

/// What a filter had to repair or refuse, so that nothing happens in silence.
struct FilterCounters {
  long resamplings = 0;         ///< particle sets drawn anew
  long covariance_repairs = 0;  ///< covariances that had to be made semidefinite
  long weight_collapses = 0;    ///< updates after which every weight had vanished
  long gated_measurements = 0;  ///< (particle, measurement) pairs refused by the outlier gate
  long rejected_inputs = 0;     ///< non-finite or impossible controls and measurements that were ignored
  long joint_searches_cut =
      0;  ///< joint associations that would have taken too long and were settled greedily
  long refitted_frames =
      0;  ///< (particle, frame) pairs that were fitted again as a whole, without what the fit spoke against

  FilterCounters& operator+=(const FilterCounters& other) {
    resamplings += other.resamplings;
    covariance_repairs += other.covariance_repairs;
    weight_collapses += other.weight_collapses;
    gated_measurements += other.gated_measurements;
    rejected_inputs += other.rejected_inputs;
    joint_searches_cut += other.joint_searches_cut;
    refitted_frames += other.refitted_frames;
    return *this;
  }
};

/// What a filter believes after a step.
struct Estimate {
  Pose pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, heading): m^2, m rad, rad^2
  std::vector<LandmarkEstimate> landmarks;
  double effective_particles = 1.0;  ///< 1 / sum of squared weights (eq. 36), in [1, M]
  FilterCounters counters;
};

}  // namespace stereobench::slam
