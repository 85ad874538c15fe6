/// The scripts that a job hands to Slurm: they are kept, and can be read, changed and submitted by hand.
#pragma once

#include <string>

#include "harness/cluster/cluster_job.h"

namespace stereobench::harness {

inline constexpr const char* kMeasureScript = "measure.sbatch";
inline constexpr const char* kShardsScript = "shards.sbatch";
inline constexpr const char* kMergeScript = "merge.sbatch";

/// Shard 0 alone.
std::string measure_script(const ClusterJob& job);

/// One shard: that of SLURM_ARRAY_TASK_ID, which counts from 0. Which tasks of the array there are, and how
/// many run at a time, is said to sbatch.
std::string shards_script(const ClusterJob& job);

/// Joins all shards.
std::string merge_script(const ClusterJob& job);

}  // namespace stereobench::harness
