/// What is asked of Slurm: to take jobs, and which tasks wait.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stereobench::harness {

/// Hands a script to Slurm.
/// @param options of sbatch, beside those in the script
/// @return the job's number
/// @throws std::runtime_error, one line, with what sbatch says
std::string submit(const std::filesystem::path& script, const std::vector<std::string>& options);

/// A task of an array job that waits or runs.
struct QueuedTask {
  std::string job;
  std::size_t task = 0;
  /// Slurm keeps it from running, as its node failed while it was launched, until somebody releases it.
  bool is_held = false;
};

/// @param jobs numbers of array jobs; those that Slurm no longer knows are passed over
/// @throws std::runtime_error, one line, where squeue cannot be asked
std::vector<QueuedTask> tasks_in_queue(const std::vector<std::string>& jobs);

/// Lets a held task run.
/// @throws std::runtime_error, one line, with what scontrol says
void release(const QueuedTask& task);

}  // namespace stereobench::harness
