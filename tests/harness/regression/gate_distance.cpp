#include "tests/harness/regression/gate_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/regression/gates.h"
#include "harness/statistics/statistics.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// "a.b" as "/a/b".
const Json& number_at(const Json& run, const std::string& metric) {
  std::string pointer = "/" + metric;
  std::ranges::replace(pointer, '.', '/');
  return run.at(Json::json_pointer(pointer));
}

/// The finite values of the seeds.
std::vector<double> values_of(const Json& run, const std::string& metric) {
  const std::string mean = ".mean";
  const std::string name = metric.ends_with(mean) ? metric.substr(0, metric.size() - mean.size()) : metric;
  std::vector<double> values;
  if (!run.at("per_seed").contains(name)) return values;
  for (const Json& value : run.at("per_seed").at(name))
    if (value.is_number()) values.push_back(value.get<double>());
  return values;
}

/// How many things a rate is of; empty for other metrics.
std::optional<double> trials_of(const Json& run, const std::string& metric) {
  if (metric == "vision.recall") return run.at("vision").at("visible").get<double>();
  if (metric == "vision.precision") return run.at("vision").at("observations").get<double>();
  return {};
}

std::optional<double> standard_error_of(const Json& run, const std::string& metric, const Json& measured) {
  const std::vector<double> values = values_of(run, metric);
  if (values.size() < 2) return {};
  const auto count = static_cast<double>(values.size());
  const double of_mean = summarise(values).sd / std::sqrt(count);
  if (measured.is_number_integer()) return std::max(1.0, count * of_mean);
  const std::optional<double> trials = trials_of(run, metric);
  const double rate = measured.get<double>();
  if (trials && (rate == 0.0 || rate == 1.0)) return 1.0 / *trials;
  return of_mean;
}

GateDistance distance_of(const Json& run, const Gate& gate) {
  GateDistance distance{.gate = gate, .standard_errors = std::numeric_limits<double>::quiet_NaN()};
  const Json& measured = number_at(run, gate.metric);
  if (!measured.is_number()) return distance;
  distance.measured = measured.get<double>();
  distance.standard_error = standard_error_of(run, gate.metric, measured);
  const double sign = gate.relation == Gate::Relation::kAtMost ? 1.0 : -1.0;
  const double way = sign * (gate.limit - *distance.measured);
  distance.standard_errors = way == 0.0 ? 0.0 : way / distance.standard_error.value_or(0.0);
  return distance;
}

std::string verdict_of(const GateDistance& distance) {
  if (distance.is_broken()) return "broken";
  return distance.is_far() ? "too far" : "";
}

std::string shortest(const std::optional<double>& value) {
  return value ? format_number(*value, 4) : "-";
}

}  // namespace

std::vector<GateDistance> gate_distances(const Json& run, std::span<const Gate> gates) {
  check_metrics(gates, run);
  std::vector<GateDistance> distances;
  for (const Gate& gate : gates) distances.push_back(distance_of(run, gate));
  return distances;
}

std::string distance_table(std::span<const GateDistance> distances) {
  AlignedTable table{.header = {"gate", "limit", "measured", "standard error", "standard errors off", ""}};
  for (const GateDistance& distance : distances) {
    const bool at_most = distance.gate.relation == Gate::Relation::kAtMost;
    table.rows.push_back({distance.gate.metric,
                          fmt::format("{} {}", at_most ? "<=" : ">=", distance.gate.limit),
                          shortest(distance.measured), shortest(distance.standard_error),
                          format_number(distance.standard_errors, 3), verdict_of(distance)});
  }
  return plain_text(table);
}

}  // namespace stereobench::harness
