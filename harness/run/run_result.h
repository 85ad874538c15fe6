/// All seeds of a run together: what run.json says.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/logs/log_facts.h"
#include "harness/noise_check/noise_check.h"
#include "harness/run/provenance.h"
#include "harness/run/seed_drive.h"
#include "harness/run/seed_metrics.h"
#include "harness/scoring/references.h"
#include "harness/scoring/score.h"
#include "harness/statistics/paired.h"

namespace stereobench::harness {

/// What renders where nothing does.
inline constexpr const char* kNoBackend = "none";

/// The filter that the others are compared with.
inline constexpr const char* kBaseline = "dead_reckoning";

/// A run's innovations, and whose they are.
struct SeedInnovations {
  std::uint64_t seed = 0;
  InnovationSum sum;
};

/// One filter over all seeds.
struct FilterResult {
  std::string filter;
  FilterSummary summary;
  std::vector<SeedInnovations> innovations;                      ///< one a run that did not fail
  double efficiency = std::numeric_limits<double>::quiet_NaN();  ///< see Efficiency
  std::optional<AssociationScore> association;  ///< of all seeds, where the logs say whose the sightings are
  slam::FilterCounters counters;                ///< what it repaired and refused, summed over the seeds
};

/// One filter beside another on the same seeds.
struct Comparison {
  std::string filter;
  std::string other;
  PairedDifference ate_m;  ///< ATE of the filter minus that of the other
};

/// What a run gave.
struct RunResult {
  std::string name;  ///< of the scenario or the log
  std::vector<std::uint64_t> seeds;
  std::string backend;                ///< what rendered, e.g. "osmesa", or kNoBackend
  std::string detector = "none";      ///< who looked at the pictures; see Recording
  std::optional<VisionScore> vision;  ///< of all seeds; empty for a sensor without pixels
  std::optional<FaultCounts> faults;  ///< of all seeds; empty where the scenario names none
  std::optional<CoarseBlur> blur;     ///< of all pictures; empty where none were rendered
  std::vector<FilterResult> filters;
  bool identities_known = true;         ///< by every sighting
  std::vector<Comparison> comparisons;  ///< each filter with those before it, dead reckoning aside
  FilterResult batch;                   ///< the whole log at once
  std::vector<BoundScores> bounds;      ///< one a seed; none where the true controls are not known
  bool start_is_true = true;            ///< of every log; see MeasurementLog
  std::optional<LogFacts> recorded;     ///< of a recorded log
  std::vector<std::string> assumed;     ///< of it: lines for people
  std::optional<NoiseCheck> noise;      ///< empty where it was not checked
  std::optional<Provenance> made_from;  ///< empty for a recorded log
  SeedMetrics seed_metrics;             ///< in the order of the seeds; empty where nobody asked for them
};

/// The content of run.json: no time, path or host in it.
/// Numbers that do not exist (an error without truth) are null.
nlohmann::ordered_json run_json(const RunResult& result);

/// The content of timing.json. @param drives how many the times are summed over
nlohmann::ordered_json timing_json(const Timing& timing, std::size_t drives);

/// One part of a bound over the seeds.
Summary over_seeds(const std::vector<BoundScores>& bounds, BoundScore BoundScores::*bound,
                   double BoundScore::*part);

}  // namespace stereobench::harness
