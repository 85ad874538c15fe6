/// A job for a cluster: a command, cut into shards, and what the scheduler is told; read from strict YAML.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace stereobench::harness {

/// What Slurm is asked for. Empty: its own default.
struct SlurmWishes {
  int at_once = 0;  ///< shards that run at a time, at most; 0: as many as there is room for
  std::string partition;
  std::string account;
  std::string time;                  ///< of a shard, as Slurm writes it: "30" minutes, "01:30:00"
  std::string memory;                ///< of a shard: "2G"
  int cpus = 1;                      ///< of a shard: so many drives at a time
  std::vector<std::string> options;  ///< further options of sbatch, as they are
  std::filesystem::path container;   ///< an image of Apptainer that the program runs in
};

struct ClusterJob {
  std::filesystem::path file;
  std::string name;
  std::vector<std::string> command;  ///< words behind `stereobench`; their paths are relative to the file
  std::size_t shards = 1;
  std::size_t overlap = 0;    ///< see ShardArguments
  bool measures = true;       ///< whether shard 0 measures first what the others are cut by
  std::filesystem::path out;  ///< absolute
  std::string program;        ///< how the program is called on the nodes
  SlurmWishes slurm;

  std::filesystem::path folder() const;  ///< absolute, that the command is called in
  std::filesystem::path shard_folder(std::size_t number) const;
  std::filesystem::path result_folder() const { return out / "result"; }
  std::filesystem::path costs() const { return shard_folder(0) / "costs.json"; }
  std::size_t first_shard() const { return measures ? 0 : 1; }
};

/// Reads a job.
/// @param file the YAML file
/// @throws std::runtime_error of one line, "file:line: key: expected ... (got ...)"; of a line for each
///   unknown or missing key
ClusterJob read_cluster_job(const std::filesystem::path& file);

/// The words of a shard's command line but for --out, the program's name first.
/// @param number as --shard takes it: "7", "auto"
std::vector<std::string> shard_words(const ClusterJob& job, const std::string& number);

/// The words of the command line that joins all shards, behind the program's name.
std::vector<std::string> merge_words(const ClusterJob& job);

}  // namespace stereobench::harness
