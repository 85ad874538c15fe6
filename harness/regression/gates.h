/// Limits that an experiment puts on its run's metrics.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/experiment/types.h"
#include "harness/run/run_result.h"

namespace stereobench::harness {

/// A limit that a result does not keep.
struct BrokenGate {
  Gate gate;
  std::optional<double> value;  ///< empty: the metric has no value
  std::string message;          ///< one line: the metric, its value, the limit, by how much
};

/// The gates that speak of a run: not those of a filter that was left out.
std::vector<Gate> gates_of(const Experiment& experiment);

/// Reads a gate of the command line: "vision.recall>=0.98", "filters.ufastslam.ate_rms_m.mean<=0.05".
/// @throws std::runtime_error that says what was expected
Gate parse_gate(const std::string& text);

/// What a run of an experiment would give, without values: run.json with all keys that gates can name.
nlohmann::ordered_json result_without_values(const Experiment& experiment);

/// Makes sure, before any work is done, that each gate names a number of a result.
/// @param result its values do not matter
/// @throws std::runtime_error that names the gate which does not, and a number that may be meant
void check_metrics(std::span<const Gate> gates, const nlohmann::ordered_json& result);

/// The number that a gate limits. @return empty where it is null
/// @throws std::invalid_argument when the result has no such number
std::optional<double> limited_value(const nlohmann::ordered_json& json, const Gate& gate);

/// Holds a result against limits.
/// @param json as run_json gives it
std::vector<BrokenGate> broken_gates(const nlohmann::ordered_json& json, std::span<const Gate> gates);

/// A line for each broken gate, or one that says that all hold; empty where there are none.
/// @param where of a sweep, the cell that the gates are about, e.g. "gain = 2: "
std::string gate_report(std::span<const BrokenGate> broken, std::size_t gates, const std::string& where = "");

}  // namespace stereobench::harness
