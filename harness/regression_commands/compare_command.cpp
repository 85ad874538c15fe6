#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/frame_replay/invocation.h"
#include "harness/io/atomic_file.h"
#include "harness/json/json_text.h"
#include "harness/regression/judgement.h"
#include "harness/regression/junit.h"
#include "harness/regression/result_folder.h"
#include "harness/regression/verdict_report.h"
#include "harness/regression_commands/self_comparison.h"
#include "harness/result_pages/comparison_page.h"

namespace stereobench::harness {
namespace {

struct CompareArguments {
  std::filesystem::path first;
  std::filesystem::path second;
  std::vector<std::string> margins;
  VerdictSettings settings;
  int runs = 0;  ///< of --self; 0: compare two results
  bool all = false;
  bool strict = false;
  std::filesystem::path json;
  std::filesystem::path markdown;
  std::filesystem::path junit;
  std::filesystem::path html;
  std::vector<std::string> words;  ///< of the command line
};

int exit_code_of(const ResultComparison& comparison, bool strict) {
  if (comparison.has(Verdict::kRegressed) || comparison.has(Verdict::kVanished)) return kGateBroken;
  if (strict && comparison.has(Verdict::kInconclusive)) return kInconclusive;
  return strict && comparison.has(Verdict::kImproved) ? kImproved : kPassed;
}

/// The balls of both; empty where one of the results has no detections.
std::optional<PairedBalls> balls_of(const StoredResult& first, const StoredResult& second) {
  if (first.detections.empty() || second.detections.empty()) return {};
  return pair_balls(read_detected_balls(first.detections), read_detected_balls(second.detections));
}

void write_files(const CompareArguments& arguments, const Judgement& judgement, const std::string& scenario) {
  const ComparedNames names{arguments.first.string(), arguments.second.string()};
  const std::string detections = detection_lines(judgement, replayable_folder(arguments.second));
  const ResultComparison& comparison = judgement.comparison;
  if (!arguments.json.empty()) {
    nlohmann::ordered_json json = verdict_json(comparison, arguments.settings, names);
    json["detections"] =
        judgement.changes ? changes_json(*judgement.changes) : nlohmann::ordered_json(nullptr);
    write_file_atomically(arguments.json, json_text(json));
  }
  if (!arguments.junit.empty())
    write_file_atomically(arguments.junit,
                          junit_xml({{"compare." + scenario, junit_cases(comparison), detections}}));
  if (!arguments.markdown.empty())
    write_file_atomically(arguments.markdown,
                          verdict_page(comparison, arguments.settings, names, detections, arguments.all));
}

/// @return exit code: 1 where a repetition differs
int compare_with_itself(const CompareArguments& arguments) {
  for (int run = 2; run <= arguments.runs; ++run) {
    const int jobs = run % 2 == 0 ? 1 : 2;  // results may not depend on it
    const auto different = differences_to_another_run(arguments.first, jobs);
    if (!different.empty()) {
      say_gates(fmt::format("{}: run {} of {} has other bytes in {}\n", arguments.first.string(), run,
                            arguments.runs, fmt::join(different, ", ")),
                true);
      return kGateBroken;
    }
  }
  fmt::print("{}: {} runs gave equal bytes\n", arguments.first.string(), arguments.runs);
  return kPassed;
}

int compare(CompareArguments arguments) {
  if (arguments.second.empty() == (arguments.runs == 0))
    throw std::runtime_error("compare: expected either two results, or one and --self N");
  if (arguments.runs > 0) return compare_with_itself(arguments);
  VerdictSettings& settings = arguments.settings;
  for (const std::string& margin : arguments.margins) settings.margins.push_back(parse_margin(margin));
  const StoredResult first = read_result(arguments.first);
  const StoredResult second = read_result(arguments.second);
  const Judgement judgement = judge(first.seeds, second.seeds, settings, balls_of(first, second));
  const ResultComparison& comparison = judgement.comparison;
  check_margins(comparison, settings.margins);
  write_files(arguments, judgement, second.scenario);
  if (!arguments.html.empty())
    write_file_atomically(arguments.html,
                          page_html(comparison_page({{arguments.first.string(), arguments.second.string()},
                                                     first,
                                                     second,
                                                     comparison,
                                                     settings,
                                                     judgement.changes,
                                                     arguments.words})));
  fmt::print("A: {} ({}, {} seeds)\nB: {} ({}, {} seeds)\n\n", arguments.first.string(), first.scenario,
             first.seeds.seeds.size(), arguments.second.string(), second.scenario, second.seeds.seeds.size());
  if (first.scenario != second.scenario) say("warning: A and B are of different scenarios\n");
  say(few_seeds_warning(comparison, settings));
  const int outcome = exit_code_of(comparison, arguments.strict);
  const std::string detections = detection_lines(judgement, replayable_folder(arguments.second));
  say_gates(detections + (detections.empty() ? "" : "\n") +
                verdict_table(comparison, settings, arguments.all) + verdict_summary(comparison),
            outcome != kPassed);
  return outcome;
}

void add_options(CLI::App& command, CompareArguments& arguments) {
  command.add_option("a", arguments.first, "the result to compare with: a folder that run or slam wrote")
      ->required();
  command.add_option("b", arguments.second, "the result that may be worse");
  command
      .add_option("--self", arguments.runs,
                  "run A again until there are N runs of it, and ask for equal bytes: the proof that a "
                  "scenario with its detector repeats")
      ->type_name("N")
      ->check(CLI::Range(2, 100));
  repeatable(command.add_option(
                 "--only", arguments.settings.only,
                 "judge only metrics whose names fit, e.g. 'vision.*'; may be repeated (default: all)"))
      ->type_name("GLOB");
  repeatable(command.add_option(
                 "--margin", arguments.margins,
                 "how much a metric may change before it matters: NAME=5% of its mean in A, or NAME=0.01 in "
                 "its own unit; NAME may have * in it; may be repeated, the last one that fits counts"))
      ->type_name("NAME=CHANGE");
  command
      .add_option("--alpha", arguments.settings.alpha,
                  "chance of a false alarm, all metrics together (default: 0.01)")
      ->check(real_between(1e-4, 0.5));
  command.add_flag("--all", arguments.all, "list metrics that pass, too");
  command.add_flag("--strict", arguments.strict,
                   "exit with 3 when a metric is inconclusive, with 6 when one improved");
  command.add_option("--json", arguments.json, "write the verdicts to this file");
  command.add_option("--junit", arguments.junit, "write the verdicts to this file as JUnit's XML, for CI");
  command.add_option("--markdown", arguments.markdown, "write the table to this file, for a pull request");
  command.add_option("--html", arguments.html,
                     "write a page to this file: verdicts, charts, and the frames that changed most");
  add_quiet_option(command);
}

}  // namespace

void add_compare_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("compare", "say what got worse from one result to another, seed by seed");
  auto arguments = std::make_shared<CompareArguments>();
  add_options(*command, *arguments);
  command->footer(
      "Both results are compared on the seeds that they share. Metrics that are equal on each pass. Of the "
      "others\n"
      "one is REGRESSED (or IMPROVED) when its change is significant (Wilcoxon's signed ranks, or McNemar's "
      "test\n"
      "of single balls; corrected for all metrics that changed) and the whole interval of the change "
      "(bootstrap) is beyond the margin; "
      "it\n"
      "passes when the whole interval is within the margin. Others are INCONCLUSIVE, and the table says "
      "about "
      "how\n"
      "many more seeds decide.\n"
      "Exits with 1 when a metric is REGRESSED or VANISHED.\n\n"
      "Example: stereobench compare out/before out/after --margin 'filters.*.ate_rms_m=2%'");
  command->callback([arguments, command, &action] {
    arguments->words = words_of(*command);
    action = [arguments] { return compare(*arguments); };
  });
}

}  // namespace stereobench::harness
