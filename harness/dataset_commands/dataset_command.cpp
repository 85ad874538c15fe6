#include <algorithm>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "harness/collection/collection.h"
#include "harness/collection/collection_folder.h"
#include "harness/collection/collection_plan.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/dataset_talk.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/talk.h"
#include "harness/process/interruption.h"
#include "harness/shards/shard_record.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct DatasetArguments {
  fs::path file;
  fs::path out;
  std::optional<Shard> shard;
  renderer::Backend backend = renderer::Backend::kSoftware;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  bool dry_run = false;
};

/// The drives that this call renders.
std::vector<RenderTask> drives_of(const CollectionPlan& plan, const Shard& shard) {
  std::vector<RenderTask> drives;
  for (std::size_t i = 0; i < plan.drives.size(); ++i)
    if (shard.has(i)) drives.push_back(plan.drives[i]);
  return drives;
}

/// Says what may be wrong with the scenarios, as `render` does.
void warn_of_scenarios(const CollectionPlan& plan) {
  for (const auto& experiment : plan.experiments) {
    const worlds::Scenario& scenario = experiment->scenario;
    warn_of_crossings(worlds::crossings(scenario.path, worlds::feet_of(scenario.world.walls)));
    warn_of_missing_textures(scenario, *plan.meshes);
  }
}

void say_what_would_be_done(const Collection& collection, const std::vector<RenderTask>& drives) {
  for (const RenderTask& drive : drives)
    for (const WantedDataset& wanted : drive.datasets)
      fmt::print("{}: would render frames {} of seed {} to {}\n", collection.name, text_of(drive.frames),
                 drive.seed, (wanted.folder / "").string());
}

/// Renders drives and says what became of them.
void render_drives(const Collection& collection, const std::vector<RenderTask>& drives, int jobs) {
  if (drives.empty()) return;
  const std::vector<RenderedSeed> rendered = render_seeds(drives, jobs, "dataset " + collection.name);
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const RenderTask& drive = drives[i];
    for (std::size_t k = 0; k < drive.datasets.size(); ++k)
      say_what_was_written(drive.experiment->scenario.name, *drive.datasets[k].format,
                           drive.datasets[k].folder, rendered[i].datasets[k]);
    warn_of_blur(drive.experiment->scenario.shutter, rendered[i].blur);
  }
}

fs::path default_folder(const Collection& collection, const std::optional<Shard>& shard) {
  return fs::path("out") /
         (shard ? fmt::format("{}_shard_{}_of_{}", collection.name, shard->number, shard->count)
                : collection.name);
}

/// A part goes on where drives were added to its collection: each data set says what it is made from.
ShardRecord record_of_shard(const Collection& collection, const Shard& shard, std::size_t drives) {
  return {.command = {"stereobench", "dataset", collection.name},
          .folder = fs::current_path(),
          .version = STEREOBENCH_VERSION,
          .shard = shard,
          .plan = {},
          .pixels = {},
          .store = {},
          .drives = drives};
}

int make_dataset(const DatasetArguments& arguments) {
  const Collection collection = read_collection(arguments.file);
  const Shard shard = arguments.shard.value_or(Shard{});
  const fs::path out = arguments.out.empty() ? default_folder(collection, arguments.shard) : arguments.out;
  const CollectionPlan plan = plan_collection(collection, arguments.backend, out);
  const std::vector<RenderTask> drives = drives_of(plan, shard);
  for (const RenderTask& drive : drives) require_room(drive.datasets, out);
  warn_of_scenarios(plan);
  if (arguments.dry_run) {
    say_what_would_be_done(collection, drives);
    return kPassed;
  }
  refuse_strangers(out, plan.record);
  prepare_output_folder(out);
  std::optional<ShardWork> shard_work;
  if (arguments.shard) shard_work.emplace(out, record_of_shard(collection, shard, drives.size()));
  begin_collection(out, plan.record);
  say_that_work_is_kept();
  render_drives(collection, drives, arguments.jobs);
  if (shard_work) shard_work->finish();
  const std::vector<std::string> missing = missing_entries(out, plan.record);
  if (!missing.empty()) {
    fmt::print(
        "{}: part {} of {} is done; {} of {} data sets are missing in {}: render the other parts, and "
        "join them with `stereobench merge`\n",
        collection.name, shard.number, shard.count, missing.size(), plan.record.datasets.size(),
        (out / "").string());
    return kPassed;
  }
  const CollectionTotals totals = finish_collection(out, plan.record);
  fmt::print("{}: {} data sets with {} stereo pairs in {}\n", collection.name, totals.datasets, totals.pairs,
             (out / "").string());
  return kPassed;
}

}  // namespace

void add_dataset_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand(
      "dataset", "render a collection: several scenarios, seeds and variations, with splits");
  auto arguments = std::make_shared<DatasetArguments>();
  command->add_option("collection", arguments->file, "the collection's file (YAML)")->required();
  command->add_option("-o,--out", arguments->out,
                      "folder for the result (default: out/<name>, out/<name>_shard_I_of_N)");
  command
      ->add_option("-j,--jobs", arguments->jobs,
                   "processes at a time, a drive each; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option_function<std::string>(
          "--shard",
          [arguments](const std::string& text) {
            arguments->shard = parse_shard(text);
            if (arguments->shard->number == 0)
              throw std::runtime_error(
                  "--shard: expected 1 or more; drives of a collection are cut by count");
          },
          "render a part of the drives alone: 2/3 is the second of three; `merge` joins the parts")
      ->type_name("I/N");
  add_backend_option(*command, arguments->backend);
  command->add_flag("--dry-run", arguments->dry_run, "check everything, say what would be done, and stop");
  add_quiet_option(*command);
  command->footer(
      "Each drive lies in SPLIT/NAME/seed_N, as `stereobench render` writes it. Beside them are index.csv,\n"
      "README.md, croissant.json and, last of all, manifest-sha256.txt. Interrupted, it goes on where it "
      "was;\n"
      "what is complete is left as it is.\n\n"
      "Example: stereobench dataset assets/datasets/quick.yaml --out out/quick --jobs 2");
  command->callback([arguments, &action] { action = [arguments] { return make_dataset(*arguments); }; });
}

}  // namespace stereobench::harness
