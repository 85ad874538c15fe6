/// What is asked of Slurm: to take jobs, and which tasks wait.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace stereobench::harness {

/// Hands a script to Slurm.
/// @param options of sbatch, beside those in the script
/// @return the job's number
/// @throws std::runtime_error, one line, with what sbatch says
std::string submit(const std::filesystem::path& script, const std::vector<std::string>& options);

/// Which tasks of array jobs wait or run.
/// @param jobs their numbers; those that Slurm no longer knows are passed over
/// @throws std::runtime_error, one line, where squeue cannot be asked
std::set<std::size_t> tasks_in_queue(const std::vector<std::string>& jobs);

}  // namespace stereobench::harness
