#include "harness/regression/gates.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/regression/metric_names.h"
#include "worlds/yaml/advice.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// The number (or null) at a dotted path such as "filters.ufastslam.ate_rms_m.mean"; nothing when there is
/// none. A key may have dots itself.
const Json* find_metric(const Json& json, std::string_view path) {
  if (!json.is_object()) return nullptr;
  for (const auto& [key, child] : json.items()) {
    if (path == key) return child.is_number() || child.is_null() ? &child : nullptr;
    if (!path.starts_with(key) || path.size() <= key.size() || path[key.size()] != '.') continue;
    if (const Json* const found = find_metric(child, path.substr(key.size() + 1))) return found;
  }
  return nullptr;
}

/// "ufastslam" of "filters.ufastslam.ate_rms_m.mean"; empty for other metrics.
std::string filter_of(const std::string& metric) {
  const std::string prefix = "filters.";
  if (!metric.starts_with(prefix)) return "";
  return metric.substr(prefix.size(), metric.find('.', prefix.size()) - prefix.size());
}

/// Has all the keys that a result has.
RunResult result_without_runs(const Experiment& experiment) {
  RunResult nothing_yet;
  if (experiment.scenario.sensor == worlds::SensorKind::kStereo) nothing_yet.vision = VisionScore{};
  for (const std::string& filter : experiment.filters) nothing_yet.filters.push_back({.filter = filter});
  return nothing_yet;
}

std::string broken_message(const Gate& gate, const Json& metric) {
  const bool at_most = gate.relation == Gate::Relation::kAtMost;
  const std::string limit = fmt::format("{} {}", at_most ? "at most" : "at least", gate.limit);
  if (metric.is_null()) return fmt::format("{} has no value, expected {}", gate.metric, limit);
  const double value = metric.get<double>();
  return fmt::format("{} is {}, expected {}: off by {}", gate.metric, value, limit,
                     format_number(std::abs(value - gate.limit)));
}

bool holds(const Gate& gate, const Json& metric) {
  if (metric.is_null()) return false;
  const double value = metric.get<double>();
  return gate.relation == Gate::Relation::kAtMost ? value <= gate.limit : value >= gate.limit;
}

}  // namespace

std::vector<Gate> gates_of(const Experiment& experiment) {
  const std::vector<std::string> known = slam::filter_names();
  std::vector<Gate> gates;
  for (const Gate& gate : experiment.gates) {
    const std::string filter = filter_of(gate.metric);
    const bool left_out =
        std::ranges::count(known, filter) > 0 && std::ranges::count(experiment.filters, filter) == 0;
    if (!left_out) gates.push_back(gate);
  }
  return gates;
}

Gate parse_gate(const std::string& text) {
  for (const auto& [sign, relation] :
       {std::pair("<=", Gate::Relation::kAtMost), std::pair(">=", Gate::Relation::kAtLeast)}) {
    const std::size_t at = text.find(sign);
    if (at == std::string::npos || at == 0) continue;
    Gate gate{.metric = text.substr(0, at), .relation = relation};
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data() + at + 2, end, gate.limit);
    if (error == std::errc() && read == end && std::isfinite(gate.limit)) return gate;
  }
  throw std::runtime_error(fmt::format(
      "--gate: expected a metric, <= or >=, and a limit, e.g. 'vision.recall>=0.98' (got '{}')", text));
}

Json result_without_values(const Experiment& experiment) {
  return run_json(result_without_runs(experiment));
}

void check_metrics(std::span<const Gate> gates, const Json& result) {
  for (const Gate& gate : gates) {
    if (find_metric(result, gate.metric) != nullptr) continue;
    const std::vector<std::string> metrics = metric_names(result);
    const std::vector<std::string_view> known(metrics.begin(), metrics.end());
    const auto meant = worlds::nearest_word(gate.metric, known);
    throw std::runtime_error(fmt::format("gate '{}': the result has no such number{}", gate.metric,
                                         meant ? fmt::format(", did you mean {}?", *meant)
                                               : "; gates name one by its keys, e.g. vision.recall"));
  }
}

std::optional<double> limited_value(const nlohmann::ordered_json& json, const Gate& gate) {
  const Json* metric = find_metric(json, gate.metric);
  if (metric == nullptr) throw std::invalid_argument("limited_value: no metric " + gate.metric);
  return metric->is_null() ? std::nullopt : std::optional(metric->get<double>());
}

std::vector<BrokenGate> broken_gates(const nlohmann::ordered_json& json, std::span<const Gate> gates) {
  std::vector<BrokenGate> broken;
  for (const Gate& gate : gates) {
    const Json* metric = find_metric(json, gate.metric);
    if (metric == nullptr) throw std::invalid_argument("broken_gates: no metric " + gate.metric);
    if (holds(gate, *metric)) continue;
    const auto value = metric->is_null() ? std::nullopt : std::optional<double>(metric->get<double>());
    broken.push_back({gate, value, broken_message(gate, *metric)});
  }
  return broken;
}

std::string gate_report(std::span<const BrokenGate> broken, std::size_t gates, const std::string& where) {
  std::string report;
  for (const BrokenGate& gate : broken) report += fmt::format("gate broken: {}{}\n", where, gate.message);
  if (gates > 0 && broken.empty()) report = fmt::format("{}all {} gates hold\n", where, gates);
  return report;
}

}  // namespace stereobench::harness
