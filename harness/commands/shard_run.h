/// What `--shard` does in place of the whole work of a command.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/arguments.h"
#include "harness/run/seed_drive.h"
#include "harness/shards/drive_costs.h"

namespace stereobench::harness {

/// The work of a command, in units that are done by one shard each.
struct ShardedWork {
  std::string what;                             ///< for people: "sweep ball_circle"
  std::string plan;                             ///< ShardRecord::plan
  std::string pixels;                           ///< as of pixels_of
  std::string store;                            ///< ShardRecord::store
  std::vector<std::vector<std::string>> kinds;  ///< of each unit the kinds of its drives, see DriveCosts
  /// Does some units, given by their places. @return what they cost
  std::function<DriveCosts(const std::vector<std::size_t>& units)> work;
};

/// With --shard, does that part of the work, and says so; shard.json and costs.json lie beside its results.
/// For `merge`, makes sure that the work is what the shards were cut from.
/// @param out the folder, which is made
/// @return the exit code, where the command is at its end
/// @throws std::runtime_error, one line, where the folder holds something else; ShardConflict where the work
/// is not what the shards were cut from; what the work throws
std::optional<int> do_shard(const std::filesystem::path& out, const RunArguments& run,
                            const ShardedWork& work);

/// Work in units that cost alike.
/// @param keys of the units: all that they are made from
/// @return the work without ShardedWork::work
ShardedWork even_work(std::string what, std::string pixels, std::string store,
                      const std::vector<std::string>& keys);

/// Drives that a command needs, and which of them stay together.
struct DriveWork {
  std::vector<std::vector<DriveTask>> units;  ///< drives of a unit share pictures; each has its key
  std::string what;
  std::string pixels;
  bool goes_on = false;  ///< where a drive fails
};

/// The same for drives, whose results go to the store of the folder.
std::optional<int> do_shard(const std::filesystem::path& out, const RunArguments& run, const DriveWork& work);

/// Units of drives that are shown the same pictures. @param tasks of drive_tasks
std::vector<std::vector<DriveTask>> units_of(const std::vector<DriveTask>& tasks);

}  // namespace stereobench::harness
