#include <fmt/format.h>

#include "harness/collection/render_tasks.h"
#include "harness/commands/commands.h"
#include "harness/commands/dataset_talk.h"
#include "harness/commands/kept_drives.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/shard_run.h"
#include "harness/process/interruption.h"

namespace stereobench::harness {
namespace {

struct RenderArguments {
  ScenarioArguments scenario;
  FrameChoice frames;
  std::vector<const DatasetFormat*> formats = {&dataset_formats().front()};
  TruthRequest truth;
  std::shared_ptr<PictureChange> change = std::make_shared<PictureChange>();
};

RenderRequest request_of(const RenderArguments& arguments) {
  return {.scenario = arguments.scenario.scenario,
          .overrides = arguments.scenario.overrides,
          .backend = arguments.scenario.backend,
          .formats = arguments.formats,
          .truth = arguments.truth,
          .frames = arguments.frames,
          .change = *arguments.change};
}

std::string in_words(const std::vector<RenderTask>& tasks) {
  return "render " + tasks.front().experiment->scenario.name;
}

/// Renders drives of one scenario, and says what became of them.
void render_and_say(const std::vector<RenderTask>& tasks, int jobs) {
  if (tasks.empty()) return;
  const worlds::Scenario& scenario = tasks.front().experiment->scenario;
  const std::vector<RenderedSeed> rendered = render_seeds(tasks, jobs, in_words(tasks));
  CoarseBlur blur;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (std::size_t k = 0; k < tasks[i].datasets.size(); ++k) {
      const WantedDataset& wanted = tasks[i].datasets[k];
      say_what_was_written(scenario.name, *wanted.format, wanted.folder, rendered[i].datasets[k]);
    }
    blur += rendered[i].blur;
  }
  warn_of_blur(scenario.shutter, blur);
}

/// With --shard, or for `merge`: what do_shard does with drives of which each is a unit.
std::optional<int> do_render_shard(const std::filesystem::path& out, const RunArguments& run,
                                   const std::vector<RenderTask>& tasks, const std::string& pixels) {
  std::vector<std::string> keys;
  for (const RenderTask& task : tasks) {
    std::string& key = keys.emplace_back(pixels);
    for (const WantedDataset& wanted : task.datasets) key += wanted.identity.dump();
  }
  ShardedWork work = even_work(in_words(tasks), pixels, {}, keys);
  work.work = [&](const std::vector<std::size_t>& units) {
    std::vector<RenderTask> chosen;
    for (const std::size_t unit : units) chosen.push_back(tasks[unit]);
    render_and_say(chosen, run.jobs);
    return DriveCosts{};
  };
  return do_shard(out, run, work);
}

int render(const RenderArguments& arguments) {
  const Experiment experiment = read_experiment(arguments.scenario);
  const worlds::Scenario& scenario = experiment.scenario;
  const RunArguments& run = arguments.scenario.run;
  const RenderRequest request = request_of(arguments);
  check_request(request, experiment);
  const std::filesystem::path out = output_folder(run, scenario.name + "_dataset");
  const std::vector<std::uint64_t> seeds =
      run.seeds.empty() ? std::vector{experiment.seeds.front()} : run.seeds;
  const std::vector<RenderTask> tasks = render_tasks(request, experiment, seeds, out, seeds.size() > 1);
  for (const RenderTask& task : tasks) require_room(task.datasets, out);
  warn_of_crossings(worlds::crossings(scenario.path, worlds::feet_of(scenario.world.walls)));
  warn_of_missing_textures(scenario, *arguments.scenario.meshes);
  if (run.dry_run) {
    for (const RenderTask& task : tasks)
      for (const WantedDataset& wanted : task.datasets)
        fmt::print("{}: would render frames {} of seed {} to {}\n", scenario.name, text_of(task.frames),
                   task.seed, (wanted.folder / "").string());
    return kPassed;
  }
  say_that_work_is_kept();
  const std::string pixels = run.shards.is_used() ? pixels_of(scenario, arguments.scenario.backend) : "";
  if (const auto end = do_render_shard(out, run, tasks, pixels)) return *end;
  render_and_say(tasks, run.jobs);
  return kPassed;
}

void add_format_option(CLI::App& command, const std::shared_ptr<RenderArguments>& arguments) {
  command
      .add_option_function<std::string>(
          "--format",
          [arguments](const std::string& names) { arguments->formats = parse_formats(names, "--format"); },
          "how the files are laid out; several, comma-separated, have a folder each: " + names_and_contents())
      ->type_name("NAME[,NAME]")
      ->default_str(std::string(dataset_formats().front().name));
}

}  // namespace

void add_render_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("render", "write a scenario's stereo pairs with their truth as a folder");
  auto arguments = std::make_shared<RenderArguments>();
  add_camera_options(*command, arguments->scenario);
  add_seed_options(*command, arguments->scenario.run);
  add_shard_options(*command, arguments->scenario.run.shards);
  command
      ->add_option_function<std::string>(
          "--frames", [arguments](const std::string& text) { arguments->frames = parse_frames(text); },
          "which steps of the drive get pictures: 7, 0..90 or 0..90:10, every tenth of them (default: all); "
          "their files are the same as those of the whole drive")
      ->type_name("A..B:STEP");
  add_picture_options(*command, arguments->change);
  add_format_option(*command, arguments);
  command->add_option_function<std::string>(
      "--truth", [arguments](const std::string& text) { arguments->truth.kinds = parse_truth(text); },
      "further truth, comma-separated, of: balls, surface, range, normal, disparity, match, flow; or all");
  command
      ->add_option_function<std::string>(
          "--truth-format",
          [arguments](const std::string& text) { arguments->truth.format = parse_truth_format(text); },
          "of depth and further truth: exact (PFM), tiff (the same numbers, compressed), or kitti (16-bit "
          "PNG "
          "of disparity, match and flow, the rest PFM)")
      ->type_name("NAME")
      ->default_str("exact");
  command->footer(
      "The format plain has left/ right/ (PNG), left_id/ right_id/ (PNG), left_depth/\n"
      "right_depth/ (PFM, planar Z in metres), calibration.yaml (as believed), true_calibration.yaml,\n"
      "balls.csv and the log that `stereobench slam` reads. --truth adds folders of the same names for\n"
      "each camera (left_flow/...), those of disparity, match and flow with what becomes of each pixel\n"
      "there: 0 nothing, 85 out of the other picture, 170 hidden in it, 255 seen.\n"
      "--every, --crop, --scale and --picture change what is written: calibration and truth go with it, and\n"
      "the observations of the log stay those of the whole pictures.\n"
      "Default: the first seed of the scenario, to out/<name>_dataset; of several seeds each has a\n"
      "folder of its own there (seed_0/). Interrupted, it goes on where it was; what is complete is\n"
      "left as it is.\n\n"
      "Example: stereobench render assets/scenarios/ball_circle.yaml --set path.laps=1 --out out/dataset");
  command->callback([arguments, command, &action] {
    arguments->scenario.run.shards.words = whole_words_of(*command);
    action = [arguments] { return render(*arguments); };
  });
}

}  // namespace stereobench::harness
