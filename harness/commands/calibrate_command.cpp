#include <cmath>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/kept_drives.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/shard_run.h"
#include "harness/commands/talk.h"
#include "harness/detector_noise/calibration_result.h"
#include "harness/detector_noise/calibration_scenes.h"
#include "harness/detector_noise/serialise.h"
#include "harness/experiment/seeds.h"
#include "harness/io/atomic_file.h"
#include "harness/io/sha256.h"
#include "harness/process/interruption.h"
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

/// SHA-256 of all that the takes of the scenes are made from: that of a drive with the same seed, and how
/// calibration scenes differ from it.
std::vector<std::string> keys_of_takes(const CalibrateArguments& arguments, const CalibrationLook& look,
                                       const std::string& pixels) {
  std::vector<std::string> keys;
  const std::vector<StreamSeeds> seeds(look.seeds.begin(), look.seeds.end());
  const worlds::CalibrationSceneSettings& settings = look.settings;
  for (const DriveTask& drive : drive_tasks(arguments.scenario, {}, look.experiment, pixels, {}, seeds))
    keys.push_back(sha256_of(fmt::format("{} calibration {} {} {}", drive.key, settings.depths.nearest_m,
                                         settings.depths.farthest_m, settings.plain)));
  return keys;
}

/// With --shard, or for `merge`: what do_shard does with scenes of which each is a unit.
std::optional<int> do_calibration_shard(const std::filesystem::path& out, const RunArguments& run,
                                        const CalibrationLook& look, const std::vector<std::string>& keys,
                                        const std::string& pixels) {
  ShardedWork work = even_work("calibrate " + look.experiment.scenario.name, pixels, kDrivesFile, keys);
  work.work = [&](const std::vector<std::size_t>& units) {
    AnswerStore store(out / kDrivesFile);
    CalibrationLook own = look;
    own.seeds.clear();
    std::vector<std::string> own_keys;
    for (const std::size_t unit : units) {
      own.seeds.push_back(look.seeds[unit]);
      own_keys.push_back(keys[unit]);
    }
    take_into(store, own, own_keys, run.jobs);
    return DriveCosts{};
  };
  return do_shard(out, run, work);
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
  const worlds::CalibrationDepths depths = worlds::measurable_depths(
      scenario.rig, scenario.world.ball_radius_m(), vision::ObserverSettings{}.min_radius_px);
  const CalibrationLook look = {experiment, {depths, arguments.plain}, arguments.scenario.backend, seeds};
  const std::string pixels = pixels_of(scenario, arguments.scenario.backend);
  const std::vector<std::string> keys = keys_of_takes(arguments, look, pixels);
  const RunArguments& run = arguments.scenario.run;
  if (const auto end = do_calibration_shard(out, run, look, keys, pixels)) return *end;
  prepare_output_folder(out);
  AnswerStore kept(out / kDrivesFile);
  say_that_work_is_kept();
  take_into(kept, look, keys, run.jobs);
  std::vector<CalibrationTake> takes;
  for (const std::string& key : keys) takes.push_back(calibration_take_from_bytes(kept.read(key)));
  CalibrationResult result = calibrate(takes, seeds, depths.nearest_m, depths.farthest_m);
  result.scenario = scenario.name;
  result.detector = experiment.detector.command.empty() ? "stereobench" : experiment.detector.command;
  const NoiseKind kind = arguments.law == "stereo" ? NoiseKind::kStereo : NoiseKind::kScaled;
  write_file_atomically(out / "noise.yaml", noise_yaml(result, kind, scenario.believed_rig));
  write_file_atomically(out / kReport,
                        page_html(calibration_page(result, gates, arguments.scenario.run.words)));
  write_file_atomically(out / "calibration.json", calibration_json(result).dump(2) + "\n");
  kept.remove();
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
  add_shard_options(*command, scenario.run.shards);
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
      "and calibration.json, whose numbers --gate can limit. Interrupted, it goes on where it was.\n\n"
      "Example: stereobench calibrate assets/scenarios/ball_circle.yaml --set camera.noise_sd_levels=4");
  command->callback([arguments, command, &action] {
    arguments->scenario.run.words = words_of(*command);
    arguments->scenario.run.shards.words = whole_words_of(*command);
    action = [arguments] { return run_calibration(*arguments); };
  });
}

}  // namespace stereobench::harness
