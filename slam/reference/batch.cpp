#include "slam/reference/batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include <ceres/ceres.h>

#include "slam/filter_registry.h"
#include "slam/math/gaussian.h"
#include "slam/models/linearised.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"
#include "slam/models/noise_law.h"
#include "slam/models/residuals.h"

namespace stereobench::slam {
namespace {

constexpr int kParticles = 10;         ///< of the filter whose estimate the search starts from
constexpr int kMostIterations = 1000;  ///< most logs take a tenth of it
constexpr double kTolerance = 1e-9;  ///< of the cost, some thousands: what is left is no part of a deviation

using PoseBlock = std::array<double, 3>;
using PlaceBlock = std::array<double, 2>;

Pose pose_of(const double* block) {
  return {block[0], block[1], block[2]};
}

/// Copies a derivative to where Ceres wants it, which does not ask for those of what is held fast.
template <int kRows, int kCols>
void hand_over(const Eigen::Matrix<double, kRows, kCols>& slope, double* out) {
  if (out != nullptr) Eigen::Map<Eigen::Matrix<double, kRows, kCols, Eigen::RowMajor>>{out} = slope;
}

class MotionCost : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit MotionCost(const MotionResidual& residual) : residual_(residual) {}
  bool Evaluate(double const* const* blocks, double* residual, double** slopes) const override {
    const MotionResidual::Value value = residual_.at(pose_of(blocks[0]), pose_of(blocks[1]));
    Eigen::Map<Eigen::Vector3d>{residual} = value.residual;
    if (slopes != nullptr) hand_over<3, 3>(value.by_from, slopes[0]);
    if (slopes != nullptr) hand_over<3, 3>(value.by_to, slopes[1]);
    return true;
  }

 private:
  MotionResidual residual_;
};

class SightingCost : public ceres::SizedCostFunction<2, 3, 2> {
 public:
  explicit SightingCost(const SightingResidual& residual) : residual_(residual) {}
  bool Evaluate(double const* const* blocks, double* residual, double** slopes) const override {
    const SightingResidual::Value value = residual_.at(pose_of(blocks[0]), {blocks[1][0], blocks[1][1]});
    Eigen::Map<Eigen::Vector2d>{residual} = value.residual;
    if (slopes != nullptr) hand_over<2, 3>(value.by_pose, slopes[0]);
    if (slopes != nullptr) hand_over<2, 2>(value.by_landmark, slopes[1]);
    return true;
  }

 private:
  SightingResidual residual_;
};

/// What a filter makes of the log, step by step.
BatchEstimate filtered(FilterConfig config, const Pose& start, std::span<const BatchStep> steps) {
  config.particles = kParticles;
  Filter filter = make_filter("fastslam2_iterated", config, start, 0);
  BatchEstimate estimate;
  for (const BatchStep& step : steps) {
    for (const Control& control : step.controls) predict(filter, control);
    update(filter, step.sightings);
    estimate.path.push_back(estimate_without_map(filter).pose);
  }
  estimate.landmarks = slam::estimate(filter).landmarks;
  for (LandmarkEstimate& landmark : estimate.landmarks) landmark.covariance.setZero();
  return estimate;
}

bool is_finite(const BatchEstimate& estimate) {
  return std::ranges::all_of(estimate.path,
                             [](const Pose& pose) {
                               return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) &&
                                      std::isfinite(pose.heading_rad);
                             }) &&
         std::ranges::all_of(estimate.landmarks, [](const LandmarkEstimate& landmark) {
           return landmark.position_m.allFinite();
         });
}

/// The landmark that a sighting from a pose is of, as an index.
std::optional<std::size_t> owner(const std::vector<LandmarkEstimate>& landmarks, const Pose& robot,
                                 const RangeBearing& sighting) {
  const Eigen::Vector2d place = locate(robot, {sighting.range_m, sighting.bearing_rad});
  std::optional<std::size_t> nearest;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (landmarks[i].landmark_id != sighting.landmark_id) continue;
    if (sighting.landmark_id != kUnknown) return i;
    const double distance_m = (landmarks[i].position_m - place).norm();
    if (landmarks[i].colour_class != sighting.colour_class || distance_m >= nearest_m) continue;
    nearest = i;
    nearest_m = distance_m;
  }
  return nearest;
}

/// The search for the best path and map.
class PathSearch {
 public:
  PathSearch(const FilterConfig& config, const Pose& start, const BatchEstimate& first)
      : config_(config), estimate_(first), poses_{{start.x_m, start.y_m, start.heading_rad}} {
    for (const Pose& pose : first.path) poses_.push_back({pose.x_m, pose.y_m, pose.heading_rad});
    for (const LandmarkEstimate& landmark : first.landmarks)
      places_.push_back({landmark.position_m.x(), landmark.position_m.y()});
    if (config.gate_probability < 1.0)
      loss_ = std::make_unique<ceres::CauchyLoss>(std::sqrt(chi_square_2_quantile(config.gate_probability)));
    problem_.AddParameterBlock(poses_.front().data(), 3);
    problem_.SetParameterBlockConstant(poses_.front().data());
  }

  /// @param index of the step, each once
  void add(std::size_t index, const BatchStep& step) {
    add_motion(index, step.controls);
    for (const RangeBearing& sighting : step.sightings)
      if (is_valid(sighting)) add_sighting(index, sighting);
  }

  BatchEstimate solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    // Eigen's, for the same bytes everywhere: CHOLMOD's depend on which BLAS is installed.
    options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    options.num_threads = 1;
    options.use_nonmonotonic_steps = true;
    options.max_num_iterations = kMostIterations;
    options.function_tolerance = kTolerance;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    for (std::size_t k = 0; k < estimate_.path.size(); ++k) {
      estimate_.path[k] = pose_of(poses_[k + 1].data());
      estimate_.path[k].heading_rad = wrap_angle(estimate_.path[k].heading_rad);
    }
    for (std::size_t i = 0; i < places_.size(); ++i)
      estimate_.landmarks[i].position_m = {places_[i][0], places_[i][1]};
    estimate_.converged = summary.termination_type == ceres::CONVERGENCE;
    return estimate_;
  }

 private:
  void add_motion(std::size_t index, const std::vector<Control>& controls) {
    PoseBelief motion;
    FilterCounters counters;  // the filters count too
    for (const Control& control : controls)
      slam::move(motion, Linearised(), control, config_.odometry_noise, counters);
    problem_.AddResidualBlock(new MotionCost(MotionResidual(motion)), nullptr, poses_[index].data(),
                              poses_[index + 1].data());
  }

  void add_sighting(std::size_t index, const RangeBearing& sighting) {
    const auto landmark = owner(estimate_.landmarks, estimate_.path[index], sighting);
    if (!landmark) return;
    Observation observation = observe(sighting, config_);
    const Eigen::Vector2d& place = estimate_.landmarks[*landmark].position_m;
    observation.noise = noise_at(observation, predict_sighting(estimate_.path[index], place));
    problem_.AddResidualBlock(new SightingCost(SightingResidual(observation)), loss_.get(),
                              poses_[index + 1].data(), places_[*landmark].data());
  }

  FilterConfig config_;
  BatchEstimate estimate_;
  std::vector<PoseBlock> poses_;  ///< the start, then one a step
  std::vector<PlaceBlock> places_;
  std::unique_ptr<ceres::LossFunction> loss_;  ///< none: plain squares
  ceres::Problem problem_{{.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP}};
};

}  // namespace

BatchEstimate estimate_batch(const FilterConfig& config, const Pose& start,
                             std::span<const BatchStep> steps) {
  const BatchEstimate first = filtered(config, start, steps);
  if (!is_finite(first)) return first;
  PathSearch search(without_floor(config), start, first);
  for (std::size_t k = 0; k < steps.size(); ++k) search.add(k, steps[k]);
  return search.solve();
}

}  // namespace stereobench::slam
