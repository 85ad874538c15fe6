#include "harness/study_commands/study_metric.h"

#include <algorithm>
#include <limits>

#include "harness/regression/gates.h"
#include "slam/filter_registry.h"

namespace stereobench::harness {
namespace {

constexpr std::string_view kMean = ".mean";
constexpr std::string_view kFilters = "filters.";

/// The filter that a metric is of; empty where it is of none.
std::string filter_of(const std::string& metric) {
  if (!metric.starts_with(kFilters)) return {};
  const std::string rest = metric.substr(kFilters.size());
  const std::string name = rest.substr(0, rest.find('.'));
  const auto known = slam::filter_names();
  return std::ranges::count(known, name) > 0 ? name : std::string();
}

/// Whether a metric of a result is a mean over the seeds.
bool has_mean(const nlohmann::ordered_json& result, const std::string& metric) {
  std::string path = "/" + metric + std::string(kMean);
  std::ranges::replace(path, '.', '/');
  return result.contains(nlohmann::ordered_json::json_pointer(path));
}

}  // namespace

std::string choose_metric(const std::string& metric, ScenarioArguments& base) {
  std::string name = metric;
  if (name.ends_with(kMean)) name.resize(name.size() - kMean.size());
  if (const std::string filter = filter_of(name); !filter.empty() && base.run.filters.empty())
    base.run.filters = {filter};
  const Experiment experiment = read_experiment(base);
  if (name.starts_with("vision.") && experiment.scenario.sensor == worlds::SensorKind::kOracle)
    throw std::runtime_error("--metric: " + name + " is of detections in pictures, and the oracle has none");
  const auto result = result_without_values(experiment);
  const Gate gate = {.metric = has_mean(result, name) ? name + std::string(kMean) : name};
  try {
    check_metrics({&gate, 1}, result);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("--metric: ") + error.what());
  }
  return name;
}

void refuse_gates(const ScenarioArguments& base) {
  if (base.run.gates.empty()) return;
  throw std::runtime_error("--gate: a study has no gates; `run` and `sweep` have");
}

std::vector<double> values_of_metric(const SeedMetrics& metrics, const std::string& metric,
                                     std::size_t seeds) {
  const auto found = metrics.find(metric);
  if (found != metrics.end()) return found->second;
  return std::vector<double>(seeds, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace stereobench::harness
