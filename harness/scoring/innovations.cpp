#include "harness/scoring/innovations.h"

#include <algorithm>
#include <span>
#include <utility>

#include "harness/scoring/measured_landmark.h"

namespace stereobench::harness {
namespace {

constexpr double kSignificant = 0.01;

long count_significant(std::span<const double> p_values) {
  return std::ranges::count_if(p_values, [](double p) { return p < kSignificant; });
}

/// The p-values of sums, after Holm.
std::vector<double> p_values_of(std::span<const InnovationSum> sums) {
  std::vector<double> p_values;
  for (const InnovationSum& sum : sums) p_values.push_back(chi_square_p(sum.all));
  return holm(p_values);
}

void judge_runs(std::span<const InnovationSum> runs, InnovationSummary& summary) {
  std::vector<double> ratios;
  std::vector<double> used;
  for (const InnovationSum& run : runs) {
    ratios.push_back(run.all.ratio());
    used.push_back(run.used.ratio());
    summary.sum += run;
  }
  summary.nis = summarise(ratios);
  summary.nis_used = summarise(used);
  summary.run_ps = p_values_of(runs);
  summary.runs_outside = count_significant(summary.run_ps);
}

/// @param by_landmark the sums over so many runs
void judge_landmarks(std::map<int, InnovationSum> by_landmark, std::size_t runs, Seeds seeds,
                     InnovationSummary& summary) {
  std::vector<InnovationSum> sums;
  for (auto& [landmark, sum] : by_landmark) {
    sum = {worth(sum.all, seeds, runs), worth(sum.used, seeds, runs)};
    sums.push_back(sum);
  }
  const std::vector<double> p_values = p_values_of(sums);
  summary.landmarks = static_cast<long>(sums.size());
  summary.landmarks_outside = count_significant(p_values);
  std::size_t i = 0;
  for (const auto& [landmark, sum] : by_landmark) {
    const LandmarkInnovations one{landmark, sum, p_values[i++]};
    const auto badness = [](const LandmarkInnovations& l) { return std::pair(-l.p, l.sum.all.ratio()); };
    if (!summary.worst || badness(one) > badness(*summary.worst)) summary.worst = one;
  }
}

}  // namespace

void InnovationSum::add(const slam::NormalisedInnovation& innovation) {
  const SquaredSum one{innovation.squared_length, 2};
  all += one;
  if (!innovation.refused) used += one;
}

InnovationSum& InnovationSum::operator+=(const InnovationSum& other) {
  all += other.all;
  used += other.used;
  return *this;
}

InnovationScore score_innovations(const FilterRun& run, const MeasurementLog& log) {
  InnovationScore score;
  for (std::size_t k = 0; k < std::min(run.updates.size(), log.steps.size()); ++k)
    for (const slam::NormalisedInnovation& innovation : run.updates[k].innovations) {
      score.run.add(innovation);
      const auto sighting = static_cast<std::size_t>(innovation.sighting);
      if (const auto seen = measured_landmark(log.steps[k], sighting, log.landmarks))
        score.by_landmark[log.landmarks[*seen].landmark_id].add(innovation);
    }
  return score;
}

void InnovationTally::add(const InnovationScore& score) {
  runs_.push_back(score.run);
  for (const auto& [landmark, sum] : score.by_landmark) by_landmark_[landmark] += sum;
}

InnovationSummary InnovationTally::summary(Seeds seeds) const {
  InnovationSummary summary;
  judge_runs(runs_, summary);
  judge_landmarks(by_landmark_, runs_.size(), seeds, summary);
  return summary;
}

}  // namespace stereobench::harness
