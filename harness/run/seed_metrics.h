/// The metrics of each seed of a run: what two results are compared by.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/run/seed_result.h"

namespace stereobench::harness {

/// Metrics by name, with one value a seed; NaN where there is none.
using SeedMetrics = std::map<std::string, std::vector<double>>;

/// Puts the metrics of seeds together, one seed after the other.
class SeedMetricsTally {
 public:
  /// Adds the metrics of a seed: the numbers of a run.json of this seed alone. Names are the keys joined by
  /// dots, without ".mean". Numbers that say something of many seeds only are left out.
  void add(const SeedResult& seed);
  const SeedMetrics& metrics() const { return metrics_; }

 private:
  SeedMetrics metrics_;
  std::size_t seeds_ = 0;
};

/// As run.json has them: {name: [value, ...]}, null where there is none.
nlohmann::ordered_json seed_metrics_json(const SeedMetrics& metrics);

}  // namespace stereobench::harness
