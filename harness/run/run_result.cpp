#include "harness/run/run_result.h"

#include "harness/json/json_numbers.h"
#include "harness/run/consistency_report.h"

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
          {"efficiency", number(result.batch.efficiency)},
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

Json sector_json(const slam::SensorSector& sector) {
  return {{"range_m", sector.range_m},
          {"half_angle_rad", sector.half_angle_rad},
          {"miss_probability", sector.miss_probability},
          {"false_per_look", sector.false_per_look}};
}

Json log_json(const LogFacts& facts, const std::vector<std::string>& assumed, bool start_is_true) {
  return {{"odometry_delay_s", facts.odometry_delay_s},
          {"sighting_correlation_s",
           {{"range", facts.lasting_errors.time_s[0]}, {"bearing", facts.lasting_errors.time_s[1]}}},
          {"sector", sector_json(facts.sector.sector)},
          {"frame", start_is_true ? "truth" : "own"},
          {"steps_without_truth", facts.steps_without_truth},
          {"repeated_sightings", facts.repeated_sightings},
          {"concurrent_sightings", facts.concurrent_sightings},
          {"robot_sightings", facts.robot_sightings},
          {"unknown_barcodes", facts.unknown_barcodes},
          {"assumed", assumed}};
}

Json counters_json(const slam::FilterCounters& counters) {
  return {{"refused_by_particle", counters.gated_measurements},
          {"rejected_inputs", counters.rejected_inputs},
          {"covariance_repairs", counters.covariance_repairs},
          {"weight_collapses", counters.weight_collapses},
          {"joint_searches_cut", counters.joint_searches_cut},
          {"refitted_by_particle", counters.refitted_frames}};
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
          {"efficiency", number(filter.efficiency)},
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
          {"consistency", consistency_json(filter)},
          {"counters", counters_json(filter.counters)},
          {"failures", summary.failures}};
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
               {"range_bias_m", number(vision->range_bias_m())},
               {"bearing_bias_rad", number(vision->bearing_bias_rad())},
               {"disparity_bias_px", number(vision->disparity_bias_px())},
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

}  // namespace

nlohmann::ordered_json run_json(const RunResult& result) {
  Json filters = Json::object();
  for (const FilterResult& filter : result.filters) filters[filter.filter] = filter_json(result, filter);
  Json json = {{"schema", kSchema},           {"scenario", result.name},
               {"seeds", result.seeds},       {"renderer", renderer_json(result)},
               {"detector", result.detector}, {"vision", vision_json(result.vision)}};
  if (result.faults) json["detector_noise"] = fault_counts_json(*result.faults);
  if (result.made_from) json["made_from"] = provenance_json(*result.made_from);
  if (result.recorded) json["log"] = log_json(*result.recorded, result.assumed, result.start_is_true);
  json["bound"] = bound_json(result.bounds, &BoundScores::filtering);
  json["smoothing_bound"] = bound_json(result.bounds, &BoundScores::smoothing);
  json["batch"] = batch_json(result);
  json["noise"] = noise_json(result.noise.value_or(NoiseCheck{}));
  json["filters"] = std::move(filters);
  json["comparisons"] = comparisons_json(result.comparisons);
  json["per_seed"] = seed_metrics_json(result.seed_metrics);
  return json;
}

Summary over_seeds(const std::vector<BoundScores>& bounds, BoundScore BoundScores::*bound,
                   double BoundScore::*part) {
  std::vector<double> values;
  for (const BoundScores& one : bounds) values.push_back(one.*bound.*part);
  return summarise(values);
}

nlohmann::ordered_json timing_json(const Timing& timing, std::size_t drives) {
  return {{"schema", kSchema}, {"seeds", drives}, {"seconds", timing}};
}

}  // namespace stereobench::harness
