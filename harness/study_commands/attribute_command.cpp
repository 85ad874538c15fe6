#include <fmt/format.h>

#include "harness/attribution/attribution.h"
#include "harness/attribution/attribution_page.h"
#include "harness/attribution/waterfall.h"
#include "harness/commands/commands.h"
#include "harness/commands/scenario_arguments.h"
#include "harness/commands/talk.h"
#include "harness/experiment/scenario_file.h"
#include "harness/io/atomic_file.h"
#include "harness/io/text_table.h"
#include "harness/result_pages/run_page.h"
#include "harness/run/run_output.h"
#include "harness/study_commands/study_metric.h"
#include "harness/study_commands/study_runs.h"

namespace stereobench::harness {
namespace {

std::vector<StudyCell> cells_of(const std::vector<Oracle>& oracles, const std::vector<std::uint64_t>& seeds) {
  std::vector<StudyCell> cells;
  for (const Lines& lines : coalition_lines(oracles)) {
    cells.push_back({lines, {seeds.begin(), seeds.end()}});
    cells.back().lines.push_back("gates=[]");
  }
  return cells;
}

void write_attribution(const std::filesystem::path& out, const Attribution& attribution,
                       const ScenarioArguments& base, const Provenance& made_from) {
  write_file_atomically(out / "attribution.png", draw_waterfalls(attribution, "ate_rms_m"));
  write_file_atomically(out / kReport, page_html(attribution_page(attribution, base.run.words)));
  write_file_atomically(out / kResolvedScenario, made_from.scenario);
  nlohmann::ordered_json json = attribution_json(attribution);
  json["made_from"] = provenance_json(made_from);
  write_file_atomically(out / "attribution.json", json.dump(2) + "\n");
}

int attribute_errors(ScenarioArguments base) {
  refuse_gates(base);
  base.overrides = without_fault_names(base.scenario, base.overrides);
  const Experiment experiment = read_experiment(base);
  if (experiment.filters == std::vector<std::string>{kBaselineFilter})
    throw std::runtime_error("--filters: expected a filter beside dead_reckoning, which looks at nothing");
  const std::vector<Oracle> oracles = oracles_of(experiment);
  const std::string& name = experiment.scenario.name;
  const std::filesystem::path out = output_folder(base.run, name + "_attribution");
  const std::vector<StudyCell> cells = cells_of(oracles, experiment.seeds);
  if (base.run.dry_run) {
    for (const StudyCell& cell : cells) read_experiment(base, cell.lines);
    fmt::print("{}: would run {} combinations of perfect parts on {} each; results: {}\n", name, cells.size(),
               seeds_in_words(experiment.seeds.size()), (out / "").string());
    for (const Oracle& oracle : oracles) fmt::print("  {}: {}\n", oracle.part, oracle.says);
    return kPassed;
  }
  const std::string what = "attribute " + name;
  if (const auto end = do_study_shard(base, cells, out, what)) return *end;
  prepare_output_folder(out);
  StudyRuns runs(base, out, what);
  const auto metrics = runs.metrics(cells);
  const Attribution attribution =
      attribution_of(name, experiment.seeds, oracles, experiment.filters, metrics);
  write_attribution(out, attribution, base, provenance_of(base, {}, experiment, runs.pixels()));
  runs.discard();
  fmt::print("{}: {} combinations of perfect parts, {}\n\n{}\n{}\n", name, cells.size(),
             seeds_in_words(experiment.seeds.size()), kIntervalNote, attribution_table(attribution));
  fmt::print("results: {}\n", (out / "").string());
  return kPassed;
}

}  // namespace

void add_attribute_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("attribute", "say whose the error is: which part of the chain costs how much");
  auto arguments = std::make_shared<ScenarioArguments>();
  add_scenario_options(*command, *arguments);
  add_shard_options(*command, arguments->run.shards);
  command->footer(
      "Parts of the chain are made perfect, in all combinations, on the same seeds: the noise of the image,\n"
      "timing, what is believed of the rig, detection, identities, odometry, and the estimator (the bound).\n"
      "A part's share is the mean of what goes when it becomes perfect, over all orders (Shapley): shares\n"
      "add up to the whole. Writes attribution.json, attribution.png and report.html.\n\n"
      "Example: stereobench attribute assets/scenarios/ball_circle.yaml --seeds 0..9 --filters smoother");
  command->callback([arguments, command, &action] {
    arguments->run.words = words_of(*command);
    arguments->run.shards.words = whole_words_of(*command);
    action = [arguments] { return attribute_errors(*arguments); };
  });
}

}  // namespace stereobench::harness
