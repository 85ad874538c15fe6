#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/standard_streams.h"
#include "harness/commands/talk.h"
#include "harness/dataset/atomic_file.h"
#include "harness/dataset/draws_file.h"
#include "harness/dataset/rendered_dataset.h"
#include "harness/dataset/rendered_truth.h"
#include "harness/dataset/truth_limits.h"
#include "harness/run/interruption.h"
#include "harness/run/process_pool.h"
#include "harness/run/progress.h"
#include "harness/run/recording.h"
#include "renderer/backend.h"
#include "renderer/mesh_shelf.h"
#include "worlds/scenario.h"

namespace stereobench::harness {
namespace {

struct RenderArguments {
  std::filesystem::path scenario;
  std::vector<std::string> overrides;
  std::uint64_t seed = 0;
  renderer::Backend backend = renderer::Backend::kOsmesa;
  TruthRequest truth;
  std::filesystem::path out;
};

/// Says which rendering a folder holds, so that an interrupted one is not taken up by another: the scenario's
/// own text, what was changed of it, the seed, what renders, what truth was asked for, and the program's
/// version.
nlohmann::ordered_json identity_of(const RenderArguments& arguments) {
  std::ostringstream text;
  text << std::ifstream(arguments.scenario, std::ios::binary).rdbuf();
  nlohmann::ordered_json identity = {{"schema", 1},
                                     {"stereobench", STEREOBENCH_VERSION},
                                     {"seed", arguments.seed},
                                     {"set", arguments.overrides},
                                     {"backend", renderer::name_of(arguments.backend)},
                                     {"scenario", text.str()}};
  for (const TruthKind kind : arguments.truth.kinds) identity["truth"].push_back(name_of(kind));
  if (arguments.truth.format == TruthFormat::kKitti) identity["truth_format"] = "kitti";
  return identity;
}

int render(const RenderArguments& arguments) {
  renderer::MeshShelf meshes;
  const worlds::Scenario scenario =
      worlds::read_scenario(arguments.scenario, arguments.overrides, meshes.solids());
  if (scenario.sensor != worlds::SensorKind::kStereo)
    throw std::runtime_error(fmt::format(
        "{}: its sensor is the oracle, which has no pictures to render; set sensor.kind to stereo",
        arguments.scenario.string()));
  require_truth(arguments.truth, scenario);
  const std::filesystem::path out =
      arguments.out.empty() ? std::filesystem::path("out") / (scenario.name + "_dataset") : arguments.out;
  warn_of_crossings(worlds::crossings(scenario.path, worlds::feet_of(scenario.world.walls)));
  const worlds::World world = worlds::world_for_seed(scenario, arguments.seed);
  const RenderedDataset dataset(out, identity_of(arguments));
  if (!dataset.spoilt().empty())
    note(
        fmt::format("{}: {} files were missing or not as they had been written (the first: {}); they are "
                    "rendered again",
                    out.string(), dataset.spoilt().size(), dataset.spoilt().front()));
  say_that_work_is_kept();
  std::optional<RenderedTruth> truth;
  if (!arguments.truth.kinds.empty()) truth.emplace(out, arguments.truth, scenario, world, arguments.backend);
  Progress progress("render " + scenario.name, 1.0);
  long pairs = 0;
  const Recording recording = record(scenario, arguments.seed,
                                     {.on_look =
                                          [&](const Look& look) {
                                            dataset.write(look);
                                            if (truth) truth->write(look);
                                            ++pairs;
                                          },
                                      .on_progress = [&](double done) { progress.show(done); }},
                                     arguments.backend);
  if (truth) truth->finish();
  const std::string draws = draws_jsonl(scenario, std::array{arguments.seed});
  if (!draws.empty()) write_file_atomically(out / "draws.jsonl", draws);
  dataset.finish(world, scenario.rig, scenario.believed_rig, recording.log);
  fmt::print("{}: {} stereo pairs with ids, depth, calibration and truth in {}\n", scenario.name, pairs,
             (out / "").string());
  return kPassed;
}

}  // namespace

void add_render_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("render", "write a scenario's stereo pairs with their truth as a folder");
  auto arguments = std::make_shared<RenderArguments>();
  command->add_option("scenario", arguments->scenario, "scenario file (YAML)")->required();
  add_set_option(*command, arguments->overrides);
  command->add_option("--seed", arguments->seed, "of the world and the noise")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_backend_option(*command, arguments->backend);
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
  command->add_option("--out,-o", arguments->out, "folder for the data set (default: out/<name>_dataset)");
  add_quiet_option(*command);
  command->footer(
      "Writes left/ right/ (PNG), left_id/ right_id/ (PNG), left_depth/ right_depth/ (PFM, planar Z in "
      "metres),\n"
      "calibration.yaml (as believed), true_calibration.yaml, balls.csv and the log that `stereobench slam` "
      "reads. Interrupted, it goes on where "
      "it was.\n"
      "--truth adds folders of the same names for each eye (left_flow/...), those of disparity, match and "
      "flow "
      "with\n"
      "what becomes of each pixel there: 0 nothing, 85 out of the other picture, 170 hidden in it, 255 "
      "seen.\n\n"
      "Example: stereobench render assets/scenarios/ball_circle.yaml --set path.laps=1 --out out/dataset");
  command->callback([arguments, &action] { action = [arguments] { return render(*arguments); }; });
}

}  // namespace stereobench::harness
