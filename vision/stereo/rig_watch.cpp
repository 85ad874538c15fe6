#include "vision/stereo/rig_watch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "vision/camera/rig.h"
#include "vision/tuning/rig_watch.h"

namespace stereobench::vision {
namespace {

// How a turn moves what the right camera sees: derivatives of (column, row), to first order.
Eigen::Matrix<double, 2, 3> moved_by_turn_px(const Intrinsics& camera, const Eigen::Vector2d& right_px) {
  const double x = (right_px.x() - camera.cx_px) / camera.focal_px;
  const double y = (right_px.y() - camera.cy_px) / camera.focal_px;
  Eigen::Matrix<double, 2, 3> by_turn;
  by_turn << x * y, -(1.0 + x * x), y, 1.0 + y * y, -x * y, -x;
  return camera.focal_px * by_turn;
}

// Of the left row less the right one.
Eigen::Vector4d rows_by_fault(const Intrinsics& camera, const Eigen::Vector2d& right_px) {
  Eigen::Vector4d by_fault = Eigen::Vector4d::Zero();
  by_fault.head<3>() = -moved_by_turn_px(camera, right_px).row(1).transpose();
  return by_fault;
}

Eigen::Vector4d disparity_by_fault(const Intrinsics& camera, const Eigen::Vector2d& right_px,
                                   double disparity_px) {
  Eigen::Vector4d by_fault;
  by_fault << -moved_by_turn_px(camera, right_px).row(0).transpose(), disparity_px;
  return by_fault;
}

// Takes two parts of a fault out of a belief unless they are more than chance, and matter.
// @param sizes_px of what a unit of each part moves, somewhere in the picture
void keep_if_real(const std::array<Eigen::Index, 2>& parts, const Eigen::Vector2d& sizes_px, bool is_known,
                  RigBelief& belief) {
  const Eigen::Vector2d fault(belief.fault[parts[0]], belief.fault[parts[1]]);
  Eigen::Matrix2d covariance;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      covariance(i, j) =
          belief.covariance(parts[static_cast<std::size_t>(i)], parts[static_cast<std::size_t>(j)]);
  const double squares = fault.dot(covariance.inverse() * fault);
  const bool matters = fault.cwiseProduct(sizes_px).cwiseAbs().maxCoeff() > kRigWatch.matters_px;
  if (is_known && matters && squares > kRigWatch.by_chance) return;
  for (const Eigen::Index part : parts) {
    belief.fault[part] = 0.0;
    belief.covariance.row(part).setZero();
    belief.covariance.col(part).setZero();
  }
}

// Least squares, each kind of differences with its variances so many times as large.
RigBelief solve(const RigWatch& watch, double rows_scatter, double sizes_scatter) {
  const Eigen::Matrix4d prior = usual_fault().covariance.diagonal().cwiseInverse().asDiagonal();
  const Eigen::LDLT<Eigen::Matrix4d> solver(watch.rows.information / rows_scatter +
                                            watch.sizes.information / sizes_scatter + prior);
  return {solver.solve(watch.rows.evidence / rows_scatter + watch.sizes.evidence / sizes_scatter),
          solver.solve(Eigen::Matrix4d::Identity())};
}

}  // namespace

RigBelief usual_fault() {
  RigBelief belief;
  belief.covariance.diagonal() = Eigen::Vector4d(kRigWatch.usual_turn_rad, kRigWatch.usual_turn_rad,
                                                 kRigWatch.usual_turn_rad, kRigWatch.usual_baseline)
                                     .cwiseAbs2();
  return belief;
}

Eigen::Vector2d RigBelief::rectified_px(const Intrinsics& camera, const Eigen::Vector2d& right_px) const {
  if (fault.head<3>().isZero(0.0)) return right_px;
  const StereoRig turned{.intrinsics = camera, .right_turn_rad = fault.head<3>()};
  return rectified_point(turned, right_px, Side::kRight).value_or(right_px);
}

double RigBelief::rows_apart_px(const Intrinsics& camera, const Eigen::Vector2d& right_px) const {
  return rows_by_fault(camera, right_px).dot(fault);
}

double RigBelief::disparity_beyond_px(const Intrinsics& camera, const Eigen::Vector2d& right_px,
                                      double disparity_px) const {
  return disparity_by_fault(camera, right_px, disparity_px).dot(fault);
}

Eigen::Vector2d RigBelief::variances_px2(const Intrinsics& camera, const Eigen::Vector2d& right_px,
                                         double disparity_px) const {
  const Eigen::Vector4d of_row = rows_by_fault(camera, right_px);
  const Eigen::Vector4d of_disparity = disparity_by_fault(camera, right_px, disparity_px);
  return {of_row.dot(covariance * of_row), of_disparity.dot(covariance * of_disparity)};
}

StereoRig with_baseline(StereoRig rig, const RigBelief& belief) {
  rig.baseline_m *= 1.0 + belief.fault[3];
  return rig;
}

void FaultSums::add(const Eigen::Vector4d& by_fault, double difference, double variance) {
  information += by_fault * by_fault.transpose() / variance;
  evidence += by_fault * difference / variance;
  squares += difference * difference / variance;
}

FaultSums& FaultSums::operator+=(const FaultSums& other) {
  information += other.information;
  evidence += other.evidence;
  squares += other.squares;
  return *this;
}

double FaultSums::squares_about(const RigFault& fault) const {
  return std::max(0.0, squares - 2.0 * evidence.dot(fault) + fault.dot(information * fault));
}

void RigWatch::add(const Intrinsics& camera, const BallApart& ball, const RigBelief& belief) {
  RigFault turn = belief.fault;
  turn[3] = 0.0;
  const Eigen::Vector2d apart = ball.left_px - ball.right_px;
  const Eigen::Vector4d of_row = rows_by_fault(camera, ball.right_px);
  rows.add(of_row, apart.y() + of_row.dot(turn), ball.row_variance_px2);
  const Eigen::Vector4d of_disparity = disparity_by_fault(camera, ball.right_px, ball.disparity_by_size_px);
  sizes.add(of_disparity, apart.x() - ball.disparity_by_size_px + of_disparity.dot(turn),
            ball.disparity_variance_px2);
  ++balls;
}

RigWatch& RigWatch::operator+=(const RigWatch& other) {
  rows += other.rows;
  sizes += other.sizes;
  balls += other.balls;
  return *this;
}

RigBelief RigWatch::estimate() const {
  RigBelief best = solve(*this, 1.0, 1.0);
  const double freedom = std::max(1.0, static_cast<double>(balls) - 2.0);  // two parts of it are told by each
  return solve(*this, std::max(1.0, rows.squares_about(best.fault) / freedom),
               std::max(1.0, sizes.squares_about(best.fault) / freedom));
}

RigBelief RigWatch::belief(const Intrinsics& camera) const {
  RigBelief belief = estimate();
  const double f = camera.focal_px;
  keep_if_real({0, 2}, {f, 0.5 * camera.width_px}, balls > 0, belief);
  keep_if_real({1, 3}, {f, kRigWatch.usual_disparity_px}, balls >= kRigWatch.fewest_sizes, belief);
  return belief;
}

}  // namespace stereobench::vision
