#include "slam/models/uncertain_start.h"

#include "slam/math/elementary.h"

namespace stereobench::slam {

UncertainStart::UncertainStart(const Pose& mean, const Eigen::Matrix3d& covariance)
    : mean_(mean), covariance_(covariance), is_exact_(covariance.isZero(0.0)) {
  const double variance = covariance(2, 2);
  cosine_ = exponential(-0.5 * variance);
  const double squared = cosine_ * cosine_;
  cosine_twice_ = squared * squared;
  const double less = 1.0 - cosine_;
  shrinking_ = 0.5 * less * less * (squared + 2.0 * cosine_ + 3.0);
  swinging_ = 0.5 * less * (1.0 + cosine_) * (1.0 + squared);
  with_sine_ = variance * cosine_;
}

Eigen::Matrix2d UncertainStart::of_place(const Eigen::Vector2d& place, const Eigen::Matrix2d& known) const {
  if (is_exact_) return known;
  const Eigen::Vector2d along = place - Eigen::Vector2d(mean_.x_m, mean_.y_m);
  const Eigen::Vector2d across(-along.y(), along.x());
  // What turns by a has its mean part, a multiple of 1, as it was; the rest turns by 2a.
  const Eigen::Matrix2d round = 0.5 * known.trace() * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d error = covariance_.topLeftCorner<2, 2>() + round + cosine_twice_ * (known - round) +
                                shrinking_ * along * along.transpose() +
                                swinging_ * across * across.transpose();
  const Eigen::Matrix2d tied = cosine_ * covariance_.topRightCorner<2, 1>() * across.transpose();
  return error + tied + tied.transpose();
}

Eigen::Matrix3d UncertainStart::of_pose(const Pose& pose, const Eigen::Matrix3d& known) const {
  if (is_exact_) return known;
  const Eigen::Vector2d place(pose.x_m, pose.y_m);
  const Eigen::Vector2d across(mean_.y_m - pose.y_m, pose.x_m - mean_.x_m);
  Eigen::Matrix3d error;
  error.topLeftCorner<2, 2>() = of_place(place, known.topLeftCorner<2, 2>());
  error.topRightCorner<2, 1>() =
      covariance_.topRightCorner<2, 1>() + with_sine_ * across + cosine_ * known.topRightCorner<2, 1>();
  error.bottomLeftCorner<1, 2>() = error.topRightCorner<2, 1>().transpose();
  error(2, 2) = covariance_(2, 2) + known(2, 2);
  return error;
}

}  // namespace stereobench::slam
