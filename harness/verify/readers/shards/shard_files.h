/// The members of a folder's shards, put together to samples.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/verify/dataset_view.h"
#include "harness/verify/readers/shards/tar_listing.h"

namespace stereobench::harness {

/// Members that follow each other and share a name up to its first point.
struct ShardFiles {
  std::string shard;                         ///< the archive's name
  std::string key;                           ///< the members' common name
  std::map<std::string, TarMember> members;  ///< by what is behind it: "left.png"

  /// "bend_0-000000.tar/bend_0_000002.left.png", as messages name a member.
  std::string place(const std::string& kind) const { return shard + "/" + key + "." + kind; }
};

/// Reads the headers of all archives of a folder, in order of their names. Broken archives, shards whose
/// number is left out, members that are missing, and samples whose members are apart become faults.
std::vector<ShardFiles> shard_files(DatasetView& view);

}  // namespace stereobench::harness
