/// What the samples of shards say of themselves and of each other.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "harness/verify/readers/shards/shard_files.h"
#include "harness/verify/readers/shards/shard_sample.h"

namespace stereobench::harness {

struct SampleOfFiles {
  ShardFiles files;
  std::optional<ShardSample> said;  ///< by its .json, where that is as ours
};

/// Where a drive's ball is in DatasetView::balls, by the drive's name, seed, and the ball's number.
using BallPlaces = std::map<std::tuple<std::string, std::uint64_t, int>, int>;

/// Lists all balls in the view. One that samples say differently is a fault.
BallPlaces balls_of_drives(DatasetView& view, const std::vector<SampleOfFiles>& samples);

/// Names against what is in them, rigs of samples against each other, and poses of robot and cameras against
/// the rig. What disagrees in most samples is one fault.
/// @param right_is_late the right camera looks later, so that poses alone say where it was
void check_samples(DatasetView& view, const std::vector<SampleOfFiles>& samples, bool right_is_late);

}  // namespace stereobench::harness
