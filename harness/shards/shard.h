/// A part of some work: one of several shards that different processes or machines do.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stereobench::harness {

struct Shard {
  std::size_t number = 1;  ///< from 1; 0: the shard that measures what the work costs
  std::size_t count = 1;

  /// Whether a task is the shard's, where every `count`-th one is.
  bool has(std::size_t task) const { return task % count == number - 1; }
  /// "2 of 40"
  std::string in_words() const;
};

/// Reads "2/3", the second of three; "0/3", which measures what the work costs; or "auto/3", whose number is
/// that of the task in an array of Slurm (SLURM_ARRAY_TASK_ID, from 0) or of the pod in an Indexed Job of
/// Kubernetes (JOB_COMPLETION_INDEX).
/// @throws std::runtime_error, one line that begins with "--shard: ", for anything else, and for "auto/3"
/// where neither variable is set, or both are, or one is not a number from 0 to 2
Shard parse_shard(std::string_view text);

}  // namespace stereobench::harness
