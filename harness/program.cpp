#include "harness/program.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/commands/all_commands.h"
#include "harness/commands/commands.h"
#include "harness/process/interruption.h"
#include "harness/process/process_pool.h"
#include "harness/process/standard_streams.h"
#include "harness/reference_commands/complete_command.h"
#include "worlds/yaml/advice.h"

namespace stereobench::harness {
namespace {

/// An empty value is an unset variable of a script; nothing that a command takes is empty.
void refuse_empty_values(CLI::App& command) {
  const CLI::Validator filled(
      [](const std::string& value) {
        const bool empty = value.find_first_not_of(" \t\n") == std::string::npos;
        return empty ? "expected a value, got an empty one (is a variable unset?)" : std::string();
      },
      "");
  for (CLI::Option* const option : command.get_options())
    if (option->get_expected_min() > 0) option->check(filled);
}

/// What a word is called that begins an unknown command line.
void check_command(CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (word.starts_with("-") || std::ranges::find(names, word) != names.end()) return;
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw std::runtime_error(fmt::format("no command is called '{}', {}", word, worlds::advice(word, known)));
}

/// What may be meant by an option that there is not; empty where all are known.
std::string option_advice(const CLI::App& program) {
  std::string advice;
  for (const CLI::App* command : program.get_subcommands()) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command->get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    const std::vector<std::string_view> known(names.begin(), names.end());
    for (const std::string& word : command->remaining()) {
      const auto meant = worlds::nearest_word(word.substr(0, word.find('=')), known);
      if (word.starts_with("--") && meant) advice += fmt::format(", did you mean {}?", *meant);
    }
  }
  return advice;
}

int run_command_line(int argc, const char* const* argv) {
  CLI::App program(
      "Renders worlds of coloured balls, sees them in stereo, maps them, and scores every stage.");
  program.name("stereobench");
  program.set_version_flag("--version", STEREOBENCH_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 passed, 1 a gate is broken or a metric got worse, 2 bad input, 4 a run or a detector\n"
      "crashed, 5 a suite's baseline is missing or of other inputs, or shards contradict each other;\n"
      "--strict: 3 inconclusive, 6 a metric got better; `cluster status`: 3 shards are missing.\n"
      "Start with: stereobench run assets/scenarios/ball_circle.yaml");
  Action action;
  add_commands(program, action);
  if (argc > 1 && std::string_view(argv[1]) == "complete")
    return complete(program, std::vector<std::string>(argv + 2, argv + argc));
  for (CLI::App* const command : program.get_subcommands({})) refuse_empty_values(*command);
  if (argc > 1) check_command(program, argv[1]);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return program.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    throw std::runtime_error(fmt::format("{}{}; see --help", error.what(), option_advice(program)));
  }
  return action();
}

}  // namespace

int run_words(const std::vector<std::string>& words) {
  std::vector<const char*> pointers;
  for (const std::string& word : words) pointers.push_back(word.c_str());
  return run_command_line(static_cast<int>(pointers.size()), pointers.data());
}

void add_commands(CLI::App& program, Action& action) {
  add_run_command(program, action);
  add_render_command(program, action);
  add_export_command(program, action);
  add_dataset_command(program, action);
  add_merge_command(program, action, run_words);
  add_cluster_command(program, action, run_words);
  add_verify_command(program, action);
  add_preview_command(program, action);
  add_import_command(program, action);
  add_slam_command(program, action);
  add_compare_command(program, action);
  add_test_command(program, action);
  add_bless_command(program, action);
  add_replay_command(program, action);
  add_history_command(program, action);
  add_sweep_command(program, action);
  add_budget_command(program, action);
  add_attribute_command(program, action);
  add_sensitivity_command(program, action);
  add_world_command(program, action);
  add_detect_command(program, action);
  add_calibrate_command(program, action);
  add_calibrate_rig_command(program, action);
  add_learn_palette_command(program, action);
  add_metrics_command(program, action);
  add_schema_command(program, action);
  add_faults_command(program, action);
  add_doctor_command(program, action);
}

int run_program(int argc, char** argv) {
  open_standard_streams();
  end_on_signals();
  try {
    const int outcome = run_command_line(argc, argv);
    flush_standard_output();
    return outcome;
  } catch (const RunCrash& crash) {
    complain(crash);
    return kRunCrashed;
  } catch (const std::exception& error) {
    complain(error);
    return kBadInput;
  }
}

}  // namespace stereobench::harness
