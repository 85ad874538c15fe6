#include <algorithm>
#include <thread>

#include <fmt/format.h>

#include "harness/collection/collection_record.h"
#include "harness/collection/dataset_placement.h"
#include "harness/collection/merge.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/process/interruption.h"
#include "harness/process/progress.h"
#include "harness/process/standard_streams.h"
#include "harness/shards/merge_results.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<fs::path> shards;
  fs::path out;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
};

int merge_collection(const MergeArguments& arguments) {
  CollectionTotals totals;
  {
    Progress progress("merge", 1.0);
    totals = merge_shards(arguments.shards, arguments.out, [&](double done) { progress.show(done); });
  }
  fmt::print("{} data sets with {} stereo pairs in {}\n", totals.datasets, totals.pairs,
             (arguments.out / "").string());
  return kPassed;
}

/// Goes to the folder that the shards were called in: their command names files from there.
void enter(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    note(fmt::format("merge: there is no {}, where the shards were called; files are looked for from here",
                     folder.string()));
    return;
  }
  fs::current_path(folder);
}

/// Joins what shards of a command have done, and lets the command itself do the rest: it finds all drives
/// done, and writes its results.
int merge_work(const MergeArguments& arguments, const Call& call) {
  for (const fs::path& shard : arguments.shards)
    if (fs::exists(arguments.out) && fs::equivalent(shard, arguments.out))
      throw std::runtime_error("--out: expected a folder that is none of the shards");
  const ShardRecord record = check_shards(arguments.shards);
  prepare_output_folder(arguments.out);
  {
    Progress progress("merge", 1.0);
    merge_results(arguments.shards, arguments.out, [&](double done) { progress.show(done); });
    place_datasets(arguments.shards, arguments.out);
  }
  std::vector<std::string> words = record.command;
  const fs::path out = record.folder == fs::current_path() ? arguments.out : fs::absolute(arguments.out);
  words.insert(words.end(),
               {"--out", out.string(), "--plan", record.plan, "--jobs", std::to_string(arguments.jobs)});
  enter(record.folder);
  return call(words);
}

int merge(const MergeArguments& arguments, const Call& call) {
  say_that_work_is_kept();
  try {
    const fs::path& first = arguments.shards.front();
    const bool is_work = fs::exists(first / kShardFile) && !fs::exists(first / kCollectionFile);
    return is_work ? merge_work(arguments, call) : merge_collection(arguments);
  } catch (const ShardConflict& conflict) {
    complain(conflict);
    return kConflict;
  }
}

}  // namespace

void add_merge_command(CLI::App& program, Action& action, const Call& call) {
  CLI::App* command = program.add_subcommand("merge", "join the shards of a command's work");
  auto arguments = std::make_shared<MergeArguments>();
  command->add_option("shards", arguments->shards, "folders that commands with --shard wrote, all of them")
      ->required();
  command->add_option("-o,--out", arguments->out, "folder for the result")->required();
  command->add_option("-j,--jobs", arguments->jobs, "processes at a time, for what no shard could know to do")
      ->check(CLI::Range(1, 1024));
  add_quiet_option(*command);
  command->footer(
      "The result is, to the byte, what the command writes without --shard. Of a collection, files are\n"
      "checked, then linked, or copied where the file systems differ. Shards that are missing or unfinished\n"
      "are named. Shards that contradict each other, or have changed since they were written, end it with\n"
      "exit code 5: a machine computes, renders or stores differently. Interrupted, it goes on where it "
      "was.\n\n"
      "Example: stereobench merge out/shard_1 out/shard_2 --out out/whole");
  command->callback(
      [arguments, &action, call] { action = [arguments, call] { return merge(*arguments, call); }; });
}

}  // namespace stereobench::harness
