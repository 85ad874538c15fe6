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

void fail(FilterRun& run, const std::string& why) {
  run.failed = true;
  run.failure = fmt::format("step {}: {}", run.poses.size(), why);
}

}  // namespace

FilterReplay::FilterReplay(const std::string& filter, slam::FilterConfig config, const slam::Pose& start,
                           std::uint64_t seed)
    : run_{.filter = filter, .seed = seed}, state_([&] {
        config.report_updates = true;
        return slam::make_filter(filter, config, start, seed);
      }()) {
  run_.particles = slam::particle_count(state_);
}

/// @return false when the estimate after the step is not finite
bool FilterReplay::drive(const LogStep& step) {
  for (const slam::Control& control : step.odometry) slam::predict(state_, control);
  slam::update(state_, step.measurements);
  const slam::Estimate estimate = slam::estimate_without_map(state_);
  if (!is_finite(estimate)) return false;
  run_.poses.push_back(estimate.pose);
  run_.covariances.push_back(estimate.covariance);
  slam::UpdateReport report = slam::last_update(state_);
  run_.updates.push_back({std::move(report.innovations), estimate.effective_particles});
  ancestors_.push_back(std::move(report.ancestors));
  return true;
}

void FilterReplay::step(const LogStep& step, std::span<const int> truth) {
  if (run_.failed) return;
  if (!truth.empty() && !run_.association) run_.association.emplace();
  try {
    const bool finite = drive(step);
    if (!truth.empty()) judge(slam::last_decisions(state_), truth, *run_.association);
    if (!finite) fail(run_, "the estimate is not finite");
  } catch (const std::exception& error) {
    fail(run_, error.what());
    has_thrown_ = true;
  }
}

FilterRun FilterReplay::run(std::span<const int> truth) const {
  FilterRun run = run_;
  if (truth.empty()) run.association.reset();
  try {
    if (!has_thrown_) run.last = slam::estimate(state_);
    if (run.association && !has_thrown_) judge_map(run.last.landmarks, truth, *run.association);
  } catch (const std::exception& error) {
    fail(run, error.what());
  }
  const std::vector<int> distinct = distinct_ancestors(ancestors_, run.particles);
  for (std::size_t k = 0; k < run.updates.size(); ++k) run.updates[k].distinct_ancestors = distinct[k];
  return run;
}

FilterRun replay(const MeasurementLog& log, const std::string& filter, slam::FilterConfig config,
                 std::uint64_t seed) {
  FilterReplay replay(filter, config, log.start, seed);
  const std::vector<int> truth = true_landmarks(log);
  for (const LogStep& step : log.steps) replay.step(step, truth);
  return replay.run(truth);
}

}  // namespace stereobench::harness
