#include "harness/run/run_result.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/run/consistency_report.h"
#include "harness/scoring/association_score.h"
#include "harness/statistics/json_numbers.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;

/// How many times better than dead reckoning a filter's mean ATE is; null without dead reckoning.
Json over_dead_reckoning(const RunResult& result, const FilterSummary& summary) {
  for (const FilterResult& filter : result.filters)
    if (filter.filter == kBaseline) return number(summary.ate_rms_m.mean / filter.summary.ate_rms_m.mean);
  return nullptr;
}

Json bound_json(const std::vector<BoundScores>& bounds, BoundScore BoundScores::*bound) {
  return {{"pose_rms_m", summary_json(over_seeds(bounds, bound, &BoundScore::pose_rms_m))},
          {"heading_rms_rad", summary_json(over_seeds(bounds, bound, &BoundScore::heading_rms_rad))},
          {"landmark_rms_m", summary_json(over_seeds(bounds, bound, &BoundScore::landmark_rms_m))}};
}

Json batch_json(const RunResult& result) {
  const FilterSummary& summary = result.batch.summary;
  return {{"ate_rms_m", summary_json(summary.ate_rms_m)},
          {"ate_aligned_rms_m", summary_json(summary.ate_aligned_rms_m)},
          {"efficiency", number(efficiency(result.batch.scores, result.bounds, &BoundScores::smoothing))},
          {"landmark_rms_m", summary_json(summary.landmark_rms_m)},
          {"landmark_aligned_rms_m", summary_json(summary.landmark_aligned_rms_m)},
          {"failures", summary.failures}};
}

Json association_json(const std::optional<AssociationScore>& association) {
  if (!association) return nullptr;
  return {{"correct", association->correct},       {"wrong", association->wrong},
          {"missed", association->missed},         {"imagined", association->imagined},
          {"duplicated", association->duplicated}, {"spurious", association->spurious}};
}

Json log_json(const LogFacts& facts, const std::vector<std::string>& assumed, bool start_is_true) {
  return {
      {"odometry_delay_s", facts.odometry_delay_s},         {"frame", start_is_true ? "truth" : "own"},
      {"steps_without_truth", facts.steps_without_truth},   {"repeated_sightings", facts.repeated_sightings},
      {"concurrent_sightings", facts.concurrent_sightings}, {"robot_sightings", facts.robot_sightings},
      {"unknown_barcodes", facts.unknown_barcodes},         {"assumed", assumed}};
}

Json counters_json(const slam::FilterCounters& counters) {
  return {{"refused_by_particle", counters.gated_measurements},
          {"rejected_inputs", counters.rejected_inputs},
          {"covariance_repairs", counters.covariance_repairs},
          {"weight_collapses", counters.weight_collapses},
          {"joint_searches_cut", counters.joint_searches_cut}};
}

Json filter_json(const RunResult& result, const FilterResult& filter) {
  const FilterSummary& summary = filter.summary;
  return {{"particles", summary.particles},
          {"ate_rms_m", summary_json(summary.ate_rms_m)},
          {"ate_max_m", summary_json(summary.ate_max_m)},
          {"ate_aligned_rms_m", summary_json(summary.ate_aligned_rms_m)},
          {"ate_aligned_median_m", number(summary.ate_aligned_median_m)},
          {"ate_aligned_at_sightings_rms_m", summary_json(summary.ate_aligned_at_sightings_rms_m)},
          {"ate_over_dead_reckoning", over_dead_reckoning(result, summary)},
          {"efficiency", number(efficiency(filter.scores, result.bounds, &BoundScores::filtering))},
          {"heading_rms_rad", summary_json(summary.heading_rms_rad)},
          {"rpe_rms_m", summary_json(summary.rpe_rms_m)},
          {"final_drift", summary_json(summary.final_drift)},
          {"landmark_rms_m", summary_json(summary.landmark_rms_m)},
          {"landmark_aligned_rms_m", summary_json(summary.landmark_aligned_rms_m)},
          {"landmark_path_aligned_rms_m", summary_json(summary.landmark_path_aligned_rms_m)},
          {"landmarks",
           {{"found_once", summary.landmarks_found_once},
            {"duplicated", summary.landmarks_duplicated},
            {"missed", summary.landmarks_missed},
            {"spurious", summary.landmarks_spurious}}},
          {"association", association_json(filter.association)},
          {"anees", summary_json(summary.anees)},
          {"consistency", consistency_json(result, filter)},
          {"counters", counters_json(filter.counters)},
          {"failures", summary.failures}};
}

std::vector<double> ate_of(const FilterResult& filter) {
  std::vector<double> errors;
  for (const FilterScore& score : filter.scores) errors.push_back(score.trajectory.ate_rms_m);
  return errors;
}

std::vector<Comparison> compare(const std::vector<FilterResult>& filters) {
  std::vector<Comparison> comparisons;
  for (std::size_t i = 0; i < filters.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (filters[i].filter != kBaseline && filters[j].filter != kBaseline)
        comparisons.push_back(
            {filters[i].filter, filters[j].filter, compare_paired(ate_of(filters[i]), ate_of(filters[j]))});
  return comparisons;
}

Json comparisons_json(const std::vector<Comparison>& comparisons) {
  Json list = Json::array();
  for (const Comparison& comparison : comparisons)
    list.push_back({{"filter", comparison.filter},
                    {"minus", comparison.other},
                    {"ate_rms_m", summary_json(comparison.ate_m.difference)},
                    {"p_wilcoxon", number(comparison.ate_m.p_value)}});
  return list;
}

Json renderer_json(const RunResult& result) {
  Json nothing = blur_json({});
  for (Json& value : nothing) value = nullptr;
  return {{"backend", result.backend}, {"blur", result.blur ? blur_json(*result.blur) : nothing}};
}

Json vision_json(const std::optional<VisionScore>& vision) {
  if (!vision)
    return {{"recall", nullptr},
            {"precision", nullptr},
            {"misidentified", nullptr},
            {"range_rms_m", nullptr},
            {"bearing_rms_rad", nullptr}};
  Json json = {{"recall", number(vision->recall())},
               {"precision", number(vision->precision())},
               {"misidentified", vision->misidentified},
               {"range_rms_m", number(vision->range_rms_m())},
               {"bearing_rms_rad", number(vision->bearing_rms_rad())},
               {"disparity_rms_px", number(vision->disparity_rms_px())},
               {"normalised_error", number(vision->mean_normalised_error())},
               {"visible", vision->visible},
               {"found", vision->found},
               {"observations", vision->observations},
               {"spurious", vision->spurious},
               {"repeated", vision->repeated},
               {"flagged", vision->flagged}};
  json.update(rig_json(vision->rig));
  return json;
}

void append_step(std::string& csv, std::uint64_t seed, const FilterRun& run, const FilterScore& score,
                 const LogStep& step, std::size_t k) {
  const slam::Pose& pose = run.poses[k];
  csv += fmt::format("{},{},{},{},{},{},{},{}", seed, run.filter, k, step.stamp_ns, pose.x_m, pose.y_m,
                     pose.heading_rad, step.measurements.size());
  const double error_m = position_error_m(score, pose, step);
  if (step.truth)
    csv += fmt::format(",{},{},{},", step.truth->x_m, step.truth->y_m, step.truth->heading_rad);
  else
    csv += ",,,,";
  if (std::isfinite(error_m)) csv += fmt::format("{}", error_m);
  const auto& nees = score.normalised_errors;
  csv += k < nees.size() && nees[k] ? fmt::format(",{}", nees[k]->ratio()) : std::string(",");
  csv += consistency_cells(run, score, step, k) + "\n";
}

}  // namespace

RunResult assemble(const std::string& name, const std::string& backend, std::span<const SeedDrive> drives,
                   Seeds seeds) {
  if (drives.empty()) throw std::invalid_argument("assemble: there is no drive to put together");
  RunResult result{.name = name, .backend = backend, .batch = {.filter = "batch"}};
  result.detector = drives.front().recording.detector;
  if (backend != kNoBackend) result.blur.emplace();
  for (const FilterRun& run : drives.front().runs) result.filters.push_back({.filter = run.filter});
  for (const SeedDrive& drive : drives) {
    if (drive.runs.size() != result.filters.size())
      throw std::invalid_argument("assemble: the drives have different filters");
    result.seeds.push_back(drive.seed);
    if (drive.recording.vision && !result.vision) result.vision.emplace();
    if (drive.recording.vision) *result.vision += *drive.recording.vision;
    if (result.blur) *result.blur += drive.recording.blur;
    result.start_is_true = result.start_is_true && drive.recording.log.start_is_true;
    result.identities_known = result.identities_known && knows_identities(drive.recording.log);
    for (std::size_t i = 0; i < drive.runs.size(); ++i) {
      FilterResult& filter = result.filters[i];
      filter.scores.push_back(score(drive.runs[i], drive.recording.log));
      filter.counters += drive.runs[i].last.counters;
      if (const auto& more = drive.runs[i].association)
        filter.association = filter.association.value_or(AssociationScore{}) + *more;
    }
    result.batch.scores.push_back(score(drive.references.batch, drive.recording.log));
    if (drive.references.bound) result.bounds.push_back(score(*drive.references.bound));
  }
  result.batch.summary = summarise(result.batch.scores, 1, seeds);
  for (std::size_t i = 0; i < result.filters.size(); ++i)
    result.filters[i].summary = summarise(result.filters[i].scores, drives.front().runs[i].particles, seeds);
  result.comparisons = compare(result.filters);
  return result;
}

nlohmann::ordered_json run_json(const RunResult& result) {
  Json filters = Json::object();
  for (const FilterResult& filter : result.filters) filters[filter.filter] = filter_json(result, filter);
  Json json = {{"schema", kSchema},           {"scenario", result.name},
               {"seeds", result.seeds},       {"renderer", renderer_json(result)},
               {"detector", result.detector}, {"vision", vision_json(result.vision)}};
  if (result.made_from) json["made_from"] = provenance_json(*result.made_from);
  if (result.recorded) json["log"] = log_json(*result.recorded, result.assumed, result.start_is_true);
  json["bound"] = bound_json(result.bounds, &BoundScores::filtering);
  json["smoothing_bound"] = bound_json(result.bounds, &BoundScores::smoothing);
  json["batch"] = batch_json(result);
  json["filters"] = std::move(filters);
  json["comparisons"] = comparisons_json(result.comparisons);
  return json;
}

std::string steps_csv(const RunResult& result, std::span<const SeedDrive> drives) {
  std::string csv =
      "seed,filter,step,stamp_ns,x_m,y_m,heading_rad,measurements,"
      "true_x_m,true_y_m,true_heading_rad,error_m,normalised_error," +
      consistency_columns() + "\n";
  for (std::size_t d = 0; d < drives.size(); ++d)
    for (std::size_t i = 0; i < drives[d].runs.size(); ++i)
      for (std::size_t k = 0; k < drives[d].runs[i].poses.size(); ++k)
        append_step(csv, drives[d].seed, drives[d].runs[i], result.filters[i].scores[d],
                    drives[d].recording.log.steps[k], k);
  return csv;
}

Summary over_seeds(const std::vector<BoundScores>& bounds, BoundScore BoundScores::*bound,
                   double BoundScore::*part) {
  std::vector<double> values;
  for (const BoundScores& one : bounds) values.push_back(one.*bound.*part);
  return summarise(values);
}

Timing timing_of(std::span<const SeedDrive> drives) {
  Timing total;
  for (const SeedDrive& drive : drives)
    for (const auto& [stage, seconds] : drive.recording.timing) total[stage] += seconds;
  return total;
}

nlohmann::ordered_json timing_json(const Timing& timing, std::size_t drives) {
  return {{"schema", kSchema}, {"seeds", drives}, {"seconds", timing}};
}

}  // namespace stereobench::harness
