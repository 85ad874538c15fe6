/// Limits that a scenario puts on its run's metrics.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/run/run_result.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// A limit that a result does not keep.
struct BrokenGate {
  worlds::Gate gate;
  std::optional<double> value;  ///< empty: the metric has no value
  std::string message;          ///< one line: the metric, its value, the limit, by how much
};

/// The gates that speak of a run: not those of a filter that was left out.
std::vector<worlds::Gate> gates_of(const worlds::Scenario& scenario);

/// Makes sure, before any work is done, that each gate names a number of run.json.
/// @throws std::runtime_error that names the gate which does not
void check_metrics(std::span<const worlds::Gate> gates, const worlds::Scenario& scenario);

/// Holds a result against limits.
/// @param json as run_json gives it
std::vector<BrokenGate> broken_gates(const nlohmann::ordered_json& json, std::span<const worlds::Gate> gates);

}  // namespace stereobench::harness
