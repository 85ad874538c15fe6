/// Reads shards of WebDataset, of `stereobench render` and of others.
#pragma once

#include "harness/verify/dataset_view.h"

namespace stereobench::harness {

bool looks_like_webdataset(const std::filesystem::path& folder);
/// A frame is a sample: the members of a shard that share a name up to its first point. Members whose kind
/// begins with `left` or `right` are the pictures of a pair; a picture alone is a left one. Rigs, poses and
/// balls are read of samples whose .json has a `rig`, as ours.
DatasetView read_webdataset_view(const std::filesystem::path& folder);

}  // namespace stereobench::harness
