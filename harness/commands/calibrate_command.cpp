#include <cmath>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/talk.h"
#include "harness/detector_noise/calibration_result.h"
#include "harness/detector_noise/calibration_scenes.h"
#include "harness/experiment/seeds.h"
#include "harness/io/atomic_file.h"
#include "harness/regression/gates.h"
#include "harness/result_pages/calibration_page.h"
#include "harness/result_pages/run_page.h"
#include "vision/observe.h"
#include "worlds/generate/calibration_scene.h"

namespace stereobench::harness {
namespace {

constexpr const char* kUsualSeeds = "0..39";

struct CalibrateArguments {
  ScenarioArguments scenario;
  std::string law = "per_observation";
  bool plain = false;
};

Experiment read_stereo_experiment(const CalibrateArguments& arguments) {
  Experiment experiment = read_experiment(arguments.scenario);
  if (experiment.scenario.sensor != worlds::SensorKind::kStereo)
    throw std::runtime_error(fmt::format("{}: sensor: expected stereo, since the oracle has no pictures",
                                         arguments.scenario.scenario.string()));
  return experiment;
}

int run_calibration(const CalibrateArguments& arguments) {
  const Experiment experiment = read_stereo_experiment(arguments);
  const worlds::Scenario& scenario = experiment.scenario;
  const std::vector<std::uint64_t>& seeds = arguments.scenario.run.seeds;
  if (seeds.size() < 2)
    throw std::runtime_error("--seeds: expected at least two, one of them to be held out");
  const std::vector<Gate>& gates = arguments.scenario.run.gates;
  check_metrics(gates, calibration_json({}));
  const std::filesystem::path out = output_folder(arguments.scenario.run, scenario.name + "_calibration");
  if (arguments.scenario.run.dry_run) {
    fmt::print("{}: would look at {} calibration scenes; results: {}\n", scenario.name, seeds.size(),
               (out / "").string());
    return kPassed;
  }
  prepare_output_folder(out);
  const worlds::CalibrationDepths depths = worlds::measurable_depths(
      scenario.rig, scenario.world.ball_radius_m(), vision::ObserverSettings{}.min_radius_px);
  const auto takes = take_calibration_scenes(experiment, {depths, arguments.plain}, seeds,
                                             arguments.scenario.backend, arguments.scenario.run.jobs);
  CalibrationResult result = calibrate(takes, seeds, depths.nearest_m, depths.farthest_m);
  result.scenario = scenario.name;
  result.detector = experiment.detector.command.empty() ? "stereobench" : experiment.detector.command;
  const NoiseKind kind = arguments.law == "stereo" ? NoiseKind::kStereo : NoiseKind::kScaled;
  write_file_atomically(out / "noise.yaml", noise_yaml(result, kind, scenario.believed_rig));
  write_file_atomically(out / kReport,
                        page_html(calibration_page(result, gates, arguments.scenario.run.words)));
  write_file_atomically(out / "calibration.json", calibration_json(result).dump(2) + "\n");
  const auto broken = broken_gates(calibration_json(result), gates);
  fmt::print(
      "{}: {} balls seen in the half held out, recall {:.4f}, {} misidentified, {} spurious, {} flagged\n\n"
      "{}\n",
      scenario.name, result.score.observations, result.score.recall(), result.score.misidentified,
      result.score.spurious, result.score.flagged, calibration_table(result));
  say_gates(gate_report(broken, gates.size()), !broken.empty());
  fmt::print("results: {}\n", (out / "").string());
  return broken.empty() ? kPassed : kGateBroken;
}

}  // namespace

void add_calibrate_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand(
      "calibrate", "measure a detector's noise on rendered balls, and write it for the filters");
  auto arguments = std::make_shared<CalibrateArguments>();
  ScenarioArguments& scenario = arguments->scenario;
  scenario.run.seeds = parse_seeds(kUsualSeeds);
  add_camera_options(*command, scenario);
  add_seed_options(*command, scenario.run);
  add_gate_option(*command, scenario.run.gates);
  command
      ->add_option("--law", arguments->law,
                   "what noise.yaml says: stated covariances to scale, or the stereo law")
      ->check(CLI::IsMember({"per_observation", "stereo"}))
      ->capture_default_str();
  command->add_flag("--plain", arguments->plain, "before walls and floors without texture");
  command->footer(
      "Takes the cameras of a scenario (rig, camera, detector, size of balls) through calibration scenes:\n"
      "balls of all colours at all depths, under any light, before any wall. The noise is fitted to the\n"
      "scenes of every other seed and held against the rest, by depth: errors beside the Cramer-Rao bound,\n"
      "and NIS/2, which is 1 where covariances are consistent. Writes noise.yaml, for a scenario's\n"
      "  believed_measurement_noise: {kind: file, file: noise.yaml}\n"
      "and calibration.json, whose numbers --gate can limit.\n\n"
      "Example: stereobench calibrate assets/scenarios/ball_circle.yaml --set camera.noise_sd_levels=4");
  command->callback([arguments, command, &action] {
    arguments->scenario.run.words = words_of(*command);
    action = [arguments] { return run_calibration(*arguments); };
  });
}

}  // namespace stereobench::harness
