/// shard.json: which shard of which work lies in a folder, and whether it is finished.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/file_lock.h"
#include "harness/shards/shard.h"

namespace stereobench::harness {

/// The record of a shard, in its folder, from the shard's start.
inline constexpr const char* kShardFile = "shard.json";

/// An empty file beside it, which the process holds that does the shard.
inline constexpr const char* kShardLock = "shard.lock";

struct ShardRecord {
  std::vector<std::string> command;  ///< words of the command line that the whole work is, but for --out
  std::filesystem::path folder;      ///< that it was called in
  std::string version;               ///< of the program
  Shard shard;
  std::string plan;    ///< SHA-256 of the keys of all drives of the whole work
  std::string pixels;  ///< fingerprint of the renderer; empty where nothing is rendered
  std::string store;   ///< the file of results; empty where they are data sets
  std::size_t drives = 0;
  bool needs_measured = false;  ///< it leaves to shard 0 what that did
  bool is_finished = false;
};

/// A shard that this process does.
class ShardWork {
 public:
  /// Takes up a folder: writes shard.json there, as unfinished, and keeps others from doing the shard.
  /// @throws std::runtime_error, one line, where another shard, or a shard of other work, lies there, or
  /// another process is at it
  ShardWork(std::filesystem::path folder, ShardRecord record);
  /// Says in shard.json that the shard is finished. All of its results are on the disk.
  void finish();

 private:
  std::filesystem::path folder_;
  ShardRecord record_;
  FileLock lock_;
};

/// Whether a process is at the shard of a folder.
bool is_under_way(const std::filesystem::path& folder);

/// @throws std::runtime_error "file: key: what was expected"
ShardRecord read_shard_record(const std::filesystem::path& folder);

}  // namespace stereobench::harness
