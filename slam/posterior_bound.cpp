#include "slam/posterior_bound.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>

#include "slam/linearised.h"
#include "slam/measurement.h"
#include "slam/motion.h"

namespace stereobench::slam {
namespace {

/// d(x, y, heading) / d(x0, y0, heading0) of any motion that leads from one pose to another.
Eigen::Matrix3d lever(const Pose& from, const Pose& to) {
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  slope.col(2).head<2>() = swing(from, {to.x_m, to.y_m});
  return slope;
}

/// W with W' W = C' S^+ C, for a semidefinite S and a C that vanishes where S does.
Eigen::MatrixXd whitened(const Eigen::MatrixXd& c, const Eigen::MatrixXd& s) {
  constexpr double kVanishing = 1e-12;  // of correlations, in which metres and radians are alike
  const Eigen::VectorXd scale =
      (s.diagonal().array() > 0.0).select(s.diagonal().array().rsqrt(), 0.0).matrix();
  const Eigen::LDLT<Eigen::MatrixXd> factor(scale.asDiagonal() * s * scale.asDiagonal());
  Eigen::MatrixXd w = factor.transpositionsP() * (scale.asDiagonal() * c);
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
  long repairs = 0;  // a first-order motion mends nothing
  const PoseBelief moved = Linearised().move(pose_, control, standard_deviations(control, noise_), repairs);
  const Eigen::Index rest = size_ - 3;
  joint_.block(3, 0, rest, 3) *= lever(pose_.mean, moved.mean).transpose();
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
  long repairs = 0;  // nothing that is found needs mending
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
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(rows, size_);
  Eigen::MatrixXd cross(rows, size_);
  Eigen::MatrixXd surprise = Eigen::MatrixXd::Zero(rows, rows);
  for (Eigen::Index k = 0; k < rows; k += 2) {
    const TrueSighting& sighting = frame[static_cast<std::size_t>(k / 2)];
    const auto index = static_cast<std::size_t>(sighting.landmark);
    const LinearSighting linear = linearise_sighting(pose_.mean, landmarks_[index]);
    slope.block<2, 3>(k, 0) = linear.by_pose();
    slope.block<2, 2>(k, row_[index]) = linear.by_landmark;
    cross.middleRows<2>(k) =
        linear.by_pose() * joint.topRows<3>() + linear.by_landmark * joint.middleRows<2>(row_[index]);
    surprise.block<2, 2>(k, k) = sighting.noise;
  }
  surprise += cross * slope.transpose();
  joint.selfadjointView<Eigen::Lower>().rankUpdate(whitened(cross, surprise).transpose(), -1.0);
  joint.triangularView<Eigen::StrictlyUpper>() = joint.transpose();
  pose_.covariance = joint.topLeftCorner<3, 3>();
}

}  // namespace stereobench::slam
