#include "harness/scoring/references.h"

#include <cmath>
#include <stdexcept>

#include "harness/logs/sensor_log.h"
#include "harness/scoring/measured_landmark.h"
#include "slam/models/uncertain_start.h"
#include "slam/reference/batch.h"
#include "slam/reference/posterior_bound.h"

namespace stereobench::harness {
namespace {

template <typename Matrix, typename Size>
double rms(const std::vector<Matrix>& covariances, Size size_squared) {
  double sum = 0.0;
  for (const Matrix& covariance : covariances) sum += size_squared(covariance);
  return std::sqrt(sum / static_cast<double>(covariances.size()));  // 0 / 0: nothing has no size
}

}  // namespace

BoundRun replay_bound(const MeasurementLog& log, const worlds::GroundTruth& path,
                      const slam::OdometryNoise& noise, const Eigen::Matrix3d& start_covariance) {
  if (path.size() != log.steps.size())
    throw std::invalid_argument("replay_bound: expected one step of the path for each step of the log");
  std::vector<Eigen::Vector2d> places;
  for (const LandmarkTruth& landmark : log.landmarks) places.push_back(landmark.position_m);
  slam::PosteriorBound bound(noise, log.start, places);
  const slam::UncertainStart start(log.start, start_covariance);
  BoundRun run;
  for (std::size_t k = 0; k < path.size(); ++k) {
    for (const slam::Control& control : path[k].controls) bound.move(control);
    std::vector<slam::TrueSighting> frame;
    const LogStep& step = log.steps[k];
    for (std::size_t i = 0; i < step.measurements.size(); ++i) {
      const auto landmark = measured_landmark(step, i, log.landmarks);
      if (landmark) frame.push_back({static_cast<int>(*landmark), step.measurements[i].covariance});
    }
    bound.look(frame);
    run.poses.push_back(start.of_pose(path[k].pose, bound.pose().covariance));
  }
  for (const Eigen::Matrix3d& covariance : bound.smoothed_poses())
    run.smoothed_poses.push_back(start.of_pose(path[run.smoothed_poses.size()].pose, covariance));
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (const auto covariance = bound.landmark(static_cast<int>(i)))
      run.landmarks.push_back(start.of_place(places[i], *covariance));
  }
  return run;
}

FilterRun replay_batch(const MeasurementLog& log, const slam::FilterConfig& config) {
  const SensorLog measured = sensor_log(log);
  const slam::BatchEstimate batch = slam::estimate_batch(config, measured.start, measured.steps);
  FilterRun run{.filter = "batch", .poses = batch.path};
  run.covariances.assign(batch.path.size(), Eigen::Matrix3d::Zero());
  run.last.landmarks = batch.landmarks;
  if (!batch.path.empty()) run.last.pose = batch.path.back();
  run.failed = !batch.converged;
  if (run.failed) run.failure = "the search did not converge";
  return run;
}

BoundScores score(const BoundRun& run) {
  const double landmark_rms_m = rms(run.landmarks, [](const Eigen::Matrix2d& p) { return p.trace(); });
  const auto of_poses = [&](const std::vector<Eigen::Matrix3d>& poses) -> BoundScore {
    return {rms(poses, [](const Eigen::Matrix3d& p) { return p(0, 0) + p(1, 1); }),
            rms(poses, [](const Eigen::Matrix3d& p) { return p(2, 2); }), landmark_rms_m};
  };
  return {of_poses(run.poses), of_poses(run.smoothed_poses)};
}

void Efficiency::add(const FilterScore& score, const BoundScore& bound) {
  if (score.failed) return;
  errors_m2 += score.trajectory.ate_rms_m * score.trajectory.ate_rms_m;
  least_m2 += bound.pose_rms_m * bound.pose_rms_m;
}

double Efficiency::ratio() const {
  return std::sqrt(errors_m2 / least_m2);  // 0 / 0: nothing to compare
}

}  // namespace stereobench::harness
