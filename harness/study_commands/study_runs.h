/// A scenario with other lines, again and again: what studies ask for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/kept_drives.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/run/seed_metrics.h"

namespace stereobench::harness {

/// Lines that a scenario is changed by: "key=value".
using Lines = std::vector<std::string>;

/// A scenario with changed lines and the seeds it is driven on.
struct StudyCell {
  Lines lines;
  std::vector<StreamSeeds> seeds;
};

/// With --shard, or for `merge`: what do_shard does, for a study whose cells are all known from the start.
/// @return the exit code, where the command is at its end
std::optional<int> do_study_shard(const ScenarioArguments& base, const std::vector<StudyCell>& cells,
                                  const std::filesystem::path& out, const std::string& what);

/// Drives a scenario with changed lines and keeps what has ended, so that a study that is killed goes on.
/// Cells that differ in nothing that a detector sees look once, also those that are asked for later.
class StudyRuns {
 public:
  /// @param base the scenario; its seeds are not looked at
  /// @param out an existing folder, that no other process writes to
  /// @param what is shown on the progress line
  StudyRuns(const ScenarioArguments& base, const std::filesystem::path& out, std::string what);

  /// Whether later cells share what detectors answer in these; else only cells of one call do.
  void keep_sights(bool keeps) { keeps_sights_ = keeps; }

  /// Drives what is missing. @return for each cell the metrics of its seeds, in their order
  /// @throws std::runtime_error when a scenario cannot be read with these lines; RunCrash
  std::vector<SeedMetrics> metrics(const std::vector<StudyCell>& cells);

  /// The fingerprint of the pixels; empty for a sensor without.
  const std::string& pixels() const { return pixels_; }

  /// Drives that were asked for so far.
  std::size_t drives() const { return drives_; }

  /// The results are written: the drives are no longer needed.
  void discard() { kept_.discard(); }

 private:
  const ScenarioArguments& base_;
  std::string what_;
  KeptDrives kept_;
  std::string pixels_;
  bool keeps_sights_ = false;
  std::size_t drives_ = 0;
};

}  // namespace stereobench::harness
