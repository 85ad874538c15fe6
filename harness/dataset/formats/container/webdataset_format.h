/// Shards of WebDataset, `webdataset`: archives that loaders of PyTorch read from end to end.
#pragma once

#include <memory>

#include "harness/dataset/formats/dataset_writer.h"

namespace stereobench::harness {

/// How many stereo pairs a shard has; the last one may have fewer.
inline constexpr std::size_t kPairsOfShard = 200;

/// Refuses rolling shutters: a camera has one pose in a sample.
/// @throws std::runtime_error, one line that names the scenario's key
void check_webdataset_format(const DatasetDrive& drive);

/// Writes NAME_SEED-000000.tar and so on, with three files a pair, one after the other:
///
///     NAME_SEED_000012.json        rigs, poses, and the balls that one of the pictures shows
///     NAME_SEED_000012.left.png    the pictures, named by their step
///     NAME_SEED_000012.right.png
std::unique_ptr<DatasetWriter> webdataset_writer(const DatasetDrive& drive);

}  // namespace stereobench::harness
