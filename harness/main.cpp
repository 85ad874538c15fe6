/// stereobench: an offscreen-rendered stereo simulation testbench. See README.md.
#include <cstdio>
#include <exception>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/run/process_pool.h"

namespace stereobench::harness {
namespace {

int run_program(int argc, char** argv) {
  CLI::App program(
      "Renders worlds of coloured balls, sees them in stereo, maps them, and scores every stage.");
  program.name("stereobench");
  program.set_version_flag("--version", STEREOBENCH_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 passed, 1 a gate is broken, 2 bad input, 4 a run or a detector crashed.\n"
      "Start with: stereobench run assets/scenarios/ball_circle.yaml");
  Action action;
  add_run_command(program, action);
  add_render_command(program, action);
  add_slam_command(program, action);
  add_sweep_command(program, action);
  add_world_command(program, action);
  add_detect_command(program, action);
  add_calibrate_command(program, action);
  add_calibrate_rig_command(program, action);
  add_learn_palette_command(program, action);
  add_doctor_command(program, action);
  const auto is_asked_for = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && program.get_subcommands(is_asked_for).empty())
    throw std::runtime_error(fmt::format("no command is called '{}'; see --help", argv[1]));
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return program.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "stereobench: {}; see --help\n", error.what());
    return kBadInput;
  }
  return action();
}

}  // namespace
}  // namespace stereobench::harness

int main(int argc, char** argv) {
  using namespace stereobench::harness;
  try {
    return run_program(argc, argv);
  } catch (const RunCrash& crash) {
    fmt::print(stderr, "stereobench: {}\n", crash.what());
    return kRunCrashed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "stereobench: {}\n", error.what());
    return kBadInput;
  }
}
