#include "harness/run/seed_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "harness/json/json_numbers.h"
#include "harness/run/run_tally.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Blocks of run.json that are measurements of one seed.
constexpr std::array<const char*, 5> kBlocks = {"vision", "bound", "smoothing_bound", "batch", "filters"};

/// Ends of names that are settings, or say something of many seeds only.
constexpr std::array<std::string_view, 5> kLeftOut = {".particles", ".ate_aligned_median_m",
                                                      ".consistency.nis.runs_outside_band99",
                                                      ".consistency.nis.landmarks", ".consistency.nees"};

/// Summaries count with their mean: that of one seed is its value.
void collect(const Json& json, const std::string& name, std::map<std::string, double>& numbers) {
  if (std::ranges::any_of(kLeftOut, [&](std::string_view end) { return name.ends_with(end); })) return;
  if (json.is_number()) numbers[name] = json.get<double>();
  if (!json.is_object()) return;
  if (const auto mean = json.find("mean"); mean != json.end()) return collect(*mean, name, numbers);
  for (const auto& [key, child] : json.items()) collect(child, name + "." + key, numbers);
}

/// The numbers of a run of this seed alone.
std::map<std::string, double> numbers_of(const SeedResult& seed) {
  RunTally tally("", kNoBackend);
  tally.add(seed);
  const Json run = run_json(tally.result());
  std::map<std::string, double> numbers;
  for (const char* block : kBlocks) collect(run.at(block), block, numbers);
  return numbers;
}

/// A number of run.json; a count without decimals.
Json shortest(double value) {
  constexpr double kLargestExact = 9e15;
  if (std::abs(value) < kLargestExact && std::trunc(value) == value) return static_cast<std::int64_t>(value);
  return number(value);
}

}  // namespace

void SeedMetricsTally::add(const SeedResult& seed) {
  for (const auto& [name, value] : numbers_of(seed)) {
    std::vector<double>& values = metrics_[name];
    values.resize(seeds_, kNone);
    values.push_back(value);
  }
  ++seeds_;
  for (auto& [name, values] : metrics_) values.resize(seeds_, kNone);
}

nlohmann::ordered_json seed_metrics_json(const SeedMetrics& metrics) {
  Json json = Json::object();
  for (const auto& [name, values] : metrics) {
    Json& list = json[name] = Json::array();
    for (const double value : values) list.push_back(shortest(value));
  }
  return json;
}

}  // namespace stereobench::harness
