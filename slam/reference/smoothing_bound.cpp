#include "slam/reference/smoothing_bound.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace stereobench::slam {
namespace {

/// What a landmark is known to before it is seen: next to nothing, so that a glance from its own place, which
/// has no direction, leaves R regular.
constexpr double kUnknown_m = 1e6;

/// B with B B' = a semidefinite covariance.
Eigen::Matrix3d root_of(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> parts(covariance);
  return parts.eigenvectors() * parts.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

/// B with B B' = a a' + b b'.
Eigen::Matrix3d joined(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  Eigen::Matrix<double, 6, 3> both;
  both << a.transpose(), b.transpose();
  const Eigen::HouseholderQR<Eigen::Matrix<double, 6, 3>> qr(both);
  return qr.matrixQR().topRows<3>().triangularView<Eigen::Upper>().toDenseMatrix().transpose();
}

}  // namespace

WhitenedSighting whitened(Eigen::Index row, const Eigen::Matrix<double, 2, 3>& by_pose,
                          const Eigen::Matrix2d& by_landmark, const Eigen::Matrix2d& noise) {
  constexpr double kLeast = SmoothingBound::kExact * SmoothingBound::kExact;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> parts(noise);
  const Eigen::Matrix2d whitener =
      parts.eigenvalues().cwiseMax(kLeast).cwiseSqrt().cwiseInverse().asDiagonal() *
      parts.eigenvectors().transpose();
  return {row, whitener * by_pose, whitener * by_landmark};
}

SmoothingBound::SmoothingBound() : root_(RowMatrix::Identity(3, 3) / kExact) {}

void SmoothingBound::move(const Eigen::Matrix3d& slope, const Eigen::Matrix3d& noise) {
  since_look_.slope = (slope * since_look_.slope).eval();
  since_look_.spread = joined(slope * since_look_.spread, root_of(noise));
}

void SmoothingBound::look(const std::vector<WhitenedSighting>& frame) {
  motions_.push_back(eliminate(since_look_));
  since_look_ = {};
  if (!frame.empty()) inform(frame);
}

/// The unknowns (w, pose after) take the place of the pose before = slope^-1 (pose after - spread w), and the
/// rows of w are split off.
SmoothingBound::Eliminated SmoothingBound::eliminate(const Motion& motion) {
  const Eigen::Index size = root_.cols();
  const Eigen::Matrix3d by_after = root_.topLeftCorner<3, 3>() * motion.slope.inverse();
  Eigen::Matrix<double, 6, Eigen::Dynamic> rows = Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, 3 + size);
  rows.topLeftCorner<3, 3>() = -by_after * motion.spread;  // the larger rows first: it keeps digits
  rows.block<3, 3>(0, 3) = by_after;
  rows.topRightCorner(3, size - 3) = root_.topRightCorner(3, size - 3);
  rows.bottomLeftCorner<3, 3>().setIdentity();
  const Eigen::HouseholderQR<Eigen::Matrix<double, 6, 6>> qr(rows.leftCols<6>());
  rows.applyOnTheLeft(qr.householderQ().adjoint());
  root_.topRows<3>() = rows.bottomRightCorner(3, size);
  root_.topLeftCorner<3, 3>().triangularView<Eigen::StrictlyLower>().setZero();
  return {motion, rows.topLeftCorner<3, 3>().triangularView<Eigen::Upper>(), rows.topRightCorner(3, size)};
}

/// Turns the frame's rows to zero, column by column, by reflections with the rows of R.
void SmoothingBound::inform(const std::vector<WhitenedSighting>& frame) {
  Eigen::Index size = root_.cols();
  for (const WhitenedSighting& sighting : frame) size = std::max(size, sighting.row + 2);
  const Eigen::Index known = root_.cols();
  root_.conservativeResizeLike(RowMatrix::Zero(size, size));
  root_.diagonal().tail(size - known).setConstant(1.0 / kUnknown_m);
  RowMatrix seen = RowMatrix::Zero(2 * static_cast<Eigen::Index>(frame.size()), size);
  Eigen::Index first = 0;
  for (const WhitenedSighting& sighting : frame) {
    seen.block<2, 3>(first, 0) = sighting.by_pose;
    seen.block<2, 2>(first, sighting.row) = sighting.by_landmark;
    first += 2;
  }
  Eigen::RowVectorXd shared(size);
  for (Eigen::Index column = 0; column < size; ++column) {
    const double below = seen.col(column).squaredNorm();
    if (below == 0.0) continue;
    const double own = root_(column, column);
    const double length = std::sqrt(own * own + below);
    const double pivot = own > 0.0 ? own + length : own - length;  // the reflection's vector is (pivot, seen)
    const Eigen::VectorXd rest = seen.col(column);
    const Eigen::Index behind = size - column;
    shared.tail(behind) = pivot * root_.row(column).tail(behind);
    shared.tail(behind).noalias() += rest.transpose() * seen.rightCols(behind);
    shared.tail(behind) *= 2.0 / (pivot * pivot + below);
    root_.row(column).tail(behind) -= pivot * shared.tail(behind);
    seen.rightCols(behind).noalias() -= rest * shared.tail(behind);
    seen.col(column).setZero();
  }
}

std::vector<Eigen::Matrix3d> SmoothingBound::covariances() const {
  const Eigen::Index size = root_.cols();
  const RowMatrix inverse =
      root_.triangularView<Eigen::Upper>().solve(RowMatrix::Identity(size, size).eval());
  Eigen::MatrixXd covariance = inverse * inverse.transpose();
  std::vector<Eigen::Matrix3d> poses(motions_.size());
  for (std::size_t k = motions_.size(); k-- > 0;) {
    poses[k] = covariance.topLeftCorner<3, 3>();
    const auto& [motion, own, by_state] = motions_[k];
    // pose before = slope^-1 (pose - spread w), with own w = noise - by_state (pose, landmarks)
    const Eigen::Matrix3d gain = motion.slope.inverse() * motion.spread *
                                 own.triangularView<Eigen::Upper>().solve(Eigen::Matrix3d::Identity().eval());
    Eigen::Matrix<double, 3, Eigen::Dynamic> before = gain * by_state;
    before.leftCols<3>() += motion.slope.inverse();
    const Eigen::Matrix<double, 3, Eigen::Dynamic> cross = before * covariance.topRows(before.cols());
    const Eigen::Matrix3d pose = cross.leftCols(before.cols()) * before.transpose() + gain * gain.transpose();
    covariance.topRows<3>() = cross;
    covariance.leftCols<3>() = cross.transpose();
    covariance.topLeftCorner<3, 3>() = 0.5 * (pose + pose.transpose());
  }
  return poses;
}

}  // namespace stereobench::slam
