#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.h"
#include "harness/commands/kept_drives.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/dataset/formats/format_registry.h"
#include "harness/dataset/rendered_dataset.h"
#include "harness/dataset/seed_render.h"
#include "harness/experiment/write_experiment.h"
#include "harness/io/file_list.h"
#include "harness/process/interruption.h"
#include "harness/process/standard_streams.h"
#include "harness/run/provenance.h"
#include "renderer/backend.h"
#include "vision/observe.h"

namespace stereobench::harness {
namespace {

struct RenderArguments {
  ScenarioArguments scenario;
  FrameChoice frames;
  const DatasetFormat* format = &dataset_formats().front();
  TruthRequest truth;
};

/// Says which rendering a folder holds, so that an interrupted one is not taken up by another: the scenario's
/// own text, what was changed of it, the files that it names, what renders, who looks, what was asked for,
/// and the program's version. The size of balls is what `detect` is told.
nlohmann::ordered_json identity_of(const RenderArguments& arguments, const Experiment& experiment,
                                   const FrameChoice& frames) {
  const worlds::Scenario& scenario = experiment.scenario;
  const ScenarioArguments& asked = arguments.scenario;
  std::ostringstream text;
  text << std::ifstream(asked.scenario, std::ios::binary).rdbuf();
  const std::string& detector = experiment.detector.command;
  nlohmann::ordered_json identity = {
      {"schema", 2},
      {"stereobench", STEREOBENCH_VERSION},
      {"seed", nullptr},
      {"asked_frames", text_of(frames)},
      {"set", asked.overrides},
      {"backend", renderer::name_of(asked.backend)},
      {"detector", detector.empty() ? "stereobench" : detector},
      {"detector_files_sha256", files_of_command(detector)},
      {"scenario", text.str()},
      {"files_sha256", hashes_of_named_files(asked.scenario, asked.overrides)}};
  identity[kBallSize] = {{"radius_m", scenario.world.ball_radius_m()},
                         {"radius_sd_m", scenario.world.ball_radius_sd_m}};
  if (scenario.rows_within_px != vision::ObserverSettings{}.rows_within_px)
    identity[kRowsWithin] = scenario.rows_within_px;
  for (const TruthKind kind : arguments.truth.kinds) identity["truth"].push_back(name_of(kind));
  if (arguments.truth.format == TruthFormat::kKitti) identity["truth_format"] = "kitti";
  if (arguments.format != &dataset_formats().front()) identity["format"] = arguments.format->name;
  return identity;
}

/// One task a seed; of several, each has a folder of its own.
std::vector<RenderTask> render_tasks(const RenderArguments& arguments, const Experiment& experiment,
                                     const std::filesystem::path& out) {
  const FrameChoice frames = frames_of_drive(arguments.frames, experiment.scenario.path.size());
  std::vector<std::uint64_t> seeds = arguments.scenario.run.seeds;
  if (seeds.empty()) seeds = {experiment.seeds.front()};
  const RenderTask any_seed = {.experiment = &experiment,
                               .format = arguments.format,
                               .frames = frames,
                               .truth = arguments.truth,
                               .backend = arguments.scenario.backend,
                               .folder = out,
                               .identity = identity_of(arguments, experiment, frames)};
  std::vector<RenderTask> tasks;
  for (const std::uint64_t seed : seeds) {
    tasks.push_back(any_seed);
    tasks.back().seed = seed;
    tasks.back().identity["seed"] = seed;
    if (seeds.size() > 1) tasks.back().folder = out / fmt::format("seed_{}", seed);
  }
  return tasks;
}

/// Folders that hold something else are refused before anything is rendered.
void check_folders(const std::vector<RenderTask>& tasks, const std::filesystem::path& out) {
  if (tasks.size() > 1 && holds_rendering(out))
    throw std::runtime_error(fmt::format(
        "{}: holds a data set itself, and cannot hold one for each seed; choose another folder or remove it",
        out.string()));
  for (const RenderTask& task : tasks) require_same_rendering(task.folder, task.identity);
}

void say_what_was_done(const RenderTask& task, const RenderedSeed& rendered) {
  const std::string folder = (task.folder / "").string();
  if (!rendered.spoilt.empty())
    note(
        fmt::format("{}: {} files were missing or not as they had been written (the first: {}); they are "
                    "rendered again",
                    folder, rendered.spoilt.size(), rendered.spoilt.front()));
  if (rendered.was_complete)
    fmt::print("{} is complete and is left as it is\n", folder);
  else
    fmt::print("{}: {} stereo pairs with {} in {}\n", task.experiment->scenario.name, rendered.pairs,
               task.format->holds, folder);
}

int render(const RenderArguments& arguments) {
  const Experiment experiment = read_experiment(arguments.scenario);
  const worlds::Scenario& scenario = experiment.scenario;
  const RunArguments& run = arguments.scenario.run;
  if (scenario.sensor != worlds::SensorKind::kStereo)
    throw std::runtime_error(fmt::format(
        "{}: its sensor is the oracle, which has no pictures to render; set sensor.kind to stereo",
        arguments.scenario.scenario.string()));
  arguments.format->check(scenario, arguments.truth);
  const std::filesystem::path out = output_folder(run, scenario.name + "_dataset");
  const std::vector<RenderTask> tasks = render_tasks(arguments, experiment, out);
  check_folders(tasks, out);
  warn_of_crossings(worlds::crossings(scenario.path, worlds::feet_of(scenario.world.walls)));
  warn_of_missing_textures(scenario, *arguments.scenario.meshes);
  if (run.dry_run) {
    for (const RenderTask& task : tasks)
      fmt::print("{}: would render frames {} of seed {} to {}\n", scenario.name, text_of(task.frames),
                 task.seed, (task.folder / "").string());
    return kPassed;
  }
  say_that_work_is_kept();
  const std::vector<RenderedSeed> rendered = render_seeds(tasks, run.jobs, "render " + scenario.name);
  CoarseBlur blur;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    say_what_was_done(tasks[i], rendered[i]);
    blur += rendered[i].blur;
  }
  warn_of_blur(scenario.shutter, blur);
  return kPassed;
}

void add_format_option(CLI::App& command, const std::shared_ptr<RenderArguments>& arguments) {
  std::string formats;
  for (const DatasetFormat& format : dataset_formats())
    formats += fmt::format("{}{} ({})", formats.empty() ? "" : ", ", format.name, format.holds);
  command
      .add_option_function<std::string>(
          "--format", [arguments](const std::string& name) { arguments->format = &dataset_format(name); },
          "how the files are laid out: " + formats)
      ->type_name("NAME")
      ->default_str(std::string(dataset_formats().front().name));
}

}  // namespace

void add_render_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("render", "write a scenario's stereo pairs with their truth as a folder");
  auto arguments = std::make_shared<RenderArguments>();
  add_camera_options(*command, arguments->scenario);
  add_seed_options(*command, arguments->scenario.run);
  command
      ->add_option_function<std::string>(
          "--frames", [arguments](const std::string& text) { arguments->frames = parse_frames(text); },
          "which steps of the drive get pictures: 7, 0..90 or 0..90:10, every tenth of them (default: all); "
          "their files are the same as those of the whole drive")
      ->type_name("A..B:STEP");
  add_format_option(*command, arguments);
  CLI::Option* const truth = command->add_option_function<std::string>(
      "--truth", [arguments](const std::string& text) { arguments->truth.kinds = parse_truth(text); },
      "further truth, comma-separated, of: balls, surface, range, normal, disparity, match, flow; or all");
  command
      ->add_option_function<std::string>(
          "--truth-format",
          [arguments](const std::string& text) { arguments->truth.format = parse_truth_format(text); },
          "of disparity, match and flow: exact (PFM) or kitti (16-bit PNG)")
      ->type_name("NAME")
      ->default_str("exact")
      ->needs(truth);
  command->footer(
      "The format stereobench has left/ right/ (PNG), left_id/ right_id/ (PNG), left_depth/\n"
      "right_depth/ (PFM, planar Z in metres), calibration.yaml (as believed), true_calibration.yaml,\n"
      "balls.csv and the log that `stereobench slam` reads. --truth adds folders of the same names for\n"
      "each camera (left_flow/...), those of disparity, match and flow with what becomes of each pixel\n"
      "there: 0 nothing, 85 out of the other picture, 170 hidden in it, 255 seen.\n"
      "Default: the first seed of the scenario, to out/<name>_dataset; of several seeds each has a\n"
      "folder of its own there (seed_0/). Interrupted, it goes on where it was; what is complete is\n"
      "left as it is.\n\n"
      "Example: stereobench render assets/scenarios/ball_circle.yaml --set path.laps=1 --out out/dataset");
  command->callback([arguments, &action] { action = [arguments] { return render(*arguments); }; });
}

}  // namespace stereobench::harness
