#include <algorithm>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/experiment/key_kind.h"
#include "harness/io/atomic_file.h"
#include "harness/result_pages/run_page.h"
#include "harness/run/run_output.h"
#include "harness/sensitivity/sensitivity_page.h"
#include "harness/sensitivity/sensitivity_picture.h"
#include "harness/sensitivity/sensitivity_report.h"
#include "harness/study_commands/study_metric.h"
#include "harness/study_commands/study_runs.h"

namespace stereobench::harness {
namespace {

struct SensitivityArguments {
  ScenarioArguments scenario;
  std::vector<std::string> ranges;
  bool by_stream = false;
  std::string metric;
  StudySettings settings;
};

/// The streams of a drive, in the order of StreamSeeds.
const std::vector<std::string> kStreams = {"world", "odometry", "sensor", "filter"};

Factors factors_of(const SensitivityArguments& arguments) {
  Factors factors;
  for (const std::string& text : arguments.ranges) {
    KeyRange& range = factors.keys.emplace_back(parse_key_range(text));
    if (!takes_whole_numbers(range.key)) continue;
    if (range.spacing == Spacing::kLogarithmic)
      throw std::runtime_error(
          fmt::format("--vary {}: whole numbers are spaced evenly; leave :log out", range.key));
    range.spacing = Spacing::kWhole;
  }
  factors.streams = arguments.by_stream ? kStreams : std::vector<std::string>{"seed"};
  check(factors);
  return factors;
}

StudyCell cell_at(const Factors& factors, const StudyPoint& point) {
  StudyCell cell;
  for (std::size_t i = 0; i < factors.keys.size(); ++i)
    cell.lines.push_back(fmt::format("{}={}", factors.keys[i].key, point.values[i]));
  cell.lines.push_back("gates=[]");
  StreamSeeds seeds(point.seeds.front());
  if (point.seeds.size() == kStreams.size()) {
    seeds.odometry = point.seeds[1];
    seeds.sensor = point.seeds[2];
    seeds.filter = point.seeds[3];
  }
  cell.seeds = {seeds};
  return cell;
}

std::vector<StudyCell> cells_of(const Factors& factors, const std::vector<StudyPoint>& points) {
  std::vector<StudyCell> cells;
  for (const StudyPoint& point : points) cells.push_back(cell_at(factors, point));
  return cells;
}

void write_sensitivity(const std::filesystem::path& out, const Sensitivity& study,
                       const ScenarioArguments& base, const Provenance& made_from) {
  write_file_atomically(out / "sensitivity.png", draw_sensitivity_picture(study));
  write_file_atomically(out / kReport, page_html(sensitivity_page(study, base.run.words)));
  write_file_atomically(out / kResolvedScenario, made_from.scenario);
  nlohmann::ordered_json json = sensitivity_json(study);
  json["made_from"] = provenance_json(made_from);
  write_file_atomically(out / "sensitivity.json", json.dump(2) + "\n");
}

/// @throws std::runtime_error where a scenario cannot be read at an end of a range
void check_ends(const Factors& factors, const ScenarioArguments& base) {
  for (const KeyRange& range : factors.keys)
    for (const double end : {range.low, range.high})
      read_experiment(base, {fmt::format("{}={}", range.key, end)});
}

int find_sensitivity(SensitivityArguments arguments) {
  ScenarioArguments& base = arguments.scenario;
  refuse_gates(base);
  const Factors factors = factors_of(arguments);
  check(arguments.settings);
  const std::string metric = choose_metric(arguments.metric, base);
  check_ends(factors, base);
  const Experiment experiment = read_experiment(base);
  const std::string& name = experiment.scenario.name;
  const std::filesystem::path out = output_folder(base.run, name + "_sensitivity");
  if (base.run.dry_run) {
    fmt::print("{}: would run {} drives for {} factors; results: {}\n", name,
               count_of_points(factors, arguments.settings.samples), factors.size(), (out / "").string());
    return kPassed;
  }
  const std::string what = "sensitivity " + name;
  const auto points = pick_freeze_points(factors, arguments.settings.samples, arguments.settings.seed);
  if (const auto end = do_study_shard(base, cells_of(factors, points), out, what)) return *end;
  prepare_output_folder(out);
  StudyRuns runs(base, out, what);
  Sensitivity study =
      study_sensitivity(factors, arguments.settings, [&](const std::vector<StudyPoint>& asked) {
        std::vector<double> values;
        for (const SeedMetrics& metrics : runs.metrics(cells_of(factors, asked)))
          values.push_back(values_of_metric(metrics, metric, 1).front());
        return values;
      });
  study.scenario = name;
  study.metric = metric;
  write_sensitivity(out, study, base, provenance_of(base, {}, experiment, runs.pixels()));
  runs.discard();
  fmt::print("{}: {}, {} drives\n\n{}\n", name, metric, runs.drives(), sensitivity_text(study));
  fmt::print("results: {}\n", (out / "").string());
  return kPassed;
}

void add_question(CLI::App& command, SensitivityArguments& arguments) {
  repeatable(
      command.add_option("--vary", arguments.ranges,
                         "a line of the scenario and between which values it lies, e.g. --vary "
                         "oracle.range_sd_m=0.05..0.5; :log behind it for even logarithms; may be repeated"))
      ->type_name("KEY=LOW..HIGH");
  command.add_flag(
      "--by-stream", arguments.by_stream,
      "take apart what is chance: world, odometry, sensor, filter, in place of the seed as a whole");
  command.add_option("--metric", arguments.metric, "a number of run.json, e.g. filters.smoother.ate_rms_m")
      ->required();
  command
      .add_option("--samples", arguments.settings.samples,
                  "rows: each is a drive for every factor and two more; best a power of two")
      ->capture_default_str();
  command.add_option("--interval", arguments.settings.level, "confidence of the intervals")
      ->capture_default_str();
}

}  // namespace

void add_sensitivity_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand(
      "sensitivity", "say which lines of a scenario matter most to a metric, over ranges of all of them");
  auto arguments = std::make_shared<SensitivityArguments>();
  add_scenario_options(*command, arguments->scenario);
  add_question(*command, *arguments);
  add_shard_options(*command, arguments->scenario.run.shards);
  command->footer(
      "Sobol indices by pick-freeze: the first index is the share of the metric's variance that goes when "
      "the\n"
      "factor is known, the total index that which stays when all others are known. What is chance is a "
      "factor\n"
      "of its own, the seed. The first of --seeds chooses the points. Writes sensitivity.json, "
      "sensitivity.png\n"
      "and report.html.\n\n"
      "Example: stereobench sensitivity assets/scenarios/open_field.yaml --vary oracle.range_sd_m=0.05..0.5 "
      "--vary odometry_noise.v_per_v=0.01..0.2 --metric filters.ekf.ate_rms_m");
  command->callback([arguments, command, &action] {
    if (arguments->ranges.empty() && !arguments->by_stream) throw CLI::RequiredError("--vary or --by-stream");
    arguments->scenario.run.words = words_of(*command);
    arguments->scenario.run.shards.words = whole_words_of(*command);
    if (!arguments->scenario.run.seeds.empty())
      arguments->settings.seed = arguments->scenario.run.seeds.front();
    action = [arguments] { return find_sensitivity(*arguments); };
  });
}

}  // namespace stereobench::harness
