#include "harness/commands/shard_run.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/kept_drives.h"
#include "harness/io/atomic_file.h"
#include "harness/io/sha256.h"
#include "harness/shards/shard_conflict.h"
#include "harness/shards/shard_record.h"
#include "harness/shards/split.h"

namespace stereobench::harness {
namespace {

using DriveUnits = std::vector<std::vector<DriveTask>>;

double seconds_of(const SeedResult& seed) {
  double sum = 0.0;
  for (const auto& [stage, seconds] : seed.timing) sum += seconds;
  return sum;
}

/// For each kind of unit the first one.
std::set<std::size_t> first_of_kinds(const ShardedWork& work) {
  std::set<std::vector<std::string>> known;
  std::set<std::size_t> firsts;
  for (std::size_t unit = 0; unit < work.kinds.size(); ++unit) {
    std::vector<std::string> kinds = work.kinds[unit];
    std::ranges::sort(kinds);
    if (known.insert(std::move(kinds)).second) firsts.insert(unit);
  }
  return firsts;
}

/// What a shard does of some work.
struct ShardUnits {
  std::vector<std::size_t> units;
  bool needs_measured = false;
};

ShardUnits choose_units(const ShardedWork& work, const ShardArguments& arguments) {
  const std::set<std::size_t> firsts = first_of_kinds(work);
  if (arguments.shard->number == 0) return {{firsts.begin(), firsts.end()}};
  const DriveCosts costs = arguments.costs.empty() ? DriveCosts{} : read_costs(arguments.costs);
  const bool are_measured = costs.measured_plan == work.plan;
  std::vector<std::size_t> rest;
  std::vector<double> seconds;
  for (std::size_t unit = 0; unit < work.kinds.size(); ++unit) {
    if (are_measured && firsts.contains(unit)) continue;
    rest.push_back(unit);
    double& sum = seconds.emplace_back(0.0);
    for (const std::string& kind : work.kinds[unit]) sum += costs.seconds(kind);
  }
  ShardUnits chosen = {{}, are_measured};
  for (const std::size_t place : units_of_shard(seconds, *arguments.shard, arguments.overlap))
    chosen.units.push_back(rest[place]);
  return chosen;
}

/// Drives units into the store of a folder. @return what they cost
DriveCosts drive_units(const std::filesystem::path& out, const DriveUnits& units, const DriveWork& work,
                       int jobs) {
  KeptDrives kept(out);
  std::map<std::string, std::string> faults;
  if (work.goes_on) faults = kept.complete_groups(units, jobs, work.what);
  std::vector<DriveTask> tasks;
  for (const auto& unit : units)
    for (const DriveTask& task : unit)
      if (!faults.contains(task.key)) tasks.push_back(task);
  DriveCosts costs;
  kept.complete(tasks, jobs, work.what, [&](std::size_t index, const SeedResult& seed) {
    costs.add(tasks[index].kind, seconds_of(seed));
  });
  return costs;
}

}  // namespace

std::optional<int> do_shard(const std::filesystem::path& out, const RunArguments& run,
                            const ShardedWork& work) {
  const ShardArguments& arguments = run.shards;
  if (!arguments.plan.empty() && arguments.plan != work.plan)
    throw ShardConflict(
        "this machine would do other work than the shards did: a file that the command reads, or the "
        "program, has changed since, or other pixels are rendered here (see `stereobench doctor`)");
  if (!arguments.shard) return {};
  const Shard& shard = *arguments.shard;
  const auto [units, needs_measured] = choose_units(work, arguments);
  std::size_t drives = 0, all_drives = 0;
  for (const std::size_t unit : units) drives += work.kinds[unit].size();
  for (const auto& kinds : work.kinds) all_drives += kinds.size();
  const ShardRecord record = {.command = arguments.words,
                              .folder = std::filesystem::current_path(),
                              .version = STEREOBENCH_VERSION,
                              .shard = shard,
                              .plan = work.plan,
                              .pixels = work.pixels,
                              .store = work.store,
                              .drives = drives,
                              .needs_measured = needs_measured};
  prepare_output_folder(out);
  ShardWork shard_work(out, record);
  DriveCosts costs = work.work(units);
  if (shard.number == 0) costs.measured_plan = work.plan;
  write_file_atomically(out / kCostsFile, costs.json());
  shard_work.finish();
  fmt::print("{}: shard {} is done, {} of {} drives, in {}; `stereobench merge` joins the shards\n",
             work.what, shard.in_words(), drives, all_drives, (out / "").string());
  return kPassed;
}

ShardedWork even_work(std::string what, std::string pixels, std::string store,
                      const std::vector<std::string>& keys) {
  Sha256 plan;
  for (const std::string& key : keys) plan.add(key);
  return {.what = std::move(what),
          .plan = plan.hex(),
          .pixels = std::move(pixels),
          .store = std::move(store),
          .kinds = std::vector<std::vector<std::string>>(keys.size(), {std::string()}),
          .work = {}};
}

std::optional<int> do_shard(const std::filesystem::path& out, const RunArguments& run,
                            const DriveWork& work) {
  ShardedWork sharded = {
      .what = work.what, .plan = {}, .pixels = work.pixels, .store = kDrivesFile, .kinds = {}, .work = {}};
  Sha256 plan;
  for (const auto& unit : work.units) {
    auto& kinds = sharded.kinds.emplace_back();
    for (const DriveTask& task : unit) {
      plan.add(task.key);
      kinds.push_back(task.kind);
    }
  }
  sharded.plan = plan.hex();
  sharded.work = [&](const std::vector<std::size_t>& chosen) {
    DriveUnits units;
    for (const std::size_t unit : chosen) units.push_back(work.units[unit]);
    return drive_units(out, units, work, run.jobs);
  };
  return do_shard(out, run, sharded);
}

DriveUnits units_of(const std::vector<DriveTask>& tasks) {
  DriveUnits units;
  std::map<std::string, std::size_t> places;
  for (const DriveTask& task : tasks) {
    const std::string& shared = task.pictures.empty() ? task.key : task.pictures;
    const auto [place, is_new] = places.try_emplace(shared, units.size());
    if (is_new) units.emplace_back();
    units[place->second].push_back(task);
  }
  return units;
}

}  // namespace stereobench::harness
