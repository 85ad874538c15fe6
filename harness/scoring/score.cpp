#include "harness/scoring/score.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "slam/models/motion.h"

namespace stereobench::harness {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

FilterScore failed_score() {
  FilterScore score;
  score.failed = true;
  score.trajectory = score_trajectory({});
  score.ate_aligned_at_sightings_rms_m = kNone;
  score.map = score.map_aligned = score.map_path_aligned = unknown_map_score();
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

double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return kNone;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Of one run, over its steps: an average, from which nothing can be tested, for its steps hang together.
double mean_normalised_error(const FilterScore& score) {
  SquaredSum sum;
  for (const std::optional<SquaredSum>& step : score.normalised_errors) sum += step.value_or(SquaredSum{});
  return sum.ratio();
}

/// A number of a run, and where its summary over the runs stands.
struct Metric {
  Summary FilterSummary::*summary;
  double (*of)(const FilterScore&);
};

constexpr auto kMetrics = std::to_array<Metric>({
    {&FilterSummary::ate_aligned_rms_m, [](const FilterScore& s) { return s.trajectory.ate_aligned_rms_m; }},
    {&FilterSummary::ate_rms_m, [](const FilterScore& s) { return s.trajectory.ate_rms_m; }},
    {&FilterSummary::ate_max_m, [](const FilterScore& s) { return s.trajectory.ate_max_m; }},
    {&FilterSummary::ate_aligned_at_sightings_rms_m,
     [](const FilterScore& s) { return s.ate_aligned_at_sightings_rms_m; }},
    {&FilterSummary::heading_rms_rad, [](const FilterScore& s) { return s.trajectory.heading_rms_rad; }},
    {&FilterSummary::rpe_rms_m, [](const FilterScore& s) { return s.trajectory.rpe_rms_m; }},
    {&FilterSummary::final_drift, [](const FilterScore& s) { return s.trajectory.final_drift; }},
    {&FilterSummary::landmark_rms_m, [](const FilterScore& s) { return s.map.rms_m; }},
    {&FilterSummary::landmark_aligned_rms_m, [](const FilterScore& s) { return s.map_aligned.rms_m; }},
    {&FilterSummary::landmark_path_aligned_rms_m,
     [](const FilterScore& s) { return s.map_path_aligned.rms_m; }},
    {&FilterSummary::anees, mean_normalised_error},
});

/// @return its index in kMetrics
constexpr std::size_t index_of(Summary FilterSummary::*metric) {
  const auto* const row = std::ranges::find(kMetrics, metric, &Metric::summary);
  return static_cast<std::size_t>(row - kMetrics.begin());
}

/// How many estimates have the identity of a true landmark.
long count_named(std::span<const slam::LandmarkEstimate> map, std::span<const LandmarkTruth> truth) {
  return std::ranges::count_if(map, [&](const slam::LandmarkEstimate& estimate) {
    return estimate.landmark_id != slam::kUnknown &&
           std::ranges::find(truth, estimate.landmark_id, &LandmarkTruth::landmark_id) != truth.end();
  });
}

std::optional<slam::Pose> frame_of(const FilterRun& run, const MeasurementLog& log,
                                   const TrajectoryScore& trajectory) {
  constexpr long kFewest = 2;  // points that a rotation and a shift can be read from
  if (log.start_is_true) return slam::Pose{};
  if (trajectory.scored_steps >= kFewest) return trajectory.truth_from_estimate;
  if (count_named(run.last.landmarks, log.landmarks) < kFewest) return {};
  return align_map(run.last.landmarks, log.landmarks);
}

void score_maps(std::span<const slam::LandmarkEstimate> map, std::span<const LandmarkTruth> truth,
                FilterScore& score) {
  score.map = score.map_aligned = score.map_path_aligned = unknown_map_score();
  if (!score.truth_from_estimate) return;
  score.map = score_map(map, truth, *score.truth_from_estimate);
  score.map_aligned = score_map(map, truth, align_map(map, truth, *score.truth_from_estimate));
  if (score.trajectory.scored_steps > 0)
    score.map_path_aligned = score_map(map, truth, score.trajectory.truth_from_estimate);
}

/// Takes out what compares numbers of one frame with those of another.
void leave_out_what_is_not_aligned(FilterScore& score) {
  for (double TrajectoryScore::*metric : {&TrajectoryScore::ate_rms_m, &TrajectoryScore::ate_max_m,
                                          &TrajectoryScore::heading_rms_rad, &TrajectoryScore::final_drift})
    score.trajectory.*metric = kNone;
  score.map.rms_m = score.map.max_m = kNone;
  for (auto& error : score.normalised_errors) error.reset();
  score.consistency.path = score.consistency.map = EllipseCoverage{};
  score.consistency.path.within.fill(kNone);
  score.consistency.map.within.fill(kNone);
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
  score.truth_from_estimate = frame_of(run, log, score.trajectory);
  score_maps(run.last.landmarks, log.landmarks, score);
  score.normalised_errors = normalised_errors(run, log);
  score.consistency = score_consistency(run, log);
  if (!log.start_is_true) leave_out_what_is_not_aligned(score);
  return score;
}

double position_error_m(const FilterScore& score, const slam::Pose& estimate, const LogStep& step) {
  if (!step.truth || !score.truth_from_estimate) return kNone;
  const slam::Pose there = slam::compose(*score.truth_from_estimate, estimate);
  return Eigen::Vector2d(there.x_m - step.truth->x_m, there.y_m - step.truth->y_m).norm();
}

void FilterTally::add(const FilterScore& score) {
  counts_.failures += score.failed ? 1 : 0;
  counts_.landmarks_found_once += score.map.found_once;
  counts_.landmarks_duplicated += score.map.duplicated;
  counts_.landmarks_missed += score.map.missed;
  counts_.landmarks_spurious += score.map.spurious;
  if (score.failed) return;
  metrics_.resize(kMetrics.size());
  for (std::size_t i = 0; i < kMetrics.size(); ++i) metrics_[i].push_back(kMetrics[i].of(score));
  add_steps(nees_by_step_, score.normalised_errors);
  consistency_.add(score.consistency);
}

FilterSummary FilterTally::summary(int particles, Seeds seeds) const {
  FilterSummary summary = counts_;
  summary.particles = particles;
  const std::vector<std::vector<double>> metrics =
      metrics_.empty() ? std::vector<std::vector<double>>(kMetrics.size()) : metrics_;
  for (std::size_t i = 0; i < kMetrics.size(); ++i) summary.*kMetrics[i].summary = summarise(metrics[i]);
  const std::vector<double>& aligned_m = metrics[index_of(&FilterSummary::ate_aligned_rms_m)];
  summary.ate_aligned_median_m = median(aligned_m);
  summary.nees_by_step = nees_by_step_;
  for (SquaredSum& sum : summary.nees_by_step) sum = worth(sum, seeds, aligned_m.size());
  summary.nees = judge_steps(summary.nees_by_step);
  summary.consistency = consistency_.summary(seeds);
  return summary;
}

}  // namespace stereobench::harness
