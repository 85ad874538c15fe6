#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "harness/budget/budget_page.h"
#include "harness/budget/budget_picture.h"
#include "harness/budget/budget_report.h"
#include "harness/commands/commands.h"
#include "harness/commands/shard_run.h"
#include "harness/commands/talk.h"
#include "harness/experiment/key_kind.h"
#include "harness/io/atomic_file.h"
#include "harness/result_pages/run_page.h"
#include "harness/run/run_output.h"
#include "harness/study_commands/study_metric.h"
#include "harness/study_commands/study_runs.h"

namespace stereobench::harness {
namespace {

struct BudgetArguments {
  ScenarioArguments scenario;
  std::vector<std::string> ranges;
  std::string metric;
  std::optional<double> at_most;
  std::optional<double> at_least;
  WorldShare wanted;
  double tolerance = 0.02;
};

/// Each range for itself and, where there are several, all of them together.
std::vector<BudgetMix> mixes_of(const std::vector<std::string>& texts) {
  BudgetMix all;
  std::vector<BudgetMix> mixes;
  for (const std::string& text : texts) {
    const BudgetRange range = parse_budget_range(text);
    if (std::ranges::count(all, range.key, &BudgetRange::key) > 0)
      throw std::runtime_error(fmt::format("--vary: {} is varied twice", range.key));
    all.push_back(range);
    all.back().is_whole = takes_whole_numbers(all.back().key);
    mixes.push_back({all.back()});
  }
  if (all.size() > 1) mixes.push_back(all);
  return mixes;
}

Gate limit_of(const BudgetArguments& arguments) {
  const bool is_most = arguments.at_most.has_value();
  return {.metric = arguments.metric,
          .relation = is_most ? Gate::Relation::kAtMost : Gate::Relation::kAtLeast,
          .limit = is_most ? *arguments.at_most : *arguments.at_least};
}

/// The seeds of the command line, or as many as the question needs.
std::vector<std::uint64_t> seeds_of(const BudgetArguments& arguments) {
  std::vector<std::uint64_t> seeds = arguments.scenario.run.seeds;
  if (!seeds.empty()) return seeds;
  seeds.resize(static_cast<std::size_t>(fewest_worlds(arguments.wanted)));
  std::iota(seeds.begin(), seeds.end(), std::uint64_t{0});
  return seeds;
}

/// Lines of a mix at a level. Gates have no part in studies.
Lines lines_at(const BudgetMix& mix, double level) {
  Lines lines = overrides_at(mix, level);
  lines.push_back("gates=[]");
  return lines;
}

/// @param too_many see BudgetQuestion
BudgetAnswer answer_of(const BudgetMix& mix, const BudgetStudy& study, const ScenarioArguments& base,
                       StudyRuns& runs, std::optional<long> too_many = {}) {
  const std::vector<double> levels = budget_levels(mix, study.tolerance);
  runs.keep_sights(share_sight(base, lines_at(mix, levels.front()), lines_at(mix, levels.back())));
  const MetricAtLevel run = [&](double level, const std::vector<std::uint64_t>& seeds) {
    const auto metrics = runs.metrics({{lines_at(mix, level), {seeds.begin(), seeds.end()}}});
    return values_of_metric(metrics.front(), study.limit.metric, seeds.size());
  };
  return {mix, find_budget({levels, study.seeds, study.limit, study.wanted, too_many}, run)};
}

/// With --shard, or for `merge`: what do_shard does with seeds. A shard looks for the level at which too many
/// of its own seeds fail; the search over all seeds, which is left to `merge`, finds many of its runs done.
std::optional<int> do_budget_shard(const std::filesystem::path& out, const ScenarioArguments& base,
                                   const BudgetStudy& study, const std::vector<BudgetMix>& mixes) {
  if (!base.run.shards.is_used()) return {};
  const Experiment experiment = read_experiment(base);
  const std::string pixels = pixels_of(experiment.scenario, base.backend);
  std::vector<std::string> keys;
  for (const DriveTask& task : drive_tasks(base, {}, experiment, pixels, {})) keys.push_back(task.key);
  ShardedWork work = even_work("budget " + study.scenario, pixels, kDrivesFile, keys);
  work.work = [&](const std::vector<std::size_t>& units) {
    BudgetStudy own = study;
    own.seeds.clear();
    for (const std::size_t unit : units) own.seeds.push_back(study.seeds[unit]);
    if (own.seeds.empty()) return DriveCosts{};
    const long all = std::ssize(study.seeds), mine = std::ssize(own.seeds);
    const long too_many = (order_of_seeds(all, study.wanted) * mine + all - 1) / all;
    StudyRuns runs(base, out, work.what);
    for (const BudgetMix& mix : mixes) answer_of(mix, own, base, runs, too_many);
    return DriveCosts{};
  };
  return do_shard(out, base.run, work);
}

void write_budget(const std::filesystem::path& out, const BudgetStudy& study, const ScenarioArguments& base,
                  const Provenance& made_from) {
  write_file_atomically(out / "budget.png", draw_budget_picture(study));
  write_file_atomically(out / kReport, page_html(budget_page(study, base.run.words)));
  write_file_atomically(out / kResolvedScenario, made_from.scenario);
  nlohmann::ordered_json json = budget_json(study);
  json["made_from"] = provenance_json(made_from);
  write_file_atomically(out / "budget.json", json.dump(2) + "\n");
}

/// @throws std::runtime_error where a scenario cannot be read at an end of a range, or seeds are too few
void check_study(const std::vector<BudgetMix>& mixes, const BudgetStudy& study,
                 const ScenarioArguments& base) {
  order_of_seeds(static_cast<long>(study.seeds.size()), study.wanted);
  for (const BudgetMix& mix : mixes) {
    const std::vector<double> levels = budget_levels(mix, study.tolerance);
    for (const double level : {levels.front(), levels.back()}) read_experiment(base, lines_at(mix, level));
  }
}

int find_budgets(BudgetArguments arguments) {
  ScenarioArguments& base = arguments.scenario;
  refuse_gates(base);
  arguments.metric = choose_metric(arguments.metric, base);
  const std::vector<BudgetMix> mixes = mixes_of(arguments.ranges);
  base.run.seeds = seeds_of(arguments);
  const Experiment experiment = read_experiment(base);
  BudgetStudy study{.scenario = experiment.scenario.name,
                    .limit = limit_of(arguments),
                    .wanted = arguments.wanted,
                    .tolerance = arguments.tolerance,
                    .seeds = experiment.seeds,
                    .answers = {}};
  check_study(mixes, study, base);
  const std::filesystem::path out = output_folder(base.run, study.scenario + "_budget");
  if (base.run.dry_run) {
    for (const BudgetMix& mix : mixes)
      fmt::print("{}: would look for the budget of {} among {} levels, on {} seeds\n", study.scenario,
                 name_of(mix), budget_levels(mix, study.tolerance).size(), study.seeds.size());
    fmt::print("results: {}\n", (out / "").string());
    return kPassed;
  }
  if (const auto end = do_budget_shard(out, base, study, mixes)) return *end;
  prepare_output_folder(out);
  StudyRuns runs(base, out, "budget " + study.scenario);
  for (const BudgetMix& mix : mixes) study.answers.push_back(answer_of(mix, study, base, runs));
  write_budget(out, study, base, provenance_of(base, {}, experiment, runs.pixels()));
  runs.discard();
  for (const BudgetAnswer& answer : study.answers) fmt::print("{}\n", budget_sentence(study, answer));
  fmt::print("\n{}\n", budget_table(study));
  if (const std::string warnings = budget_warnings(study); !warnings.empty()) say(warnings);
  fmt::print("results: {}\n", (out / "").string());
  return kPassed;
}

void add_question(CLI::App& command, BudgetArguments& arguments) {
  repeatable(command.add_option("--vary", arguments.ranges,
                                "a line of the scenario, from its good to its bad end, e.g. --vary "
                                "detector_noise.centre_sd_px=0..2; may be repeated: each for itself, and all "
                                "by the same fraction of their ranges"))
      ->type_name("KEY=LOW..HIGH")
      ->required();
  command.add_option("--metric", arguments.metric, "a number of run.json, e.g. filters.smoother.ate_rms_m")
      ->required();
  CLI::Option* most =
      command.add_option("--limit", arguments.at_most, "the largest value that is good enough")
          ->check(real_between(-1e12, 1e12).description(""));
  command.add_option("--at-least", arguments.at_least, "in place of --limit: the smallest one")
      ->check(real_between(-1e12, 1e12).description(""))
      ->excludes(most);
  command.add_option("--share", arguments.wanted.share, "of the worlds in which the limit has to hold")
      ->check(real_between(0.01, 0.999))
      ->capture_default_str();
  command.add_option("--confidence", arguments.wanted.confidence, "with which that is said")
      ->check(real_between(0.01, 0.999))
      ->capture_default_str();
  command
      .add_option("--tolerance", arguments.tolerance,
                  "how near to each other levels are, as a share of a level")
      ->check(real_between(0.001, 0.5))
      ->capture_default_str();
}

}  // namespace

void add_budget_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("budget", "find how large a fault may be for a metric to hold its limit");
  auto arguments = std::make_shared<BudgetArguments>();
  add_scenario_options(*command, arguments->scenario);
  add_shard_options(*command, arguments->scenario.run.shards);
  add_question(*command, *arguments);
  command->footer(
      "The same seeds are run at every level, as few of them as the answer needs. Without --seeds there are\n"
      "as many as the share and the confidence ask for (59 for 95 % and 95 %). Writes budget.json, "
      "budget.png\n"
      "and report.html.\n\n"
      "Example: stereobench budget assets/scenarios/ball_circle.yaml --vary detector_noise.centre_sd_px=0..2 "
      "--metric filters.smoother.ate_rms_m --limit 0.05");
  command->callback([arguments, command, &action] {
    if (!arguments->at_most && !arguments->at_least) throw CLI::RequiredError("--limit or --at-least");
    arguments->scenario.run.words = words_of(*command);
    arguments->scenario.run.shards.words = whole_words_of(*command);
    action = [arguments] { return find_budgets(*arguments); };
  });
}

}  // namespace stereobench::harness
