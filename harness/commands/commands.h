/// The subcommands. Each adds itself to the program; its options' text is in its own file.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace stereobench::harness {

/// Exit codes, as scripts and CI see them.
enum ExitCode : int {
  kPassed = 0,
  kGateBroken = 1,    ///< a gate of the scenario is broken, or a metric is worse than before
  kBadInput = 2,      ///< usage, files, or the machine
  kInconclusive = 3,  ///< with --strict: more seeds are needed
  kRunCrashed = 4,    ///< a worker process died, or a detector failed
  kNoBaseline = 5,    ///< a suite's baseline is missing, or was made of other inputs or pixels
  kConflict = 5,      ///< `merge`: shards contradict each other
  kImproved = 6,      ///< with --strict: a metric is better than before
};

/// What a parsed command line does when it is called; gives the exit code.
using Action = std::function<int()>;

/// Does what the program does when it is called with these words, the first of which is its own name.
/// @return the exit code
using Call = std::function<int(const std::vector<std::string>& words)>;

/// Each adds a subcommand that, when it is chosen, puts what is to be done into `action`.
void add_run_command(CLI::App& program, Action& action);
void add_render_command(CLI::App& program, Action& action);
void add_export_command(CLI::App& program, Action& action);
void add_dataset_command(CLI::App& program, Action& action);
void add_merge_command(CLI::App& program, Action& action, const Call& call);
void add_cluster_command(CLI::App& program, Action& action, const Call& call);
void add_verify_command(CLI::App& program, Action& action);
void add_preview_command(CLI::App& program, Action& action);
void add_import_command(CLI::App& program, Action& action);
void add_slam_command(CLI::App& program, Action& action);
void add_compare_command(CLI::App& program, Action& action);
void add_test_command(CLI::App& program, Action& action);
void add_bless_command(CLI::App& program, Action& action);
void add_replay_command(CLI::App& program, Action& action);
void add_history_command(CLI::App& program, Action& action);
void add_sweep_command(CLI::App& program, Action& action);
void add_budget_command(CLI::App& program, Action& action);
void add_attribute_command(CLI::App& program, Action& action);
void add_sensitivity_command(CLI::App& program, Action& action);
void add_world_command(CLI::App& program, Action& action);
void add_detect_command(CLI::App& program, Action& action);
void add_calibrate_command(CLI::App& program, Action& action);
void add_calibrate_rig_command(CLI::App& program, Action& action);
void add_learn_palette_command(CLI::App& program, Action& action);
void add_metrics_command(CLI::App& program, Action& action);
void add_schema_command(CLI::App& program, Action& action);
void add_faults_command(CLI::App& program, Action& action);
void add_doctor_command(CLI::App& program, Action& action);

}  // namespace stereobench::harness
