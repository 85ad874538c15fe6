/// How well an estimate of the path can be that knows the whole drive: the posterior Cramer-Rao bound of
/// smoothers.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace stereobench::slam {

/// A sighting to first order: error = pose' x + landmark' l + noise, in standard deviations of the noise.
struct WhitenedSighting {
  Eigen::Index row = 0;                 ///< of the landmark's x in the state, 3 or more
  Eigen::Matrix<double, 2, 3> by_pose;  ///< by (x, y, heading): 1 / m, 1 / m, 1 / rad
  Eigen::Matrix2d by_landmark;          ///< by the landmark's (x, y): 1 / m
};

/// Divides a sighting's slopes by its noise. Noise below kExact is taken as kExact.
///
/// @param by_pose d(range, bearing) / d(x, y, heading)
/// @param by_landmark d(range, bearing) / d(landmark x, y)
/// @param noise covariance of (range, bearing): m^2, m rad, rad^2; may be singular
WhitenedSighting whitened(Eigen::Index row, const Eigen::Matrix<double, 2, 3>& by_pose,
                          const Eigen::Matrix2d& by_landmark, const Eigen::Matrix2d& noise);

/// The square-root information smoother with the covariance recursion of Dyer and McReynolds (G. J. Bierman,
/// "Factorization Methods for Discrete Sequential Estimation", 1977, chapters VI and X).
///
/// Forward, R with R'R = the information about pose and landmarks is kept triangular by reflections; the
/// noise of each motion is eliminated as a variable of its own. Backward, each pose is the next one less the
/// motion, so that its covariance is a sum of squares. No covariance is inverted and none is subtracted from
/// another: a sensor that is a million times as precise as the odometry loses six of sixteen digits.
class SmoothingBound {
 public:
  /// What is known exactly (the start, a perfect sensor) is taken as known to this: m, rad.
  static constexpr double kExact = 1e-9;

  SmoothingBound();

  /// The robot drives. Drives without a look between them are one.
  /// @param slope d pose / d pose before
  /// @param noise covariance that the motion adds; semidefinite: m^2, m rad, rad^2
  void move(const Eigen::Matrix3d& slope, const Eigen::Matrix3d& noise);

  /// The robot looks. A row beyond the state's end brings the landmarks up to it into the state.
  void look(const std::vector<WhitenedSighting>& frame);

  /// @return for each look so far the covariance of (x, y, heading) given all looks: m^2, m rad, rad^2
  std::vector<Eigen::Matrix3d> covariances() const;

 private:
  using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  /// From one look to the next: pose = slope pose_before + spread w, with w of unit covariance.
  struct Motion {
    Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  };

  /// A motion, and what is known of its w once the looks before it are: own w + by_state (pose, landmarks) =
  /// noise of unit covariance, with the pose after the motion.
  struct Eliminated {
    Motion motion;
    Eigen::Matrix3d own;
    Eigen::Matrix<double, 3, Eigen::Dynamic> by_state;
  };

  Eliminated eliminate(const Motion& motion);
  void inform(const std::vector<WhitenedSighting>& frame);

  RowMatrix root_;  ///< R: upper triangular, of the pose and the landmarks in order of discovery
  Motion since_look_;
  std::vector<Eliminated> motions_;  ///< before each look
};

}  // namespace stereobench::slam
