#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.h"
#include "harness/commands/dataset_talk.h"
#include "harness/commands/kept_drives.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/dataset/drive_json.h"
#include "harness/dataset/formats/format_registry.h"
#include "harness/dataset/rendered_dataset.h"
#include "harness/dataset/seed_render.h"
#include "harness/experiment/write_experiment.h"
#include "harness/io/file_list.h"
#include "harness/process/interruption.h"
#include "harness/run/provenance.h"
#include "renderer/backend.h"
#include "vision/observe.h"

namespace stereobench::harness {
namespace {

struct RenderArguments {
  ScenarioArguments scenario;
  FrameChoice frames;
  std::vector<const DatasetFormat*> formats = {&dataset_formats().front()};
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
  identity[kDrive] = drive_json(drive_of(scenario, scenario.world, 0));
  if (scenario.rows_within_px != vision::ObserverSettings{}.rows_within_px)
    identity[kRowsWithin] = scenario.rows_within_px;
  return identity;
}

/// The same of one format's data set.
nlohmann::ordered_json identity_of(nlohmann::ordered_json identity, const RenderArguments& arguments,
                                   const DatasetFormat& format, std::uint64_t seed) {
  identity["seed"] = seed;
  if (!is_plain(format)) {
    identity["format"] = format.name;
    return identity;
  }
  for (const TruthKind kind : arguments.truth.kinds) identity["truth"].push_back(name_of(kind));
  if (arguments.truth.format == TruthFormat::kKitti) identity["truth_format"] = "kitti";
  return identity;
}

/// Of several formats, each has a folder of its own, and in it each of several seeds.
std::filesystem::path folder_of(const std::filesystem::path& out, const RenderArguments& arguments,
                                const DatasetFormat& format, std::uint64_t seed) {
  const std::filesystem::path folder = folder_of(out, format, arguments.formats);
  return arguments.scenario.run.seeds.size() > 1 ? folder / fmt::format("seed_{}", seed) : folder;
}

/// One task a seed.
std::vector<RenderTask> render_tasks(const RenderArguments& arguments, const Experiment& experiment,
                                     const std::filesystem::path& out) {
  const FrameChoice frames = frames_of_drive(arguments.frames, experiment.scenario.path.size());
  std::vector<std::uint64_t> seeds = arguments.scenario.run.seeds;
  if (seeds.empty()) seeds = {experiment.seeds.front()};
  const nlohmann::ordered_json identity = identity_of(arguments, experiment, frames);
  std::vector<RenderTask> tasks;
  for (const std::uint64_t seed : seeds) {
    tasks.push_back({.experiment = &experiment,
                     .seed = seed,
                     .frames = frames,
                     .truth = arguments.truth,
                     .backend = arguments.scenario.backend,
                     .datasets = {}});
    for (const DatasetFormat* format : arguments.formats)
      tasks.back().datasets.push_back({format, folder_of(out, arguments, *format, seed),
                                       identity_of(identity, arguments, *format, seed)});
  }
  return tasks;
}

/// Refuses what a format cannot hold, and truth that none of them has a place for.
void check_formats(const RenderArguments& arguments, const Experiment& experiment) {
  const worlds::Scenario& scenario = experiment.scenario;
  const DatasetDrive drive = drive_of(scenario, scenario.world, 0, arguments.frames, arguments.truth);
  for (const DatasetFormat* format : arguments.formats) format->check(drive);
  const bool has_plain =
      std::ranges::any_of(arguments.formats, [](const DatasetFormat* format) { return is_plain(*format); });
  if (!has_plain && !arguments.truth.kinds.empty())
    throw std::runtime_error(
        fmt::format("--truth: {} has a place for what is its own alone; add the format {}",
                    arguments.formats.front()->name, dataset_formats().front().name));
}

int render(const RenderArguments& arguments) {
  const Experiment experiment = read_experiment(arguments.scenario);
  const worlds::Scenario& scenario = experiment.scenario;
  const RunArguments& run = arguments.scenario.run;
  if (scenario.sensor != worlds::SensorKind::kStereo)
    throw std::runtime_error(fmt::format(
        "{}: its sensor is the oracle, which has no pictures to render; set sensor.kind to stereo",
        arguments.scenario.scenario.string()));
  check_formats(arguments, experiment);
  const std::filesystem::path out = output_folder(run, scenario.name + "_dataset");
  const std::vector<RenderTask> tasks = render_tasks(arguments, experiment, out);
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
  const std::vector<RenderedSeed> rendered = render_seeds(tasks, run.jobs, "render " + scenario.name);
  CoarseBlur blur;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (std::size_t k = 0; k < tasks[i].datasets.size(); ++k) {
      const WantedDataset& wanted = tasks[i].datasets[k];
      say_what_was_written(scenario.name, *wanted.format, wanted.folder, rendered[i].datasets[k]);
    }
    blur += rendered[i].blur;
  }
  warn_of_blur(scenario.shutter, blur);
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
      "The format plain has left/ right/ (PNG), left_id/ right_id/ (PNG), left_depth/\n"
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
