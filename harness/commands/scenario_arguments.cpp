#include "harness/commands/scenario_arguments.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/experiment/experiment.h"
#include "harness/run/run_result.h"
#include "renderer/backend.h"

namespace stereobench::harness {

void add_scenario_options(CLI::App& command, ScenarioArguments& arguments) {
  add_camera_options(command, arguments);
  add_run_options(command, arguments.run);
}

void add_camera_options(CLI::App& command, ScenarioArguments& arguments) {
  command.add_option("scenario", arguments.scenario, "scenario file (YAML)")->required();
  add_set_option(command, arguments.overrides);
  add_backend_option(command, arguments.backend);
  command
      .add_option(
          "--detector", arguments.detector,
          "what finds the balls: a detector that is linked in, by its name (ours is 'stereobench'), or a "
          "program, e.g. 'python3 my_detector.py', that is shown frames and answers in lines of JSON "
          "(docs/guide/detectors.md)")
      ->type_name("NAME|COMMAND");
  command
      .add_option("--detector-timeout-s", arguments.detector_timeout_s,
                  "how long it may think about a frame (default: 30, or as the scenario says)")
      ->check(real_between(1e-3, 1e6));
  command
      .add_option(
          "--detector-start-s", arguments.detector_start_s,
          "how much longer it may take for its first answer, since it has to start (default: 90, or as "
          "the scenario says)")
      ->check(real_between(0.0, 1e6));
}

Experiment read_experiment(const ScenarioArguments& arguments,
                           const std::vector<std::string>& more_overrides) {
  std::vector<std::string> overrides = arguments.overrides;
  overrides.insert(overrides.end(), more_overrides.begin(), more_overrides.end());
  Experiment experiment = read_experiment(arguments.scenario, overrides, arguments.meshes->occluders());
  const RunArguments& run = arguments.run;
  std::vector<std::string>& filters = experiment.filters;
  if (!run.filters.empty()) filters = run.filters;
  if (std::find(filters.begin(), filters.end(), kBaselineFilter) == filters.end())
    filters.insert(filters.begin(), kBaselineFilter);
  if (run.particles > 0) experiment.particles = run.particles;
  if (!run.seeds.empty()) experiment.seeds = run.seeds;
  experiment.gates.insert(experiment.gates.end(), run.gates.begin(), run.gates.end());
  if (arguments.detector_timeout_s > 0.0) experiment.detector.timeout_s = arguments.detector_timeout_s;
  if (arguments.detector_start_s) experiment.detector.start_s = *arguments.detector_start_s;
  if (arguments.detector.empty()) return experiment;
  if (experiment.scenario.sensor != worlds::SensorKind::kStereo)
    throw std::runtime_error(fmt::format("--detector: the sensor of {} is the oracle, which has no pictures",
                                         arguments.scenario.string()));
  experiment.detector.command = arguments.detector;
  return experiment;
}

std::string work_of(const Experiment& experiment) {
  const std::vector<std::uint64_t>& seeds = experiment.seeds;
  return fmt::format("seed{} {} of {} steps{} with {} ({} particles)", seeds.size() == 1 ? "" : "s",
                     fmt::join(seeds, ", "), experiment.scenario.path.size(),
                     seeds.size() == 1 ? "" : " each", fmt::join(experiment.filters, ", "),
                     experiment.particles);
}

void warn_of_crossings(std::span<const worlds::Crossing> crossings) {
  if (crossings.empty()) return;
  const worlds::Crossing& first = crossings.front();
  fmt::print(
      stderr,
      "stereobench: warning: the drive goes through a wall or a mesh at step {}, at ({:.2f}, {:.2f}) m{}\n",
      first.step, first.at_m.x(), first.at_m.y(),
      crossings.size() == 1 ? "" : fmt::format(", and {} times more", crossings.size() - 1));
}

void warn_of_blur(const worlds::Shutter& shutter, const CoarseBlur& blur) {
  if (blur.pairs == 0) return;
  const int most = std::max(shutter.samples, shutter.most_samples);
  fmt::print(
      stderr,
      "stereobench: warning: the blur of {} pair{} is drawn in steps of more than a pixel, up to {:.1f} "
      "px: shutter.most_samples is {}, and {:.0f} would do\n",
      blur.pairs, blur.pairs == 1 ? "" : "s", blur.most_step_px, most, std::ceil(blur.most_step_px * most));
}

void warn_of_missing_textures(const worlds::Scenario& scenario, renderer::MeshCache& meshes) {
  if (scenario.sensor != worlds::SensorKind::kStereo ||
      scenario.world.texture_search.missing != worlds::MissingTexturePolicy::kGrey)
    return;
  for (const std::string& line : meshes.missing_textures(scenario.world))
    fmt::print(stderr, "stereobench: warning: drawn in grey: {}\n", line);
}

std::string rendered_by(const worlds::Scenario& scenario, renderer::Backend backend) {
  return scenario.sensor == worlds::SensorKind::kStereo ? renderer::name_of(backend) : kNoBackend;
}

}  // namespace stereobench::harness
