#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/dataset/rendered_dataset.h"
#include "harness/run/process_pool.h"
#include "harness/run/progress.h"
#include "harness/run/recording.h"
#include "renderer/backend.h"
#include "worlds/scenario.h"

namespace stereobench::harness {
namespace {

struct RenderArguments {
  std::filesystem::path scenario;
  std::vector<std::string> overrides;
  std::uint64_t seed = 0;
  renderer::Backend backend = renderer::Backend::kOsmesa;
  std::filesystem::path out;
};

/// Says which rendering a folder holds, so that an interrupted one is not taken up by another: the scenario's
/// own text, what was changed of it, the seed, what renders and the program's version.
std::string identity_of(const RenderArguments& arguments) {
  std::ostringstream text;
  text << std::ifstream(arguments.scenario, std::ios::binary).rdbuf();
  const nlohmann::ordered_json identity = {{"schema", 1},
                                           {"stereobench", STEREOBENCH_VERSION},
                                           {"seed", arguments.seed},
                                           {"set", arguments.overrides},
                                           {"backend", renderer::name_of(arguments.backend)},
                                           {"scenario", text.str()}};
  return identity.dump(2) + "\n";
}

int render(const RenderArguments& arguments) {
  const worlds::Scenario scenario = worlds::read_scenario(arguments.scenario, arguments.overrides);
  if (scenario.sensor != worlds::SensorKind::kStereo)
    throw std::runtime_error(fmt::format(
        "{}: its sensor is the oracle, which has no pictures to render; set sensor.kind to stereo",
        arguments.scenario.string()));
  const std::filesystem::path out =
      arguments.out.empty() ? std::filesystem::path("out") / (scenario.name + "_dataset") : arguments.out;
  const RenderedDataset dataset(out, identity_of(arguments));
  Progress progress("render " + scenario.name, 1.0);
  long pairs = 0;
  const Recording recording = record(scenario, arguments.seed,
                                     {.on_look =
                                          [&](const Look& look) {
                                            dataset.write(look);
                                            ++pairs;
                                          },
                                      .on_progress = [&](double done) { progress.show(done); }},
                                     arguments.backend);
  dataset.finish(worlds::world_for_seed(scenario, arguments.seed), scenario.rig, scenario.believed_rig,
                 recording.log);
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
  command->add_option("--out,-o", arguments->out, "folder for the data set (default: out/<name>_dataset)");
  command->footer(
      "Writes left/ right/ (PNG), left_id/ right_id/ (PNG), left_depth/ right_depth/ (PFM, planar Z in "
      "metres),\n"
      "calibration.yaml (as believed), true_calibration.yaml, balls.csv and the log that `stereobench slam` "
      "reads. Interrupted, it goes on where "
      "it was.\n\n"
      "Example: stereobench render assets/scenarios/ball_circle.yaml --set path.laps=1 --out out/dataset");
  command->callback([arguments, &action] { action = [arguments] { return render(*arguments); }; });
}

}  // namespace stereobench::harness
