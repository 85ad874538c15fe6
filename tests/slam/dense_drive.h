// A short drive as one function of all that is unknown in it: the errors of its controls and the places of
// its landmarks. Slow, dense, with numeric derivatives, and without any covariance that is singular: what the
// references are checked against.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {

struct DenseSighting {
  int landmark = 0;
  Eigen::Vector2d range_bearing = Eigen::Vector2d::Zero();
  Eigen::Matrix2d noise = Eigen::Matrix2d::Identity();
};

struct DenseStep {
  std::vector<Control> controls;
  std::vector<DenseSighting> sightings;
};

class DenseDrive {
 public:
  // Unknowns: (v, w) errors of the controls in their order, each in standard deviations, then x and y of the
  // landmarks.
  DenseDrive(const OdometryNoise& noise, const Pose& start, std::vector<DenseStep> steps, int landmarks)
      : noise_(noise), start_(start), steps_(std::move(steps)), landmarks_(landmarks) {
    for (const DenseStep& step : steps_) controls_ += static_cast<Eigen::Index>(step.controls.size());
  }

  Eigen::Index unknowns() const { return 2 * controls_ + 2 * landmarks_; }
  Eigen::Index place_of(int landmark) const { return 2 * controls_ + 2 * landmark; }

  // No errors, and landmarks at the given places.
  Eigen::VectorXd unknowns_at(const std::vector<Eigen::Vector2d>& places) const {
    Eigen::VectorXd at = Eigen::VectorXd::Zero(unknowns());
    for (int i = 0; i < landmarks_; ++i) at.segment<2>(place_of(i)) = places[static_cast<std::size_t>(i)];
    return at;
  }

  // The pose after each step, headings not wrapped.
  std::vector<Eigen::Vector3d> path(const Eigen::VectorXd& at) const {
    std::vector<Eigen::Vector3d> poses;
    Pose pose = start_;
    double heading_rad = start_.heading_rad;
    Eigen::Index next = 0;
    for (const DenseStep& step : steps_) {
      for (Control control : step.controls) {
        const Eigen::Vector2d sd = standard_deviations(control, noise_);
        control.v_mps += sd.x() * at[next++];
        control.w_radps += sd.y() * at[next++];
        pose = advance(pose, control);
        heading_rad += control.w_radps * control.duration_s;
      }
      poses.push_back({pose.x_m, pose.y_m, heading_rad});
    }
    return poses;
  }

  // All that is known up to a step as residuals of unit variance: the errors themselves, and the sightings.
  Eigen::VectorXd residuals(const Eigen::VectorXd& at, std::size_t steps) const {
    const std::vector<Eigen::Vector3d> poses = path(at);
    std::vector<double> values(at.data(), at.data() + 2 * controls_);
    for (std::size_t k = 0; k < steps; ++k) {
      const Pose robot{poses[k].x(), poses[k].y(), poses[k].z()};
      for (const DenseSighting& sighting : steps_[k].sightings) {
        const Eigen::Vector2d expected = predict_sighting(robot, at.segment<2>(place_of(sighting.landmark)));
        const Eigen::Matrix2d root = sighting.noise.llt().matrixL();
        const Eigen::Vector2d white = root.inverse() * sighting_residual(expected, sighting.range_bearing);
        values.insert(values.end(), {white.x(), white.y()});
      }
    }
    return Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

  // The inverse of the information in all that is known up to a step; huge where nothing is.
  Eigen::MatrixXd covariance(const Eigen::VectorXd& at, std::size_t steps) const {
    const Eigen::MatrixXd slope =
        derivative(at, [&](const Eigen::VectorXd& x) { return residuals(x, steps); });
    Eigen::MatrixXd information = slope.transpose() * slope;
    information.diagonal().array() += 1e-12;  // a landmark that has not been seen yet
    return information.inverse();
  }

  // The covariance of the pose after a step (counted from 1), given that of the unknowns.
  Eigen::Matrix3d pose_covariance(const Eigen::VectorXd& at, const Eigen::MatrixXd& covariance,
                                  std::size_t step) const {
    const Eigen::MatrixXd slope =
        derivative(at, [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(path(x)[step - 1]); });
    return slope * covariance * slope.transpose();
  }

  // The unknowns that explain everything best, by Gauss-Newton.
  Eigen::VectorXd solve(Eigen::VectorXd at) const {
    for (int iteration = 0; iteration < 20; ++iteration) {
      const auto all = [&](const Eigen::VectorXd& x) { return residuals(x, steps_.size()); };
      const Eigen::MatrixXd slope = derivative(at, all);
      at -= (slope.transpose() * slope).ldlt().solve(slope.transpose() * all(at));
    }
    return at;
  }

 private:
  static Eigen::MatrixXd derivative(const Eigen::VectorXd& at,
                                    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f) {
    constexpr double kStep = 1e-4;
    Eigen::MatrixXd slope(f(at).size(), at.size());
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      Eigen::VectorXd above = at;
      Eigen::VectorXd below = at;
      above[i] += kStep;
      below[i] -= kStep;
      slope.col(i) = (f(above) - f(below)) / (2.0 * kStep);
    }
    return slope;
  }

  OdometryNoise noise_;
  Pose start_;
  std::vector<DenseStep> steps_;
  int landmarks_;
  Eigen::Index controls_ = 0;
};

}  // namespace stereobench::slam
