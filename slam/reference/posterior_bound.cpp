#include "slam/reference/posterior_bound.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include "slam/models/linearised.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {
namespace {

/// d(x, y, heading) / d(x0, y0, heading0) of any motion that leads from one pose to another.
Eigen::Matrix3d lever(const Pose& from, const Pose& to) {
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  slope.col(2).head<2>() = heading_lever(from, {to.x_m, to.y_m});
  return slope;
}

/// W with W' W = S^+ for a semidefinite S, on vectors that vanish where S does.
Eigen::MatrixXd whitener(const Eigen::MatrixXd& s) {
  constexpr double kVanishing = 1e-12;  // of correlations, in which metres and radians are alike
  const Eigen::VectorXd scale =
      (s.diagonal().array() > 0.0).select(s.diagonal().array().rsqrt(), 0.0).matrix();
  const Eigen::LDLT<Eigen::MatrixXd> factor(scale.asDiagonal() * s * scale.asDiagonal());
  Eigen::MatrixXd w = factor.transpositionsP() * Eigen::MatrixXd(scale.asDiagonal());
  factor.matrixL().solveInPlace(w);
  for (Eigen::Index k = 0; k < w.rows(); ++k) {
    const double pivot = factor.vectorD()[k];
    w.row(k) *= pivot > kVanishing ? 1.0 / std::sqrt(pivot) : 0.0;
  }
  return w;
}

}  // namespace

PosteriorBound::PosteriorBound(const OdometryNoise& noise, const Pose& start,
                               std::vector<Eigen::Vector2d> landmarks)
    : noise_(noise),
      landmarks_(std::move(landmarks)),
      pose_{start, Eigen::Matrix3d::Zero()},
      row_(landmarks_.size(), 0) {
  const auto most = static_cast<Eigen::Index>(3 + 2 * landmarks_.size());
  joint_ = Eigen::MatrixXd::Zero(most, most);
}

void PosteriorBound::move(const Control& control) {
  long repairs = 0;  // a first-order motion repairs nothing
  const Eigen::Vector2d control_sd = standard_deviations(control, noise_);
  const PoseBelief moved = Linearised().move(pose_, control, control_sd, repairs);
  const PoseBelief from_known =
      Linearised().move({pose_.mean, Eigen::Matrix3d::Zero()}, control, control_sd, repairs);
  const Eigen::Index rest = size_ - 3;
  const Eigen::Matrix3d slope = lever(pose_.mean, moved.mean);
  smoother_.move(slope, from_known.covariance);
  joint_.block(3, 0, rest, 3) *= slope.transpose();
  joint_.block(0, 3, 3, rest) = joint_.block(3, 0, rest, 3).transpose();
  joint_.topLeftCorner<3, 3>() = moved.covariance;
  pose_ = moved;
}

void PosteriorBound::look(std::span<const TrueSighting> frame) {
  std::vector<TrueSighting> known;
  for (const TrueSighting& sighting : frame) {
    if (sighting.landmark < 0 || sighting.landmark >= static_cast<int>(landmarks_.size()))
      throw std::invalid_argument("PosteriorBound: there is no such landmark");
    if (row_[static_cast<std::size_t>(sighting.landmark)] == 0) {
      add(sighting);
    } else {
      known.push_back(sighting);
    }
  }
  if (!known.empty()) inform(known);
  tell_smoother(frame);
}

/// First sightings too: to a smoother they are sightings like others.
void PosteriorBound::tell_smoother(std::span<const TrueSighting> frame) {
  std::vector<WhitenedSighting> seen;
  for (const TrueSighting& sighting : frame) {
    const auto index = static_cast<std::size_t>(sighting.landmark);
    const LinearSighting linear = linearise_sighting(pose_.mean, landmarks_[index]);
    seen.push_back(whitened(row_[index], linear.by_pose(), linear.by_landmark, sighting.noise));
  }
  smoother_.look(seen);
}

std::optional<Eigen::Matrix2d> PosteriorBound::landmark(int index) const {
  const Eigen::Index row = row_.at(static_cast<std::size_t>(index));
  if (row == 0) return {};
  return joint_.block<2, 2>(row, row);
}

/// A landmark of which nothing is known but this sighting: place = locate(pose, sighting).
void PosteriorBound::add(const TrueSighting& sighting) {
  const auto index = static_cast<std::size_t>(sighting.landmark);
  const Pose& robot = pose_.mean;
  long repairs = 0;  // nothing that is found needs repair
  const Observation seen{predict_sighting(robot, landmarks_[index]), sighting.noise};
  const Eigen::Matrix2d own = Linearised().found(robot, seen, repairs).covariance;
  const Pose place{landmarks_[index].x(), landmarks_[index].y(), 0.0};
  const Eigen::Matrix<double, 2, 3> slope = lever(robot, place).topRows<2>();
  const Eigen::Index row = size_;
  joint_.block(row, 0, 2, row) = slope * joint_.block(0, 0, 3, row);
  joint_.block(0, row, row, 2) = joint_.block(row, 0, 2, row).transpose();
  joint_.block<2, 2>(row, row) = joint_.block<2, 3>(row, 0) * slope.transpose() + own;
  row_[index] = row;
  size_ += 2;
}

/// Sightings of landmarks that have been seen before, all at once.
void PosteriorBound::inform(std::span<const TrueSighting> frame) {
  const auto rows = static_cast<Eigen::Index>(2 * frame.size());
  auto joint = joint_.topLeftCorner(size_, size_);
  Eigen::SparseMatrix<double> slope(rows, size_);
  Eigen::MatrixXd innovation = Eigen::MatrixXd::Zero(rows, rows);
  for (Eigen::Index k = 0; k < rows; k += 2) {
    const TrueSighting& sighting = frame[static_cast<std::size_t>(k / 2)];
    const auto index = static_cast<std::size_t>(sighting.landmark);
    const LinearSighting linear = linearise_sighting(pose_.mean, landmarks_[index]);
    for (Eigen::Index i = k; i < k + 2; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) slope.insert(i, j) = linear.by_pose()(i - k, j);
      for (Eigen::Index j = 0; j < 2; ++j) slope.insert(i, row_[index] + j) = linear.by_landmark(i - k, j);
    }
    innovation.block<2, 2>(k, k) = sighting.noise;
  }
  const Eigen::MatrixXd cross = slope * joint;
  innovation += cross * slope.transpose();
  const Eigen::MatrixXd white = whitener(innovation);
  const Eigen::MatrixXd white_cross = white * cross;
  joint.selfadjointView<Eigen::Lower>().rankUpdate(white_cross.transpose(), -1.0);
  joint.triangularView<Eigen::StrictlyUpper>() = joint.transpose();
  pose_.covariance = joint.topLeftCorner<3, 3>();
}

}  // namespace stereobench::slam
