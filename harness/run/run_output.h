/// The files a run leaves behind.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/io/atomic_file.h"
#include "harness/run/run_curves.h"
#include "harness/run/run_tally.h"
#include "harness/run/seed_metrics.h"
#include "harness/run/seed_result.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// The scenario that a result was made from, with what the command line changed, beside the result.
inline constexpr const char* kResolvedScenario = "resolved_scenario.yaml";

/// What map.png, error.png and frames/ show: the first seed's map and pictures, and sums over the seeds.
class RunPictures {
 public:
  void add(const SeedResult& seed) { curves_.add(seed); }
  const RunCurves& curves() const { return curves_; }

  /// Writes them into a folder. @param walls drawn into the map
  void write(const std::filesystem::path& out, const RunResult& result,
             const std::vector<worlds::Wall>& walls) const;

 private:
  std::string map_of(const RunResult& result, const std::vector<worlds::Wall>& walls) const;
  std::string errors_of(const RunResult& result) const;

  RunCurves curves_;
};

/// Writes what belongs beside a result; see RunOutput::write.
using BesideResult = std::function<void(const RunResult& result, const RunCurves& curves)>;

/// A run's files, from seeds that come one after the other: lines of steps.csv are written as they come, and
/// of a seed there remain some numbers.
class RunOutput {
 public:
  /// Begins steps.csv under a temporary name.
  /// @param out an existing folder that can be written
  /// @param tally without seeds
  RunOutput(std::filesystem::path out, RunTally tally);

  /// Adds a seed. @throws std::runtime_error when its lines cannot be written
  void add(const SeedResult& seed);

  RunResult result() const;

  /// Writes steps.csv and detections.csv.gz under their names, map.png and error.png, frames/*.png,
  /// timing.json, the resolved scenario, invocation.json and, last of all, run.json: where there is a
  /// run.json, the run is complete.
  /// @param result of result(), with what it lacks
  /// @param walls drawn into the map
  /// @param write_more called when all but run.json is written
  /// @throws std::runtime_error when a file cannot be written
  void write(const RunResult& result, const std::vector<worlds::Wall>& walls,
             const BesideResult& write_more = {});

 private:
  std::filesystem::path out_;
  RunTally tally_;
  SeedMetricsTally seed_metrics_;
  RunPictures pictures_;
  AtomicFile steps_;
  std::optional<AtomicFile> detections_;  ///< once a seed has some
};

}  // namespace stereobench::harness
