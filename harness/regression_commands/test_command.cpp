#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/io/atomic_file.h"
#include "harness/json/json_text.h"
#include "harness/regression_commands/changed_pairs.h"
#include "harness/regression_commands/suite_page.h"
#include "harness/regression_commands/suite_pictures.h"
#include "harness/regression_commands/suite_run.h"
#include "harness/regression_commands/test_result.h"
#include "harness/suite/suite_report.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

struct TestArguments {
  SuiteArguments suite;
  bool strict = false;
  fs::path junit;
  fs::path markdown;
};

bool has(const std::vector<CaseReport>& cases, CaseState state) {
  return std::ranges::any_of(cases, [state](const CaseReport& report) { return state_of(report) == state; });
}

int exit_code_of(const std::vector<CaseReport>& cases, bool strict) {
  if (has(cases, CaseState::kError)) return kRunCrashed;
  for (const CaseState worse : {CaseState::kRegressed, CaseState::kGateBroken, CaseState::kPictureChanged})
    if (has(cases, worse)) return kGateBroken;
  if (has(cases, CaseState::kNoBaseline)) return kNoBaseline;
  if (strict && has(cases, CaseState::kInconclusive)) return kInconclusive;
  return strict && has(cases, CaseState::kImproved) ? kImproved : kPassed;
}

void say_what_would_be_done(const SuitePlan& plan, const fs::path& out) {
  for (const PlannedCase& planned : plan.cases) {
    const std::string obstacle = obstacle_to_comparison(planned, plan);
    fmt::print("{}: would run {}; {} gates; {}\n", planned.what.name, work_of(planned.experiment),
               planned.gates.size(), obstacle.empty() ? "would compare" : obstacle);
  }
  fmt::print("{} cases; results: {}\n", plan.cases.size(), (out / "").string());
}

void write_files(const TestArguments& arguments, const SuitePlan& plan, const fs::path& out,
                 const std::vector<CaseReport>& cases) {
  const std::string& name = plan.suite.name;
  if (!arguments.junit.empty()) write_file_atomically(arguments.junit, junit_xml(suite_junit(name, cases)));
  if (!arguments.markdown.empty()) write_file_atomically(arguments.markdown, suite_page(name, cases, out));
  write_file_atomically(out / kTestResult, json_text(suite_json(name, cases)));
}

int test(const TestArguments& arguments) {
  const SuitePlan plan = plan_suite(arguments.suite);
  const fs::path& out = plan.out;
  if (arguments.suite.run.dry_run) {
    say_what_would_be_done(plan, out);
    return kPassed;
  }
  if (const auto end = do_suite_shard(plan, arguments.suite, out)) return *end;
  prepare_output_folder(out);
  fs::remove(out / kTestResult);  // of an earlier test: it is not the result of this one
  KeptDrives kept(out);
  write_side_file(out, {arguments.suite.suite, plan.baseline});
  std::vector<CaseReport> cases = run_suite(plan, arguments.suite, out, kept);
  check_pictures(plan, arguments.suite, out, cases);
  keep_changed_pairs(plan, arguments.suite, out, cases);
  write_suite_page(plan, out, cases, arguments.suite.run.words);
  write_files(arguments, plan, out, cases);
  kept.discard();
  const int outcome = exit_code_of(cases, arguments.strict);
  say_gates(suite_text(cases, out), outcome != kPassed);
  fmt::print("results: {}\n", (out / "").string());
  return outcome;
}

void add_options(CLI::App& command, TestArguments& arguments) {
  SuiteArguments& suite = arguments.suite;
  command.add_option("suite", suite.suite, "suite file (YAML)")->required();
  repeatable(
      command.add_option("--only", suite.only,
                         "run only cases whose names fit, e.g. 'circle*'; may be repeated (default: all)"))
      ->type_name("GLOB");
  command.add_option("--baseline", suite.baseline,
                     "folder of the baseline (default: NAME.baseline beside NAME.yaml)");
  command
      .add_option("--detector", suite.detector,
                  "what finds the balls in all cases with pictures, in place of what they say")
      ->type_name("NAME|COMMAND");
  add_backend_option(command, suite.backend);
  add_seed_options(command, suite.run);
  add_shard_options(command, suite.run.shards);
  command
      .add_flag("--until-decided", suite.until_decided,
                "run 10, 20, 40, ... seeds of the baseline until no metric is inconclusive or one got worse")
      ->excludes("--seeds");
  command
      .add_option("--max-seeds", suite.max_seeds,
                  "with --until-decided: seeds of a case at most (default: 80)")
      ->check(CLI::Range(1, 10000))
      ->needs("--until-decided");
  command.add_flag("--strict", arguments.strict,
                   "exit with 3 when a metric is inconclusive, with 6 when one improved");
  command.add_option("--junit", arguments.junit, "write the verdicts to this file as JUnit's XML, for CI");
  command.add_option("--markdown", arguments.markdown, "write the tables to this file, for a pull request");
}

}  // namespace

void add_test_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("test", "run a suite of scenarios and compare it with its baseline");
  auto arguments = std::make_shared<TestArguments>();
  add_options(*command, *arguments);
  command->footer(
      "Each case is run as `run` does it, into a folder of its own, and each metric is judged as `compare` "
      "does.\n"
      "Cases that see the same world through the same cameras share its pictures. Nothing is written into "
      "the\n"
      "baseline: `stereobench bless` does that. Interrupted, the same command goes on where it was.\n"
      "Results go to out/NAME_suite unless --out says otherwise; report.html there is the page to look at.\n"
      "Exits with 1 when a metric is REGRESSED or VANISHED, a gate is broken or a picture has changed, with "
      "4\n"
      "when a case broke down, with 5 when a baseline is missing or of other inputs.\n\n"
      "Example: stereobench test assets/suites/quick.yaml --junit out/junit.xml");
  command->callback([arguments, command, &action] {
    arguments->suite.run.words = words_of(*command);
    arguments->suite.run.shards.words = whole_words_of(*command);
    action = [arguments] { return test(*arguments); };
  });
}

}  // namespace stereobench::harness
