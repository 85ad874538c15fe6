#include "harness/run/metric_keys.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace stereobench::harness {
namespace {

/// A key whose value stands for all seeds: mean, sd, max and ci95_half_width.
struct SummaryKey {
  const char* path;
  const char* says;
};

constexpr SummaryKey kSummaries[] = {
    {"bound.pose_rms_m", "Filtering Cramer-Rao bound of the position, data to the step: rms over the steps."},
    {"bound.heading_rms_rad", "Filtering Cramer-Rao bound of the heading: rms over the steps."},
    {"bound.landmark_rms_m", "Cramer-Rao bound of the final map: rms over the landmarks."},
    {"smoothing_bound.pose_rms_m",
     "Smoothing Cramer-Rao bound of the position, data of the whole drive: rms over the steps."},
    {"smoothing_bound.heading_rms_rad", "Smoothing Cramer-Rao bound of the heading: rms over the steps."},
    {"smoothing_bound.landmark_rms_m", "Cramer-Rao bound of the final map: rms over the landmarks."},
    {"batch.ate_rms_m", "Position error of the whole log solved at once: rms over the steps."},
    {"batch.ate_aligned_rms_m", "The same after the shift and turn that fit the path best."},
    {"batch.landmark_rms_m", "Error of the batch's landmarks: rms over the map."},
    {"batch.landmark_aligned_rms_m", "The same after the shift and turn that fit the map best."},
    {"filters.*.ate_rms_m", "Absolute trajectory error: rms of the position error over the steps."},
    {"filters.*.ate_max_m", "Largest position error of any step."},
    {"filters.*.ate_aligned_rms_m", "ATE after the shift and turn that fit the path best."},
    {"filters.*.ate_aligned_at_sightings_rms_m",
     "Aligned ATE of the steps alone at which something was seen."},
    {"filters.*.heading_rms_rad", "Heading error: rms over the steps."},
    {"filters.*.rpe_rms_m", "Relative error: position error of the motion over ten steps, rms."},
    {"filters.*.final_drift", "Position error at the end, per metre driven."},
    {"filters.*.landmark_rms_m", "Error of the landmarks in the final map: rms."},
    {"filters.*.landmark_aligned_rms_m", "The same after the shift and turn that fit the map best."},
    {"filters.*.landmark_path_aligned_rms_m", "The same after the shift and turn that fit the path best."},
    {"filters.*.anees",
     "Average normalised estimation error squared of the pose, per degree of freedom; 1 is consistent, "
     "above is overconfident."},
    {"filters.*.consistency.nis.per_run",
     "Normalised innovation squared of a run, per degree of freedom; 1 is consistent."},
    {"filters.*.consistency.nis.per_run_without_refused",
     "The same without the sightings that were refused."},
    {"filters.*.consistency.path_coverage.within_50",
     "Part of the steps whose true position lies in the 50 % ellipse."},
    {"filters.*.consistency.path_coverage.within_95",
     "Part of the steps whose true position lies in the 95 % ellipse."},
    {"filters.*.consistency.path_coverage.within_99",
     "Part of the steps whose true position lies in the 99 % ellipse."},
    {"filters.*.consistency.map_coverage.within_50",
     "Part of the landmarks whose true place lies in the 50 % ellipse."},
    {"filters.*.consistency.map_coverage.within_95",
     "Part of the landmarks whose true place lies in the 95 % ellipse."},
    {"filters.*.consistency.map_coverage.within_99",
     "Part of the landmarks whose true place lies in the 99 % ellipse."},
    {"filters.*.consistency.effective_particles", "Effective number of particles: mean over the updates."},
    {"filters.*.consistency.least_effective_particles",
     "Effective number of particles: least of all updates."},
    {"filters.*.consistency.resamplings", "How often particles were drawn anew."},
    {"filters.*.consistency.ancestors_of_first_update",
     "Particles at the first update from which the last ones descend."},
    {"filters.*.consistency.ancestors_of_last_quarter",
     "Particles a quarter of the run before the end from which the last ones descend."},
    {"comparisons[].ate_rms_m", "ATE of `filter` minus ATE of `minus`, seed by seed."},
};

constexpr SummaryKey kSingles[] = {
    {"schema", "Version of this file's layout."},
    {"scenario", "Name of the scenario, or of the log."},
    {"made_from.stereobench", "Version of the program."},
    {"made_from.scenario_sha256", "SHA-256 of resolved_scenario.yaml, which lies beside."},
    {"made_from.set[]", "What --set and --vary changed: key=value."},
    {"made_from.files_sha256.*", "SHA-256 of a file that the scenario names, by that name."},
    {"made_from.pixels", "The renderer's fingerprint, as `doctor` prints it; null without pictures."},
    {"seeds[]", "The seeds that were run."},
    {"renderer.backend", "What rendered: osmesa, egl, egl-gpu, or none."},
    {"renderer.blur.coarse_pairs",
     "Pairs whose motion blur is drawn in steps of more than a pixel, as shutter.most_samples is too few."},
    {"renderer.blur.most_step_px",
     "Longest step between two renderings of a blurred pair; 0 where nothing is blurred."},
    {"detector",
     "Who found the balls: a linked detector's name (stereobench: ours), a program's command, callable, "
     "file, or none."},
    {"detector_noise.moved", "Detections whose centre or range `detector_noise` moved."},
    {"detector_noise.lost", "Detections that it lost: missed, or moved to where no ball can be."},
    {"detector_noise.added", "Detections of nothing that it added."},
    {"detector_noise.renamed", "Detections that it gave another name."},
    {"detector_noise.delayed", "Detections that arrived frames after the look."},
    {"detector_noise.undelivered",
     "Detections whose frame of arrival was lost or lies behind the end of the drive."},
    {"vision.recall",
     "Part of the balls to be found that were found; at least 95 % of those is seen by both cameras."},
    {"vision.precision",
     "Part of the trusted detections that are of a ball, of its colour, and the first of it."},
    {"vision.misidentified", "Trusted detections on a ball of another colour."},
    {"vision.range_rms_m", "Range error of right detections: rms."},
    {"vision.bearing_rms_rad", "Bearing error of right detections: rms."},
    {"vision.disparity_rms_px", "Disparity error of right detections: rms."},
    {"vision.range_bias_m", "Mean range error of right detections: measured minus true."},
    {"vision.bearing_bias_rad", "Mean bearing error of right detections."},
    {"vision.disparity_bias_px", "Mean disparity error of right detections."},
    {"vision.normalised_error",
     "Mean of e' R^-1 e / 2 over right detections; 1 is consistent, above is overconfident."},
    {"vision.visible", "Balls that had to be found, summed over the pairs."},
    {"vision.found", "Balls of these that were found."},
    {"vision.observations", "Trusted detections."},
    {"vision.spurious", "Trusted detections on no ball."},
    {"vision.repeated", "Trusted detections on a ball that another one is on."},
    {"vision.flagged", "Detections that are not to be trusted, which are not scored."},
    {"vision.rows_off_px.left",
     "Rows by which the left camera sees things further down than the right one, at the left of the "
     "picture."},
    {"vision.rows_off_px.right", "The same at the right of the picture."},
    {"vision.rows_off_px.sd", "Standard deviation of either."},
    {"vision.size_disagrees.share",
     "Share by which disparities of 40 px are larger than the sizes of balls say."},
    {"vision.size_disagrees.sd", "Standard deviation of that."},
    {"log.odometry_delay_s", "By how much a recorded log's motion follows its odometry's stamps."},
    {"log.sighting_correlation_s.range",
     "How long errors of a recorded log's ranges last; 0: each is its own."},
    {"log.sighting_correlation_s.bearing", "The same of bearings."},
    {"log.sector.range_m", "How far the sensor sees, as filters are told; 0: nothing is known."},
    {"log.sector.half_angle_rad", "How far it sees to each side."},
    {"log.sector.miss_probability", "The probability that it misses what is there."},
    {"log.sector.false_per_look", "How many things a look shows that are none, on average."},
    {"log.frame", "Whose frame the estimates are in: truth, or the filters' own."},
    {"log.steps_without_truth", "Steps of the log without a true pose."},
    {"log.repeated_sightings", "Sightings that stood in the log already; left out."},
    {"log.concurrent_sightings", "Sightings of a landmark that another one of the same instant is of; kept."},
    {"log.robot_sightings", "Sightings of other robots (MRCLAM); left out."},
    {"log.unknown_barcodes", "Sightings of a barcode that names no landmark (MRCLAM); left out."},
    {"log.assumed[]", "What was assumed of the log, and what to do about it."},
    {"noise.logs", "Logs that the check of the noise looked at; 0: there was none."},
    {"noise.converged", "Whether the check of the noise found factors."},
    {"noise.refused", "Sightings that the check of the noise left out as outliers."},
    {"noise.forward_speed.factor",
     "How many times as noisy as filters are told the forward speed is, by the sightings alone: factor on "
     "the standard deviation."},
    {"noise.forward_speed.low", "Lower end of its 99.9 % interval."},
    {"noise.forward_speed.high", "Upper end of its 99.9 % interval."},
    {"noise.turn_rate.factor", "The same of the turn rate."},
    {"noise.turn_rate.low", "Lower end of its 99.9 % interval."},
    {"noise.turn_rate.high", "Upper end of its 99.9 % interval."},
    {"noise.range.factor", "The same of ranges."},
    {"noise.range.low", "Lower end of its 99.9 % interval."},
    {"noise.range.high", "Upper end of its 99.9 % interval."},
    {"noise.bearing.factor", "The same of bearings."},
    {"noise.bearing.low", "Lower end of its 99.9 % interval."},
    {"noise.bearing.high", "Upper end of its 99.9 % interval."},
    {"batch.efficiency", "ATE of the batch divided by the smoothing bound."},
    {"batch.failures", "Seeds of which the batch found no solution."},
    {"filters.*.particles", "Number of particles."},
    {"filters.*.ate_aligned_median_m", "Median over the seeds of the aligned ATE."},
    {"filters.*.ate_over_dead_reckoning", "Mean ATE divided by that of dead reckoning."},
    {"filters.*.efficiency", "ATE divided by the bound: 1 cannot be beaten on average."},
    {"filters.*.landmarks.found_once", "True landmarks with one estimate, summed over the seeds."},
    {"filters.*.landmarks.duplicated", "True landmarks with several estimates, summed over the seeds."},
    {"filters.*.landmarks.missed", "True landmarks without an estimate, summed over the seeds."},
    {"filters.*.landmarks.spurious", "Estimates of no true landmark, summed over the seeds."},
    {"filters.*.association", "Null where it is not known which landmarks sightings are of."},
    {"filters.*.association.correct", "Sightings given to the right landmark by the heaviest particle."},
    {"filters.*.association.wrong", "Sightings given to a wrong landmark."},
    {"filters.*.association.missed", "Sightings of mapped landmarks that were given to none."},
    {"filters.*.association.imagined", "Sightings of nothing that were taken for a landmark."},
    {"filters.*.association.duplicated",
     "Landmarks that the final map has more than once, each further time."},
    {"filters.*.association.spurious", "Landmarks of the final map that come of sightings of nothing."},
    {"filters.*.consistency.nis.sightings", "Sightings of landmarks that were mapped already."},
    {"filters.*.consistency.nis.refused", "Sightings of these that the filter refused as too far off."},
    {"filters.*.consistency.nis.runs_outside_band99", "Runs whose NIS lies outside of its 99 % band."},
    {"filters.*.consistency.nis.runs[].seed", "Seed of the run."},
    {"filters.*.consistency.nis.runs[].sightings", "Sightings of landmarks that were mapped already."},
    {"filters.*.consistency.nis.runs[].refused", "Sightings of these that were refused."},
    {"filters.*.consistency.nis.runs[].nis", "NIS of the run, per degree of freedom."},
    {"filters.*.consistency.nis.runs[].nis_without_refused", "The same without refused sightings."},
    {"filters.*.consistency.nis.runs[].band99_low",
     "Lower end of the band that a consistent run's NIS lies in."},
    {"filters.*.consistency.nis.runs[].band99_high", "Upper end of that band."},
    {"filters.*.consistency.nis.runs[].p", "Probability that a consistent run's NIS is as far off."},
    {"filters.*.consistency.nis.landmarks.seen_again",
     "Landmarks that were seen after they had been mapped."},
    {"filters.*.consistency.nis.landmarks.outside_band99",
     "Landmarks of these whose NIS lies outside of its 99 % band."},
    {"filters.*.consistency.nis.landmarks.worst.landmark_id", "The landmark whose NIS is the least likely."},
    {"filters.*.consistency.nis.landmarks.worst.sightings", "Its sightings."},
    {"filters.*.consistency.nis.landmarks.worst.nis", "Its NIS, per degree of freedom."},
    {"filters.*.consistency.nis.landmarks.worst.p_holm",
     "Probability that the worst of so many consistent landmarks is as far off (Holm)."},
    {"filters.*.consistency.nees.steps", "Steps at which NEES was taken over the seeds."},
    {"filters.*.consistency.nees.fraction_outside_band95",
     "Part of these at which it lies outside of its 95 % band (Holm)."},
    {"filters.*.consistency.nees.first_step_outside", "First of them."},
    {"filters.*.counters.refused_by_particle",
     "Sightings that a particle refused, summed over the particles."},
    {"filters.*.counters.rejected_inputs", "Controls and sightings that are no numbers; left out."},
    {"filters.*.counters.covariance_repairs", "Covariances that had to be made semidefinite."},
    {"filters.*.counters.weight_collapses", "Updates after which every particle's weight had vanished."},
    {"filters.*.counters.joint_searches_cut", "Searches for the best association that were cut short."},
    {"filters.*.counters.refitted_by_particle",
     "Frames that a particle fitted again as a whole, without what the fit spoke against, summed over the "
     "particles."},
    {"filters.*.failures", "Seeds in which the filter broke down; they enter no mean."},
    {"per_seed.*[]",
     "A metric of each seed, in the order of seeds: the key of that name, or its mean, of a run of the seed "
     "alone."},
    {"comparisons[].filter", "A filter, beside another on the same seeds."},
    {"comparisons[].minus", "The other."},
    {"comparisons[].p_wilcoxon", "Probability of such a difference by chance (Wilcoxon's signed ranks)."},
};

constexpr std::array<std::pair<const char*, const char*>, 4> kParts = {{
    {"mean", "Mean over the seeds."},
    {"sd", "Standard deviation over the seeds."},
    {"max", "Largest of the seeds."},
    {"ci95_half_width", "Half width of the mean's 95 % interval (Student's t)."},
}};

/// Whether the keys at a path are names of a run's own things.
bool is_named_by_user(std::string_view path) {
  return path == "filters" || path == "made_from.files_sha256" || path == "per_seed";
}

void collect(const nlohmann::ordered_json& json, const std::string& path, std::vector<std::string>& keys) {
  if (json.is_array())
    for (const auto& entry : json) collect(entry, path + "[]", keys);
  else if (json.is_object())
    for (const auto& [key, child] : json.items())
      collect(child, path.empty() ? key : path + "." + (is_named_by_user(path) ? "*" : key), keys);
  else if (std::find(keys.begin(), keys.end(), path) == keys.end())
    keys.push_back(path);
}

}  // namespace

std::vector<MetricKey> metric_keys() {
  std::vector<MetricKey> keys;
  for (const SummaryKey& key : kSingles) keys.push_back({key.path, key.says});
  for (const SummaryKey& key : kSummaries)
    for (const auto& [part, says] : kParts)
      keys.push_back({std::string(key.path) + "." + part, std::string(key.says) + " " + says});
  return keys;
}

std::string unit_of(const std::string& path) {
  constexpr std::array<std::string_view, 4> kStatistics = {".mean", ".sd", ".max", ".ci95_half_width"};
  std::string_view name = path;
  for (const std::string_view part : kStatistics)
    if (name.ends_with(part)) name.remove_suffix(part.size());
  using Unit = std::pair<std::string_view, const char*>;
  constexpr std::array<Unit, 9> kUnits = {{{"_m", "m"},
                                           {"_rad", "rad"},
                                           {"_deg", "deg"},
                                           {"_px", "px"},
                                           {"_s", "s"},
                                           {"_mps", "m/s"},
                                           {"_radps", "rad/s"},
                                           {"_degps", "deg/s"},
                                           {"_mib", "MiB"}}};
  for (const auto& [suffix, unit] : kUnits)
    if (name.size() > suffix.size() && name.ends_with(suffix)) return unit;
  return {};
}

std::vector<std::string> keys_in(const nlohmann::ordered_json& run) {
  std::vector<std::string> keys;
  collect(run, "", keys);
  return keys;
}

}  // namespace stereobench::harness
