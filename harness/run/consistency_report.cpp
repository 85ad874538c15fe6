#include "harness/run/consistency_report.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kRunBand = 0.99;

template <typename Index>
Json index_or_null(const std::optional<Index>& index) {
  return index ? Json(*index) : Json(nullptr);
}

/// One entry a run that did not fail.
Json runs_json(const FilterResult& filter) {
  Json runs = Json::array();
  for (const auto& [seed, sum] : filter.innovations) {
    const Band band = chi_square_band(kRunBand, sum.all.degrees_of_freedom);
    runs.push_back({{"seed", seed},
                    {"sightings", sum.sightings()},
                    {"refused", sum.refused()},
                    {"nis", number(sum.all.ratio())},
                    {"nis_without_refused", number(sum.used.ratio())},
                    {"band99_low", number(band.low)},
                    {"band99_high", number(band.high)},
                    {"p", chi_square_p(sum.all)}});
  }
  return runs;
}

Json landmarks_json(const InnovationSummary& summary) {
  Json json = {{"seen_again", summary.landmarks}, {"outside_band99", summary.landmarks_outside}};
  const auto& worst = summary.worst;
  json["worst"] = {{"landmark_id", worst ? Json(worst->landmark_id) : Json(nullptr)},
                   {"sightings", worst ? Json(worst->sum.sightings()) : Json(nullptr)},
                   {"nis", worst ? number(worst->sum.all.ratio()) : Json(nullptr)},
                   {"p_holm", worst ? Json(worst->p) : Json(nullptr)}};
  return json;
}

Json nis_json(const FilterResult& filter) {
  const InnovationSummary& summary = filter.summary.consistency.innovations;
  return {{"sightings", summary.sum.sightings()},
          {"refused", summary.sum.refused()},
          {"per_run", summary_json(summary.nis)},
          {"per_run_without_refused", summary_json(summary.nis_used)},
          {"runs_outside_band99", summary.runs_outside},
          {"runs", runs_json(filter)},
          {"landmarks", landmarks_json(summary)}};
}

Json nees_json(const StepVerdict& verdict) {
  return {{"steps", verdict.steps},
          {"fraction_outside_band95", number(verdict.fraction_outside)},
          {"first_step_outside", index_or_null(verdict.first_outside)}};
}

Json coverage_json(const std::array<Summary, kEllipses.size()>& within) {
  Json json = Json::object();
  for (std::size_t i = 0; i < kEllipses.size(); ++i)
    json[fmt::format("within_{:.0f}", 100.0 * kEllipses[i])] = summary_json(within[i]);
  return json;
}

/// "0.49 / 0.94 / 0.99", the fractions within the ellipses.
std::string coverage_cell(const std::array<Summary, kEllipses.size()>& within) {
  if (within.front().count == 0) return "-";
  std::string cell;
  for (const Summary& fraction : within)
    cell += fmt::format("{}{:.2f}", cell.empty() ? "" : " / ", fraction.mean);
  return cell;
}

std::string percent(double fraction) {
  return std::isfinite(fraction) ? fmt::format("{:.0f} %", 100.0 * fraction) : "-";
}

std::vector<std::string> row_of(const FilterResult& filter) {
  const FilterSummary& s = filter.summary;
  const ConsistencySummary& c = s.consistency;
  const InnovationSummary& nis = c.innovations;
  const bool looks = nis.sum.sightings() > 0;
  return {filter.filter,
          format_number(nis.nis.mean),
          format_number(nis.nis_used.mean),
          looks ? fmt::format("{} of {}", nis.runs_outside, nis.run_ps.size()) : "-",
          looks ? fmt::format("{} of {}", nis.landmarks_outside, nis.landmarks) : "-",
          looks ? fmt::format("{}", nis.sum.refused()) : "-",
          percent(s.nees.fraction_outside),
          coverage_cell(c.path),
          coverage_cell(c.map),
          format_number(c.effective_mean.mean),
          format_number(c.ancestors_of_first.mean),
          format_number(c.ancestors_of_quarter.mean)};
}

}  // namespace

nlohmann::ordered_json consistency_json(const FilterResult& filter) {
  const FilterSummary& summary = filter.summary;
  const ConsistencySummary& c = summary.consistency;
  return {{"nis", nis_json(filter)},
          {"nees", nees_json(summary.nees)},
          {"path_coverage", coverage_json(c.path)},
          {"map_coverage", coverage_json(c.map)},
          {"effective_particles", summary_json(c.effective_mean)},
          {"least_effective_particles", summary_json(c.effective_least)},
          {"resamplings", summary_json(c.resamplings)},
          {"ancestors_of_first_update", summary_json(c.ancestors_of_first)},
          {"ancestors_of_last_quarter", summary_json(c.ancestors_of_quarter)}};
}

std::string consistency_columns() {
  return "error_rank,expected,refused,nis,effective_particles,ancestors";
}

std::string consistency_cells(const FilterRun& run, const FilterScore& score, const LogStep& step,
                              std::size_t k) {
  const auto& errors = score.normalised_errors;
  std::string cells = ",";
  if (k < errors.size() && errors[k]) cells += fmt::format("{}", errors[k]->degrees_of_freedom);
  if (k >= run.updates.size() || step.measurements.empty()) return cells + ",,,,,";
  const UpdateRecord& update = run.updates[k];
  InnovationSum sum;
  for (const slam::NormalisedInnovation& innovation : update.innovations) sum.add(innovation);
  cells += fmt::format(",{},{},", sum.sightings(), sum.refused());
  if (sum.sightings() > 0) cells += fmt::format("{}", sum.all.ratio());
  return cells + fmt::format(",{},{}", update.effective_particles, update.distinct_ancestors);
}

std::string consistency_table(const RunResult& result) {
  AlignedTable table{.header = {"consistency", "NIS", "if used", "runs off", "landmarks off", "refused",
                                "steps off", "path in 50/95/99 %", "map in 50/95/99 %", "N_eff",
                                "ancestors: first", "last quarter"}};
  for (const FilterResult& filter : result.filters) table.rows.push_back(row_of(filter));
  return plain_text(table);
}

}  // namespace stereobench::harness
