/// How well filters and smoothers can do at best: posterior Cramer-Rao bounds, computed from the truth.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slam/models/belief.h"
#include "slam/reference/smoothing_bound.h"

namespace stereobench::slam {

/// That a landmark was seen, and with what noise; what was measured does not matter to the bound.
struct TrueSighting {
  int landmark = 0;                                 ///< its index among the true landmarks
  Eigen::Matrix2d noise = Eigen::Matrix2d::Zero();  ///< of (range, bearing): m^2, m rad, rad^2
};

/// The bounds on the covariance of pose and landmarks at each instant (Tichavsky, Muravchik and Nehorai
/// 1998): the filtering bound, given the controls and sightings up to that instant, which no unbiased filter
/// can beat, and the smoothing bound, given those of the whole drive, for estimates that know what came
/// later.
///
/// With Gaussian noise the information recursion is that of an extended Kalman filter whose Jacobians are all
/// taken at the truth. It is kept as a covariance, in the form P - P H' S^+ H P: a start without uncertainty
/// and the rank two of a control's noise are then nothing special, and nothing that may be singular is
/// inverted. Before it is seen nothing is known of a landmark; its first sighting therefore tells nothing of
/// the pose.
class PosteriorBound {
 public:
  /// @param noise of the odometry, evaluated at the true controls as standard_deviations() does
  /// @param start the true start, known to the filter
  /// @param landmarks their true places, m
  PosteriorBound(const OdometryNoise& noise, const Pose& start, std::vector<Eigen::Vector2d> landmarks);

  /// The robot drives.
  /// @param control the true one, whatever the odometry says
  void move(const Control& control);

  /// The robot looks.
  /// @param frame what is seen at this instant, in any order
  /// @throws std::invalid_argument when there is no such landmark
  void look(std::span<const TrueSighting> frame);

  /// @return the true pose, and the least covariance of (x, y, heading) that a filter's estimate can have
  const PoseBelief& pose() const { return pose_; }

  /// The smoothing bound: the blocks of the poses in the inverse of the information in the whole drive.
  /// @return for each look() so far, the least covariance of (x, y, heading) that an estimate can have which
  /// knows all that has happened until now
  std::vector<Eigen::Matrix3d> smoothed_poses() const { return smoother_.covariances(); }

  /// @return the least covariance of a landmark's place, m^2; none before it has been seen
  std::optional<Eigen::Matrix2d> landmark(int index) const;

 private:
  void add(const TrueSighting& sighting);
  void inform(std::span<const TrueSighting> frame);
  void tell_smoother(std::span<const TrueSighting> frame);

  OdometryNoise noise_;
  std::vector<Eigen::Vector2d> landmarks_;
  PoseBelief pose_;                ///< its covariance is the first block of the joint one
  std::vector<Eigen::Index> row_;  ///< by landmark: where its block begins, or 0 before it is seen
  Eigen::Index size_ = 3;          ///< of the part of the joint covariance that is in use
  Eigen::MatrixXd joint_;          ///< of the pose and the landmarks in order of discovery; symmetric
  SmoothingBound smoother_;
};

}  // namespace stereobench::slam
