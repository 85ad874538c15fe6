#include <fmt/format.h>

#include "harness/collection/merge.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/process/interruption.h"
#include "harness/process/progress.h"
#include "harness/process/standard_streams.h"

namespace stereobench::harness {
namespace {

struct MergeArguments {
  std::vector<std::filesystem::path> shards;
  std::filesystem::path out;
};

int merge(const MergeArguments& arguments) {
  say_that_work_is_kept();
  try {
    CollectionTotals totals;
    {
      Progress progress("merge", 1.0);
      totals = merge_shards(arguments.shards, arguments.out, [&](double done) { progress.show(done); });
    }
    fmt::print("{} data sets with {} stereo pairs in {}\n", totals.datasets, totals.pairs,
               (arguments.out / "").string());
    return kPassed;
  } catch (const ShardConflict& conflict) {
    complain(conflict);
    return kConflict;
  }
}

}  // namespace

void add_merge_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("merge", "join the parts of a collection that `dataset` rendered");
  auto arguments = std::make_shared<MergeArguments>();
  command->add_option("shards", arguments->shards, "folders that `stereobench dataset --shard` wrote")
      ->required();
  command->add_option("-o,--out", arguments->out, "folder for the result; may be one of them")->required();
  add_quiet_option(*command);
  command->footer(
      "Files are checked, then linked, or copied where the file systems differ. The result is, to the byte,\n"
      "what `dataset` writes in one piece. A file that two parts have with different bytes ends it with "
      "exit\n"
      "code 5. Interrupted, it goes on where it was.\n\n"
      "Example: stereobench merge out/part_1 out/part_2 --out out/whole");
  command->callback([arguments, &action] { action = [arguments] { return merge(*arguments); }; });
}

}  // namespace stereobench::harness
