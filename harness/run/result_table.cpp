#include "harness/run/result_table.h"

#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/run/consistency_report.h"
#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

std::string fraction(double value) {
  return std::isfinite(value) ? fmt::format("{:.4f}", value) : "-";
}

std::string vision_line(const VisionScore& vision) {
  std::string line =
      fmt::format("vision: recall {}, precision {}, {} misidentified, range rms {} mm, bearing rms {} mrad\n",
                  fraction(vision.recall()), fraction(vision.precision()), vision.misidentified,
                  format_number(1e3 * vision.range_rms_m()), format_number(1e3 * vision.bearing_rms_rad()));
  for (const std::string& warning : rig_warnings(vision.rig)) line += fmt::format("warning: {}\n", warning);
  return line + "\n";
}

/// What `detector_noise` did to the detections of all seeds.
std::string faults_line(const FaultCounts& counts) {
  return fmt::format(
      "detector_noise: {} moved, {} lost, {} added, {} renamed, {} delayed, {} undelivered\n\n", counts.moved,
      counts.lost, counts.added, counts.renamed, counts.delayed, counts.undelivered);
}

std::vector<std::string> row_of(const RunResult& result, const FilterResult& filter,
                                const std::string& particles, double efficiency) {
  const FilterSummary& s = filter.summary;
  const Summary& landmarks_m = result.start_is_true ? s.landmark_rms_m : s.landmark_aligned_rms_m;
  return {filter.filter,
          particles,
          format_interval(s.ate_rms_m.mean, s.ate_rms_m.half_width),
          format_number(s.ate_rms_m.max),
          format_number(s.ate_aligned_rms_m.mean),
          format_number(slam::kDegreesPerRad * s.heading_rms_rad.mean),
          format_number(landmarks_m.mean),
          format_number(s.anees.mean),
          format_number(efficiency),
          fmt::format("{}", s.failures)};
}

std::vector<std::string> bound_row(const std::vector<BoundScores>& bounds, BoundScore BoundScores::*bound,
                                   const std::string& name) {
  const Summary pose = over_seeds(bounds, bound, &BoundScore::pose_rms_m);  // often the same for each seed
  return {name,
          "-",
          format_number(pose.mean),
          format_number(pose.max),
          "-",
          format_number(slam::kDegreesPerRad * over_seeds(bounds, bound, &BoundScore::heading_rms_rad).mean),
          format_number(over_seeds(bounds, bound, &BoundScore::landmark_rms_m).mean),
          "-",
          "1",
          "-"};
}

/// Each estimator above the bound of what it knows: filters know the log up to each pose, the batch all of
/// it.
std::string error_table(const RunResult& result) {
  AlignedTable table{.header = {"filter", "particles", "ATE rms [m] +- 95 %", "worst seed [m]", "aligned [m]",
                                "heading [deg]",
                                result.start_is_true ? "landmarks [m]" : "landmarks, aligned [m]", "ANEES",
                                "ATE / bound", "failures"}};
  for (const FilterResult& filter : result.filters)
    table.rows.push_back(
        row_of(result, filter, fmt::format("{}", filter.summary.particles), filter.efficiency));
  const bool bounded = !result.bounds.empty();
  if (bounded) table.rows.push_back(bound_row(result.bounds, &BoundScores::filtering, "bound (filtering)"));
  table.rows.push_back(row_of(result, result.batch, "-", result.batch.efficiency));
  if (bounded) table.rows.push_back(bound_row(result.bounds, &BoundScores::smoothing, "bound (smoothing)"));
  return plain_text(table);
}

/// ANEES from which on a filter's covariance is that many times too small, and is not to be believed.
constexpr double kOverconfident = 10.0;

/// A line for each estimator that claims far smaller or larger errors than it makes.
std::string claim_warnings(const RunResult& result) {
  std::string lines;
  const auto warn_of = [&lines](const FilterResult& filter) {
    const double anees = filter.summary.anees.mean;
    if (anees > kOverconfident)
      lines += fmt::format("warning: {} makes errors {} times as large as it claims (ANEES {})\n",
                           filter.filter, format_number(std::sqrt(anees), 2), format_number(anees));
    if (anees < 1.0 / kOverconfident)
      lines += fmt::format("warning: {} claims errors {} times as large as it makes (ANEES {})\n",
                           filter.filter, format_number(1.0 / std::sqrt(anees), 2), format_number(anees));
  };
  for (const FilterResult& filter : result.filters) warn_of(filter);
  warn_of(result.batch);
  return lines.empty() ? lines : "\n" + lines;
}

/// What filters repaired or refused, as sums over the seeds; nothing for filters that did neither.
std::string counters_table(const std::vector<FilterResult>& filters) {
  AlignedTable table{.header = {"repaired or refused", "refused, by particle", "inputs", "covariances",
                                "weights", "joint searches cut", "frames refitted, by particle"}};
  for (const FilterResult& filter : filters) {
    const slam::FilterCounters& c = filter.counters;
    const std::array<long, 6> counts = {c.gated_measurements, c.rejected_inputs,    c.covariance_repairs,
                                        c.weight_collapses,   c.joint_searches_cut, c.refitted_frames};
    if (counts == std::array<long, 6>{}) continue;
    table.rows.push_back({filter.filter});
    for (const long count : counts) table.rows.back().push_back(fmt::format("{}", count));
  }
  return table.rows.empty() ? std::string() : "\n" + plain_text(table);
}

/// How filters told landmarks apart, for people: sums over the seeds.
std::string association_table(const std::vector<FilterResult>& filters) {
  AlignedTable table{
      .header = {"association", "correct", "wrong", "missed", "imagined", "duplicated", "spurious"}};
  for (const FilterResult& filter : filters) {
    if (!filter.association || filter.filter == kBaseline) continue;
    const AssociationScore& a = *filter.association;
    table.rows.push_back({filter.filter});
    for (const long count : {a.correct, a.wrong, a.missed, a.imagined, a.duplicated, a.spurious})
      table.rows.back().push_back(fmt::format("{}", count));
  }
  return table.rows.empty() ? std::string() : "\n" + plain_text(table);
}

std::string noise_section(const NoiseCheck& check) {
  const std::string table = noise_table(check);
  return table.empty() ? table : "\n" + table;
}

}  // namespace

std::string result_table(const RunResult& result) {
  std::string text = fmt::format("{}\n", kIntervalNote);
  if (result.vision) text += vision_line(*result.vision);
  if (result.faults) text += faults_line(*result.faults);
  text += error_table(result) + claim_warnings(result) + "\n" + consistency_table(result) +
          counters_table(result.filters);
  if (result.noise) text += noise_section(*result.noise);
  return result.identities_known ? text : text + association_table(result.filters);
}

}  // namespace stereobench::harness
