/// Drives that are kept while a run or sweep is under way, so that one that is killed goes on where it was.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/commands/scenario_arguments.h"
#include "harness/run/provenance.h"
#include "harness/run/seed_result.h"
#include "harness/store/answer_store.h"

namespace stereobench::harness {

/// The fingerprint of the pixels that a scenario's cameras get here; empty for a sensor without pixels. It is
/// found in a process of its own: this one shall have no GL context when it forks.
std::string pixels_of(const worlds::Scenario& scenario, renderer::Backend backend);

/// What an experiment was read from.
/// @param experiment as read_experiment gives it for the same arguments
/// @param pixels as of pixels_of
Provenance provenance_of(const ScenarioArguments& arguments, const std::vector<std::string>& more_overrides,
                         const Experiment& experiment, const std::string& pixels);

/// One task a seed of an experiment, with its key. The outcome of a drive depends neither on the other seeds
/// nor on gates, and so does the key. Those that need no pictures beside the detector's answers say which
/// look they share (DriveTask::sight).
/// @param parts wanted of each seed; the map and the snapshots of the first alone, logs of kCheckedLogs, and
/// of later seeds four stereo pairs at most
std::vector<DriveTask> drive_tasks(const ScenarioArguments& arguments,
                                   const std::vector<std::string>& more_overrides,
                                   const Experiment& experiment, const std::string& pixels,
                                   const SeedParts& parts);

/// The same for seeds that differ from part to part, in place of the experiment's.
std::vector<DriveTask> drive_tasks(const ScenarioArguments& arguments,
                                   const std::vector<std::string>& more_overrides,
                                   const Experiment& experiment, const std::string& pixels,
                                   const SeedParts& parts, const std::vector<StreamSeeds>& seeds);

/// Lets tasks that are shown the same pictures by the same detector look once. Those that are alone keep no
/// answers: nobody would read them.
/// @param tasks of drive_tasks, of one or of several experiments
void look_once(std::vector<DriveTask>& tasks);

/// Whether a scenario with some overrides, and with others, is the same to its detector.
bool share_sight(const ScenarioArguments& base, const std::vector<std::string>& some,
                 const std::vector<std::string>& others);

/// The store of an output folder. What a killed program left half-written there is removed.
/// @throws std::runtime_error when another process is writing there
class KeptDrives {
 public:
  explicit KeptDrives(const std::filesystem::path& out);
  /// Drives what is missing, and says how much is not.
  /// @param on_seed told of all results in the order of the tasks (drive_into)
  void complete(const std::vector<DriveTask>& tasks, int jobs, const std::string& what,
                const OnSeed& on_seed);
  /// Drives what is missing of tasks that share pictures, and goes on where one fails.
  /// @return why there is no result, by the key of the task
  std::map<std::string, std::string> complete_groups(const std::vector<std::vector<DriveTask>>& groups,
                                                     int jobs, const std::string& what);
  /// Hands on results that are there.
  /// @param on_seed told of all in the order of the tasks
  void hand_on(const std::vector<DriveTask>& tasks, const OnSeed& on_seed) const;
  /// The results are written: the drives are no longer needed.
  void discard() { store_.remove(); }

 private:
  void say_what_is_kept(const std::vector<DriveTask>& tasks, const std::string& what) const;

  AnswerStore store_;
  mutable bool has_said_ = false;  ///< what is kept: later calls find what earlier ones made
};

}  // namespace stereobench::harness
