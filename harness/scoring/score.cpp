#include "harness/scoring/score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace stereobench::harness {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

FilterScore failed_score() {
  FilterScore score;
  score.failed = true;
  score.trajectory = score_trajectory({});
  score.ate_aligned_at_sightings_rms_m = kNone;
  score.map.rms_m = score.map.max_m = kNone;
  score.map_aligned = score.map_path_aligned = score.map;
  return score;
}

/// The aligned error of the steps at which something was seen.
double aligned_rms_at_sightings(const FilterRun& run, const MeasurementLog& log) {
  MeasurementLog seen;
  std::vector<slam::Pose> poses;
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    if (log.steps[i].measurements.empty()) continue;
    seen.steps.push_back({log.steps[i].stamp_ns, {}, {}, log.steps[i].truth});
    poses.push_back(run.poses[i]);
  }
  return score_trajectory(pair_with_truth(poses, seen)).ate_aligned_rms_m;
}

/// One metric of all runs that did not fail.
template <typename Metric>
std::vector<double> collect(std::span<const FilterScore> scores, Metric metric) {
  std::vector<double> values;
  for (const FilterScore& score : scores) {
    if (!score.failed) values.push_back(metric(score));
  }
  return values;
}

double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return kNone;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

void add_map_counts(std::span<const FilterScore> scores, FilterSummary& summary) {
  for (const FilterScore& score : scores) {
    summary.failures += score.failed ? 1 : 0;
    summary.landmarks_found_once += score.map.found_once;
    summary.landmarks_duplicated += score.map.duplicated;
    summary.landmarks_missed += score.map.missed;
    summary.landmarks_spurious += score.map.spurious;
  }
}

/// Of one run, over its steps: an average, from which nothing can be tested, for its steps hang together.
double mean_normalised_error(const FilterScore& score) {
  SquaredSum sum;
  for (const std::optional<SquaredSum>& step : score.normalised_errors) sum += step.value_or(SquaredSum{});
  return sum.ratio();
}

void add_consistency(std::span<const FilterScore> scores, Seeds seeds, FilterSummary& summary) {
  std::vector<std::vector<std::optional<SquaredSum>>> runs;
  std::vector<ConsistencyScore> consistency;
  for (const FilterScore& score : scores) {
    if (score.failed) continue;
    runs.push_back(score.normalised_errors);
    consistency.push_back(score.consistency);
  }
  summary.nees_by_step = sum_over_seeds(runs, seeds);
  summary.anees = summarise(collect(scores, mean_normalised_error));
  summary.nees = judge_steps(summary.nees_by_step);
  summary.consistency = summarise(consistency, seeds);
}

}  // namespace

FilterScore score(const FilterRun& run, const MeasurementLog& log) {
  if (run.failed) return failed_score();
  if (run.poses.size() != log.steps.size() || run.covariances.size() != log.steps.size()) {
    throw std::invalid_argument("score: expected one pose and covariance for each step of the log");
  }
  FilterScore score;
  score.trajectory = score_trajectory(pair_with_truth(run.poses, log));
  score.ate_aligned_at_sightings_rms_m = aligned_rms_at_sightings(run, log);
  score.map = score_map(run.last.landmarks, log.landmarks);
  score.map_aligned =
      score_map(run.last.landmarks, log.landmarks, align_map(run.last.landmarks, log.landmarks));
  score.map_path_aligned = score_map(run.last.landmarks, log.landmarks, score.trajectory.truth_from_estimate);
  score.normalised_errors = normalised_errors(run, log);
  score.consistency = score_consistency(run, log);
  return score;
}

FilterSummary summarise(std::span<const FilterScore> scores, int particles, Seeds seeds) {
  const auto over_seeds = [&](auto metric) { return summarise(collect(scores, metric)); };
  const auto aligned = [](const FilterScore& s) { return s.trajectory.ate_aligned_rms_m; };
  FilterSummary summary;
  summary.particles = particles;
  summary.ate_rms_m = over_seeds([](const FilterScore& s) { return s.trajectory.ate_rms_m; });
  summary.ate_max_m = over_seeds([](const FilterScore& s) { return s.trajectory.ate_max_m; });
  summary.ate_aligned_rms_m = over_seeds(aligned);
  summary.ate_aligned_median_m = median(collect(scores, aligned));
  summary.ate_aligned_at_sightings_rms_m =
      over_seeds([](const FilterScore& s) { return s.ate_aligned_at_sightings_rms_m; });
  summary.heading_rms_rad = over_seeds([](const FilterScore& s) { return s.trajectory.heading_rms_rad; });
  summary.rpe_rms_m = over_seeds([](const FilterScore& s) { return s.trajectory.rpe_rms_m; });
  summary.final_drift = over_seeds([](const FilterScore& s) { return s.trajectory.final_drift; });
  summary.landmark_rms_m = over_seeds([](const FilterScore& s) { return s.map.rms_m; });
  summary.landmark_aligned_rms_m = over_seeds([](const FilterScore& s) { return s.map_aligned.rms_m; });
  summary.landmark_path_aligned_rms_m =
      over_seeds([](const FilterScore& s) { return s.map_path_aligned.rms_m; });
  add_consistency(scores, seeds, summary);
  add_map_counts(scores, summary);
  return summary;
}

}  // namespace stereobench::harness
