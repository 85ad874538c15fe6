#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/evaluation_command.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/io/file_list.h"
#include "harness/logs/measurement_log_reader.h"
#include "harness/logs/sighting_weights.h"
#include "harness/process/process_pool.h"
#include "harness/process/progress.h"
#include "harness/process/stopwatch.h"
#include "harness/regression/gates.h"
#include "harness/result_pages/run_page.h"
#include "harness/run/detections_file.h"
#include "harness/run/result_table.h"
#include "harness/run/run_output.h"
#include "harness/run/seed_result.h"
#include "harness/scoring/references.h"
#include "slam/filter_registry.h"

namespace stereobench::harness {
namespace {

struct SlamArguments {
  std::filesystem::path log;
  RunArguments run;
  LogAssumptions log_says;
  std::filesystem::path detections;  ///< empty: the log's own sightings
  std::optional<worlds::Identity> identity;
  slam::FilterConfig config;
  StatedNoise stated;
  bool sector_is_stated = false;
  std::optional<Eigen::Vector2d> sighting_correlation_s;
  EvaluationArguments evaluation;
};

/// What is assumed of a log's odometry unless the command line says otherwise: the errors of a small robot's
/// wheels over a second, driving straight and turning, as measured on UTIAS MRCLAM set 7 (docs/results.md).
constexpr slam::OdometryNoise kUsualOdometry = {.v_constant_mps = 0.003,
                                                .v_per_v = 0.03,
                                                .v_per_w = 0.06,
                                                .w_constant_radps = 0.012,
                                                .w_per_w = 0.1,
                                                .correlation_s = 1.0};

constexpr std::array kOdometryOptions = {"--v-constant-mps",   "--v-per-v", "--v-per-w",
                                         "--w-constant-radps", "--w-per-v", "--w-per-w",
                                         "--correlation-s"};

/// The name of the results: the log's folder, e.g. "robot2".
std::string name_of(const std::filesystem::path& log) {
  const std::filesystem::path absolute = std::filesystem::absolute(log).lexically_normal();
  return absolute.has_filename() ? absolute.stem().string() : absolute.parent_path().filename().string();
}

/// Replays the log with each filter, once a seed, in several processes, which score what they replayed.
/// @param detections that took the place of the log's sightings; they are the first seed's
void replay_seeds(const MeasurementLog& log, const std::optional<ScoredDetections>& detections,
                  const SlamArguments& arguments, RunOutput& output) {
  const RunArguments& run = arguments.run;
  Timing timing;
  References references;  // the batch draws nothing, so that one serves all seeds
  references.batch =
      Stopwatch(timing).time("reference.batch", [&] { return replay_batch(log, arguments.config); });
  const auto replay_seed = [&](std::size_t index, const std::function<void(double)>& report) {
    SeedDrive drive{.seed = run.seeds[index], .recording = {.log = log}, .references = references};
    if (index == 0) drive.recording.timing = timing;
    if (index == 0 && detections) {
      drive.recording.vision = detections->score;
      drive.detections = detections->rows;
    }
    drive.runs = replay_filters(log, run.filters, arguments.config, run.seeds[index], drive.recording.timing);
    report(1.0);
    return to_bytes(score_seed(drive, {.steps = true, .map = index == 0, .detections = true}));
  };
  Progress progress("slam", static_cast<double>(run.seeds.size()));
  const auto keep = [&](std::size_t, const std::string& answer) {
    output.add(seed_result_from_bytes(answer));
  };
  run_in_order(run.seeds.size(), run.jobs, replay_seed, keep, [&](double done) { progress.show(done); });
}

/// Has all the keys that the result will have.
RunResult result_without_runs(const SlamArguments& arguments) {
  RunResult nothing_yet;
  nothing_yet.recorded.emplace();
  if (!arguments.detections.empty() && !is_imported(arguments.log)) nothing_yet.vision = VisionScore{};
  for (const std::string& filter : arguments.run.filters) nothing_yet.filters.push_back({.filter = filter});
  return nothing_yet;
}

void print_summary(const RunResult& result, std::size_t seeds, const RecordedLog& recorded) {
  const LogFacts& facts = recorded.facts;
  fmt::print("{}: {} seed{}, {} steps", result.name, seeds, seeds == 1 ? "" : "s", recorded.log.steps.size());
  if (facts.robot_sightings > 0) fmt::print(", {} sightings of other robots left out", facts.robot_sightings);
  if (facts.odometry_delay_s != 0.0)
    fmt::print(", the motion follows the odometry by {:.2f} s", facts.odometry_delay_s);
  fmt::print("\n");
  for (const std::string& line : result.assumed) fmt::print("assumed: {}\n", line);
}

/// Puts detections of a file in place of the log's sightings, where there is one.
/// @return their score, where the world is known
std::optional<ScoredDetections> replace_by_detections(const SlamArguments& arguments, MeasurementLog& log) {
  if (arguments.detections.empty()) return std::nullopt;
  if (!is_imported(arguments.log))
    return replace_sightings(log, arguments.log, arguments.detections, arguments.identity,
                             arguments.run.seeds.front());
  take_sightings(log, arguments.log, arguments.detections, arguments.identity);
  return std::nullopt;
}

int run_slam(SlamArguments arguments) {
  RunArguments& run = arguments.run;
  if (run.filters.empty()) run.filters = slam::usual_filter_names();
  if (run.seeds.empty()) run.seeds = {0};
  if (run.particles > 0) arguments.config.particles = run.particles;
  check_metrics(run.gates, run_json(result_without_runs(arguments)));
  require_as_rendered(arguments.log);
  RecordedLog recorded = read_log(arguments.log, arguments.log_says);
  const std::optional<ScoredDetections> detections = replace_by_detections(arguments, recorded.log);
  const std::string name = name_of(arguments.log);
  const std::filesystem::path out = output_folder(run, name);
  if (run.dry_run) {
    fmt::print("{}: would replay {} steps with {} filters for {} seeds; results: {}\n", name,
               recorded.log.steps.size(), run.filters.size(), run.seeds.size(), (out / "").string());
    return kPassed;
  }
  if (arguments.sector_is_stated)
    recorded.facts.sector.sector = arguments.config.sector;
  else
    find_sensor_sector(recorded, arguments.config);
  weigh_sightings(recorded, arguments.config, arguments.sighting_correlation_s);
  prepare_output_folder(out);
  remove_leftovers_in(out);
  RunOutput output(out, RunTally(name, kNoBackend, Seeds::kFilters));
  replay_seeds(recorded.log, detections, arguments, output);
  RunResult result = output.result();
  if (!arguments.detections.empty()) result.detector = "file";
  result.recorded = recorded.facts;
  // Factors on the noise would be those of errors that are each their own.
  if (recorded.facts.lasting_errors.time_s.isZero())
    result.noise = check_noise({sensor_log(recorded.log)}, arguments.config, run.jobs);
  result.assumed = assumptions_of(recorded.facts, arguments.stated);
  output.write(result, {}, [&](const RunResult& done, const RunCurves& curves) {
    write_run_report(out, done, curves, {.commands = {run.words, {}}, .gates = run.gates});
  });
  print_summary(result, run.seeds.size(), recorded);
  const auto broken = broken_gates(run_json(result), run.gates);
  say("\n" + result_table(result) + "\n");
  say_gates(gate_report(broken, run.gates.size()), !broken.empty());
  fmt::print("results: {}\n", (out / "").string());
  return broken.empty() ? kPassed : kGateBroken;
}

void add_noise_options(CLI::App& command, SlamArguments& arguments) {
  slam::OdometryNoise& noise = arguments.config.odometry_noise;
  const auto add = [&](const char* name, double& value, double least, const char* text) {
    command.add_option(name, value, text)
        ->check(real_between(least, 1e6))
        ->capture_default_str()
        ->group("Noise (standard deviations)");
  };
  add("--range-sd-m", arguments.log_says.noise.range_sd_m, 1e-9, "of a range, for logs without covariances");
  add("--bearing-sd-rad", arguments.log_says.noise.bearing_sd_rad, 1e-9,
      "of a bearing, for logs without covariances");
  command
      .add_option_function<std::vector<double>>(
          "--noise-law",
          [&config = arguments.config](const std::vector<double>& sd) {
            config.noise_law = {.range_sd_m = sd[0], .range_sd_per_m2 = sd[1], .bearing_sd_rad = sd[2]};
          },
          "of all sightings, whatever the log states: of a range (m), per square of it (1/m), of a bearing "
          "(rad)")
      ->expected(3)
      ->delimiter(',')
      ->check(real_between(0.0, 1e6))
      ->type_name("A,B,C")
      ->group("Noise (standard deviations)");
  add("--v-constant-mps", noise.v_constant_mps, 0.0, "of the forward speed, constant part");
  add("--v-per-v", noise.v_per_v, 0.0, "of the forward speed, per m/s");
  add("--v-per-w", noise.v_per_w, 0.0, "of the forward speed, per rad/s");
  add("--w-constant-radps", noise.w_constant_radps, 0.0, "of the turn rate, constant part");
  add("--w-per-v", noise.w_per_v, 0.0, "of the turn rate, per m/s");
  add("--w-per-w", noise.w_per_w, 0.0, "of the turn rate, per rad/s");
  command
      .add_option(
          "--odometry-delay-s", arguments.log_says.odometry_delay_s,
          "by how much the motion follows the odometry's stamps (default: estimated from how bearings "
          "change; 0 = trust the stamps)")
      ->check(real_between(-60.0, 60.0))
      ->group("Noise (standard deviations)");
  command
      .add_option_function<std::vector<double>>(
          "--sighting-correlation-s",
          [&stated = arguments.sighting_correlation_s](const std::vector<double>& time_s) {
            stated = Eigen::Vector2d(time_s[0], time_s[1]);
          },
          "how long errors of ranges and of bearings last from one sighting of a landmark to the next "
          "(default: "
          "estimated from innovations; 0,0 = each error is its own)")
      ->expected(2)
      ->delimiter(',')
      ->check(real_between(0.0, 1e6))
      ->type_name("RANGE,BEARING")
      ->group("Noise (standard deviations)");
  add("--correlation-s", noise.correlation_s, 0.0,
      "how long an odometry error lasts (slip outlives fast readings)");
}

void add_sector_option(CLI::App& command, SlamArguments& arguments) {
  command
      .add_option_function<std::vector<double>>(
          "--sector",
          [&arguments](const std::vector<double>& values) {
            if ((values[0] > 0.0) != (values[1] > 0.0) || values[2] > 1.0)
              throw CLI::ValidationError(
                  "--sector",
                  "expected both a range and an angle, or neither, and a probability of at most 1");
            arguments.config.sector = {values[0], values[1], values[2], values[3]};
            arguments.sector_is_stated = true;
          },
          "of the sensor, for sightings without identities: how far it sees (m), how far to each side (rad), "
          "the probability that it misses a landmark, and how many things a look shows that are none "
          "(default: found in the log; 0,0,0,0 = nothing is known)")
      ->expected(4)
      ->delimiter(',')
      ->check(real_between(0.0, 1e6))
      ->type_name("RANGE,ANGLE,MISSED,FALSE")
      ->group("Noise (standard deviations)");
}

void add_detection_options(CLI::App& command, SlamArguments& arguments) {
  const std::map<std::string, worlds::Identity> names = {{"known", worlds::Identity::kKnown},
                                                         {"colour_class", worlds::Identity::kColourClass},
                                                         {"none", worlds::Identity::kNone}};
  CLI::Option* file = command.add_option(
      "--detections", arguments.detections,
      "lines of JSON with what a detector found in the pictures of a data set of `render` or `import`: they "
      "take the place of the log's sightings, and are scored where `render` says what there is to see");
  command
      .add_option_function<worlds::Identity>(
          "--identity", [&arguments](const worlds::Identity& identity) { arguments.identity = identity; },
          "how filters tell these landmarks apart (default: known if no two balls of `render` share a "
          "colour, "
          "else colour_class)")
      ->transform(CLI::CheckedTransformer(names).description("known, colour_class or none"))
      ->type_name("")
      ->needs(file);
}

}  // namespace

void add_slam_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("slam", "run the filters on a recorded log, score them against its truth");
  auto arguments = std::make_shared<SlamArguments>();
  arguments->config.odometry_noise = kUsualOdometry;
  command->add_option("log", arguments->log,
                      "folder of a measurement log (odometry.csv, observations.csv, ...) or of UTIAS MRCLAM "
                      ".dat files; plain or .gz");
  add_run_options(*command, arguments->run);
  add_detection_options(*command, *arguments);
  add_noise_options(*command, *arguments);
  add_sector_option(*command, *arguments);
  add_evaluation_options(*command, arguments->evaluation);
  command->footer(
      "Examples: stereobench slam DIR --filters ufastslam --particles 50 --seeds 0..4\n"
      "          stereobench slam --evaluate estimate.txt --truth groundtruth.txt --align sim3 --delta 1s");
  command->callback([arguments, command, &action] {
    const auto said = [&](const char* option) { return command->count(option) > 0; };
    if (said("--evaluate")) {
      check_evaluation_options(*command);
      arguments->evaluation.words = words_of(*command);
      action = [arguments] {
        return run_evaluation(arguments->evaluation, arguments->run.out, arguments->run.gates,
                              arguments->run.dry_run);
      };
      return;
    }
    if (!said("log")) throw CLI::RequiredError("log");
    arguments->run.words = words_of(*command);
    arguments->stated.sensor = said("--noise-law") || (said("--range-sd-m") && said("--bearing-sd-rad"));
    arguments->stated.odometry = std::ranges::any_of(kOdometryOptions, said);
    action = [arguments] { return run_slam(*arguments); };
  });
}

}  // namespace stereobench::harness
