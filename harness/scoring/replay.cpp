#include "harness/scoring/replay.h"

#include <cmath>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "harness/scoring/association_score.h"
#include "harness/scoring/particle_set.h"

namespace stereobench::harness {

namespace {

bool is_finite(const slam::Estimate& estimate) {
  return std::isfinite(estimate.pose.x_m) && std::isfinite(estimate.pose.y_m) &&
         std::isfinite(estimate.pose.heading_rad) && estimate.covariance.allFinite();
}

using Ancestors = std::vector<std::vector<int>>;  ///< by step

/// @return false when the estimate after the step is not finite
bool drive_step(slam::Filter& filter, const LogStep& step, FilterRun& run, Ancestors& ancestors) {
  for (const slam::Control& control : step.odometry) slam::predict(filter, control);
  slam::update(filter, step.measurements);
  const slam::Estimate estimate = slam::estimate_without_map(filter);
  if (!is_finite(estimate)) return false;
  run.poses.push_back(estimate.pose);
  run.covariances.push_back(estimate.covariance);
  slam::UpdateReport report = slam::last_update(filter);
  run.updates.push_back({std::move(report.innovations), estimate.effective_particles});
  ancestors.push_back(std::move(report.ancestors));
  return true;
}

void add_ancestors(const Ancestors& ancestors, FilterRun& run) {
  const std::vector<int> distinct = distinct_ancestors(ancestors, run.particles);
  for (std::size_t k = 0; k < run.updates.size(); ++k) run.updates[k].distinct_ancestors = distinct[k];
}

}  // namespace

FilterRun replay(const MeasurementLog& log, const std::string& filter, slam::FilterConfig config,
                 std::uint64_t seed) {
  config.report_updates = true;
  FilterRun run;
  run.filter = filter;
  run.seed = seed;
  slam::Filter state = slam::make_filter(filter, config, log.start, seed);
  run.particles = slam::particle_count(state);
  const std::vector<int> truth = true_landmarks(log);
  if (!truth.empty()) run.association.emplace();
  Ancestors ancestors;
  try {
    for (const LogStep& step : log.steps) {
      const bool finite = drive_step(state, step, run, ancestors);
      if (run.association) judge(slam::last_decisions(state), truth, *run.association);
      if (finite) continue;
      run.failed = true;
      run.failure = fmt::format("step {}: the estimate is not finite", run.poses.size());
      break;
    }
    run.last = slam::estimate(state);
    if (run.association) judge_map(run.last.landmarks, truth, *run.association);
  } catch (const std::exception& error) {
    run.failed = true;
    run.failure = fmt::format("step {}: {}", run.poses.size(), error.what());
  }
  add_ancestors(ancestors, run);
  return run;
}

}  // namespace stereobench::harness
