// EKF-SLAM as textbooks write it: big matrices, one line a formula, a prediction for each control.
//
// Independent of the filter under test down to the motion: Thrun, Burgard and Fox, Probabilistic Robotics,
// tables 5.3, 7.2 and 10.1, which divide by the turn rate.
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "slam/types.h"

namespace stereobench::slam {

class DenseEkf {
 public:
  explicit DenseEkf(const Pose& start) : mean_(Eigen::Vector3d(start.x_m, start.y_m, start.heading_rad)) {}

  // @param control with a turn rate that is not zero
  void predict(const Control& control, const Eigen::Vector2d& control_sd) {
    const double v = control.v_mps, w = control.w_radps, dt = control.duration_s;
    const double before = mean_(2), after = before + w * dt;
    const double s = std::sin(after) - std::sin(before), c = std::cos(before) - std::cos(after);
    Eigen::MatrixXd by_state = Eigen::MatrixXd::Identity(mean_.size(), mean_.size());
    by_state(0, 2) = -v / w * c;
    by_state(1, 2) = v / w * s;
    Eigen::MatrixXd by_control = Eigen::MatrixXd::Zero(mean_.size(), 2);
    by_control.topRows<3>() << s / w, -v / (w * w) * s + v / w * std::cos(after) * dt,  //
        c / w, -v / (w * w) * c + v / w * std::sin(after) * dt,                         //
        0.0, dt;
    const Eigen::Matrix2d noise = control_sd.cwiseAbs2().asDiagonal();
    mean_.head<3>() += Eigen::Vector3d(v / w * s, v / w * c, w * dt);
    covariance_ = by_state * covariance_ * by_state.transpose() + by_control * noise * by_control.transpose();
  }

  // Known landmarks, oldest first, then the new ones; each with an identity, none twice.
  void update(const std::vector<RangeBearing>& frame) {
    std::map<Eigen::Index, RangeBearing> known;
    for (const RangeBearing& seen : frame) {
      if (first_row_.contains(seen.landmark_id)) known[first_row_[seen.landmark_id]] = seen;
    }
    for (const auto& [row, seen] : known) correct(row, seen);
    for (const RangeBearing& seen : frame) {
      if (!first_row_.contains(seen.landmark_id)) add(seen);
    }
  }

  Pose pose() const { return {mean_(0), mean_(1), std::remainder(mean_(2), 2.0 * M_PI)}; }
  Eigen::Matrix3d covariance() const { return covariance_.topLeftCorner<3, 3>(); }
  Eigen::Vector2d landmark(int id) const { return mean_.segment<2>(first_row_.at(id)); }
  Eigen::Matrix2d landmark_covariance(int id) const {
    return covariance_.block<2, 2>(first_row_.at(id), first_row_.at(id));
  }

 private:
  void correct(Eigen::Index row, const RangeBearing& seen) {
    const Eigen::Vector2d d = mean_.segment<2>(row) - mean_.head<2>();
    const double q = d.squaredNorm(), r = std::sqrt(q);
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(2, mean_.size());
    slope.leftCols<3>() << -d.x() / r, -d.y() / r, 0.0, d.y() / q, -d.x() / q, -1.0;
    slope.middleCols<2>(row) << d.x() / r, d.y() / r, -d.y() / q, d.x() / q;
    Eigen::Vector2d innovation(seen.range_m - r, seen.bearing_rad - (std::atan2(d.y(), d.x()) - mean_(2)));
    innovation(1) = std::atan2(std::sin(innovation(1)), std::cos(innovation(1)));
    const Eigen::Matrix2d innovation_covariance = slope * covariance_ * slope.transpose() + seen.covariance;
    const Eigen::MatrixXd gain = covariance_ * slope.transpose() * innovation_covariance.inverse();
    mean_ += gain * innovation;
    covariance_ =
        ((Eigen::MatrixXd::Identity(mean_.size(), mean_.size()) - gain * slope) * covariance_).eval();
  }

  void add(const RangeBearing& seen) {
    const Eigen::Index size = mean_.size();
    const double r = seen.range_m, direction = mean_(2) + seen.bearing_rad;
    const double c = std::cos(direction), s = std::sin(direction);
    Eigen::MatrixXd by_state = Eigen::MatrixXd::Identity(size + 2, size);
    by_state.bottomRows<2>().leftCols<3>() << 1.0, 0.0, -r * s, 0.0, 1.0, r * c;
    Eigen::MatrixXd by_sighting = Eigen::MatrixXd::Zero(size + 2, 2);
    by_sighting.bottomRows<2>() << c, -r * s, s, r * c;
    const Eigen::Vector2d place = mean_.head<2>() + r * Eigen::Vector2d(c, s);
    mean_.conservativeResize(size + 2);
    mean_.tail<2>() = place;
    covariance_ = (by_state * covariance_ * by_state.transpose() +
                   by_sighting * seen.covariance * by_sighting.transpose())
                      .eval();
    first_row_[seen.landmark_id] = size;
  }

  Eigen::VectorXd mean_;
  Eigen::MatrixXd covariance_ = Eigen::MatrixXd::Zero(3, 3);
  std::map<int, Eigen::Index> first_row_;
};

}  // namespace stereobench::slam
