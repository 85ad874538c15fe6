/// How far gates are from what is measured, in standard errors.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/experiment/types.h"

namespace stereobench::harness {

/// A gate beside what it limits.
struct GateDistance {
  Gate gate;
  std::optional<double> measured;        ///< as run.json has it; empty: no value
  std::optional<double> standard_error;  ///< of what is measured; empty where the seeds do not tell
  /// From what is measured to the limit, in standard errors; below 0: the gate is broken. Infinite where
  /// there is a way to go and no standard error.
  double standard_errors = 0.0;

  bool is_broken() const { return !(standard_errors >= 0.0); }
  /// @return whether the limit is beyond three standard errors: such a gate lets too much pass
  bool is_far() const { return standard_errors > 3.0; }
};

/// Holds each gate against the result of a run.
///
/// The standard error is that of the mean over the seeds: their standard deviation by the root of their
/// number. Of a count, which is a sum over the seeds, it is as many times larger as there are seeds, and at
/// least 1. Of a rate that is 1 or 0 it is one thing among those that were counted. So three standard errors
/// of what never happened are three events: the rule of three, which is the end of its 95 % interval.
/// @param run a run.json, with per_seed
/// @throws std::runtime_error, one line, when run.json has no such number
std::vector<GateDistance> gate_distances(const nlohmann::ordered_json& run, std::span<const Gate> gates);

/// A line for each gate: limit, measured, standard error, distance, verdict.
std::string distance_table(std::span<const GateDistance> distances);

}  // namespace stereobench::harness
