#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/talk.h"
#include "harness/history/history.h"
#include "harness/history/history_picture.h"
#include "harness/history/history_report.h"
#include "harness/io/atomic_file.h"
#include "harness/json/json_text.h"
#include "harness/regression/result_folder.h"

namespace stereobench::harness {
namespace {

struct HistoryArguments {
  std::vector<std::string> results;
  std::vector<std::string> margins;
  HistorySettings settings;
  bool strict = false;
  std::filesystem::path json;
  std::filesystem::path picture;
  std::size_t panels = 6;
};

int follow(HistoryArguments arguments) {
  HistorySettings& settings = arguments.settings;
  for (const std::string& margin : arguments.margins) settings.margins.push_back(parse_margin(margin));
  std::vector<SeedTable> results;
  std::vector<std::string> scenarios;
  for (const std::string& place : arguments.results) {
    StoredResult result = read_result(place);
    results.push_back(std::move(result.seeds));
    scenarios.push_back(std::move(result.scenario));
  }
  const History history = history_of(results, settings);
  if (!arguments.json.empty())
    write_file_atomically(arguments.json, json_text(history_json(history, settings, arguments.results)));
  if (!arguments.picture.empty())
    write_file_atomically(arguments.picture,
                          draw_history_picture(fmt::format("{}: {} results, {} seeds", scenarios.back(),
                                                           results.size(), history.seeds.size()),
                                               metrics_to_draw(history, arguments.panels)));
  fmt::print("{}\n", result_list(arguments.results, scenarios, results));
  if (std::ranges::count(scenarios, scenarios.front()) < std::ssize(scenarios))
    say("warning: the results are of different scenarios\n");
  say(history_warning(history, settings));
  const std::string table = step_table(history);
  const bool is_worse = arguments.strict && ends_worse(history);
  say_gates(table + (table.empty() ? "" : "\n") + history_summary(history, results.size()), is_worse);
  return is_worse ? kGateBroken : kPassed;
}

void add_history_options(CLI::App& command, HistoryArguments& arguments) {
  command
      .add_option("results", arguments.results,
                  "folders that run or slam wrote, or their run.json, from the oldest to the newest")
      ->required();
  repeatable(
      command.add_option("--only", arguments.settings.only,
                         "only metrics whose names fit, e.g. 'vision.*'; may be repeated (default: all)"))
      ->type_name("GLOB");
  repeatable(
      command.add_option("--margin", arguments.margins,
                         "how much a metric may change before it matters, as of compare; may be repeated"))
      ->type_name("NAME=CHANGE");
  command
      .add_option("--alpha", arguments.settings.alpha,
                  "chance of a false step, all metrics together (default: 0.01)")
      ->check(real_between(1e-4, 0.5));
  command.add_flag("--strict", arguments.strict,
                   "exit with 1 when the last step of a metric made it worse by more than its margin");
  command.add_option("--json", arguments.json, "write means and steps of all metrics to this file");
  command.add_option("--picture", arguments.picture,
                     "draw the metrics with the worst steps to this PNG file");
  command.add_option("--panels", arguments.panels, "how many metrics are drawn at most (default: 6)")
      ->check(CLI::Range(1, 12));
  add_quiet_option(command);
}

}  // namespace

void add_history_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("history", "say where metrics took a step over many results, and draw them");
  auto arguments = std::make_shared<HistoryArguments>();
  add_history_options(*command, *arguments);
  command->footer(
      "Results are taken in the order in which they are given, on the seeds that all of them have. A step "
      "is\n"
      "where seeds change alike: its p-value is the share of sign flips of whole seeds that look as clear.\n"
      "With n seeds no p-value is below 2^(1-n).\n\n"
      "Example: stereobench history out/monday out/tuesday out/wednesday --picture history.png");
  command->callback([arguments, &action] { action = [arguments] { return follow(*arguments); }; });
}

}  // namespace stereobench::harness
