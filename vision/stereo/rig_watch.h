/// How far a rig is off what it is believed to be, as the balls that it sees tell.
#pragma once

#include <Eigen/Core>

#include "vision/types.h"

namespace stereobench::vision {

/// A fault of a rig: how the right camera is turned beyond what is believed (about x, y and z, rad, small),
/// and by what share the baseline is longer.
using RigFault = Eigen::Vector4d;

/// One ball in both pictures, rectified as the rig is believed to be: what a fault moves.
struct BallApart {
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero();   ///< centres of the outlines
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();  ///< without the turn that is believed
  double row_variance_px2 = 0.0;                       ///< of the difference of the rows, > 0
  double disparity_by_size_px = 0.0;    ///< of a ball of the known size whose outlines are as large as these
  double disparity_variance_px2 = 0.0;  ///< of disparity less that, > 0
};

/// What is believed of a rig's fault: a Gaussian. The default is none, exactly.
struct RigBelief {
  RigFault fault = RigFault::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();

  /// Where the right camera would see something if it were not turned.
  Eigen::Vector2d rectified_px(const Intrinsics& camera, const Eigen::Vector2d& right_px) const;

  /// By how many rows the left camera sees something further down than the right one does.
  double rows_apart_px(const Intrinsics& camera, const Eigen::Vector2d& right_px) const;

  /// By how much a disparity is larger than it would be without the fault.
  double disparity_beyond_px(const Intrinsics& camera, const Eigen::Vector2d& right_px,
                             double disparity_px) const;

  /// How uncertain these are: variances of the row, and of the disparity, to which the baseline adds.
  Eigen::Vector2d variances_px2(const Intrinsics& camera, const Eigen::Vector2d& right_px,
                                double disparity_px) const;
};

/// The rig with the baseline that is believed to be right.
StereoRig with_baseline(StereoRig rig, const RigBelief& belief);

/// What cameras are turned by, and baselines off, before anything is known of a rig: 0.6 degrees and 4
/// percent.
RigBelief usual_fault();

/// Sums over one kind of differences, each in units of its variance.
struct FaultSums {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  Eigen::Vector4d evidence = Eigen::Vector4d::Zero();
  double squares = 0.0;

  void add(const Eigen::Vector4d& by_fault, double difference, double variance);
  FaultSums& operator+=(const FaultSums& other);
  double squares_about(const RigFault& fault) const;
};

/// Gathers what balls tell of their rig over a run: a value that is passed from frame to frame.
///
/// Rows that differ tell turns about x and z; disparities that contradict the sizes of balls tell a turn
/// about y and a wrong baseline. Both are linear in the fault, so that sums are all that is kept, and those
/// of several runs can be added.
struct RigWatch {
  FaultSums rows, sizes;
  long balls = 0;

  /// @param belief whose turn was undone in the ball's right outline: differences are told as if it were
  ///   not
  void add(const Intrinsics& camera, const BallApart& ball, const RigBelief& belief);
  RigWatch& operator+=(const RigWatch& other);

  /// The fault that suits all balls best (least squares about usual_fault). Where balls scatter more than
  /// they should, its covariance is as much larger.
  RigBelief estimate() const;

  /// The estimate as far as it cannot be chance and matters: rows that are apart by 0.05 px at least; of
  /// two balls or more, disparities that contradict sizes by as much. The rest is no fault.
  RigBelief belief(const Intrinsics& camera) const;
};

}  // namespace stereobench::vision
