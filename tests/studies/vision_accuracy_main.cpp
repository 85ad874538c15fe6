/// How exact vision is, held against what is asked of it.
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/dataset/atomic_file.h"
#include "harness/run/process_pool.h"
#include "tests/studies/depth_study.h"
#include "tests/studies/field_study.h"
#include "tests/studies/painted_study.h"
#include "worlds/seeds.h"

namespace stereobench {
namespace {

using harness::ExitCode;

struct Arguments {
  std::string seeds = "0..159";
  int fields = 4;
  int jobs = 2;
  std::filesystem::path out;
};

void add_options(CLI::App& program, Arguments& arguments) {
  program.add_option("--seeds", arguments.seeds, "of the galleries, one each: 0..39, or 0,2,5")
      ->capture_default_str();
  program.add_option("--fields", arguments.fields, "fields with distractors, four drawn worlds each")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  program.add_option("--jobs,-j", arguments.jobs, "processes at a time; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  program.add_option("--out,-o", arguments.out, "the same as JSON")->type_name("FILE");
  program.footer(
      "Prints what vision measures beside its limits: whole balls by depth (9 cm radius, plain walls, 2 "
      "levels\n"
      "of noise, sizes exact and to 1 mm, in galleries as `stereobench calibrate` makes them), painted balls "
      "by where they lie "
      "between\n"
      "pixels, balls among things that look like them, and balls that are hidden in part. +- is the 95 %\n"
      "interval; where it reaches across a limit, more --seeds decide.\n"
      "Exit codes: 0 all limits are met, 1 one is short, 2 bad usage, 4 a process crashed.\n\n"
      "Example: stereobench_vision_accuracy --seeds 160..319 --out accuracy.json");
}

std::vector<std::uint64_t> seeds_of(const Arguments& arguments) {
  try {
    return worlds::parse_seeds(arguments.seeds);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("--seeds: {}", error.what()));
  }
}

int study(const Arguments& arguments) {
  const std::vector<std::uint64_t> seeds = seeds_of(arguments);
  if (!arguments.out.empty())
    harness::prepare_output_folder(std::filesystem::absolute(arguments.out).parent_path());
  std::vector<Section> sections = study_depths(seeds, arguments.jobs);
  sections.push_back(study_tolerance(seeds, arguments.jobs));
  sections.push_back(study_phases(arguments.jobs));
  for (const Section& section : study_fields(arguments.fields, arguments.jobs)) sections.push_back(section);
  sections.push_back(study_hidden_balls(arguments.jobs));
  if (!arguments.out.empty()) {
    const nlohmann::ordered_json json = {{"schema", "stereobench.vision_accuracy/1"},
                                         {"seeds", seeds},
                                         {"fields", arguments.fields},
                                         {"sections", json_of(sections)}};
    harness::write_file_atomically(arguments.out, json.dump(2) + "\n");
  }
  fmt::print("{}", tables_of(sections));
  return all_met(sections) ? ExitCode::kPassed : ExitCode::kGateBroken;
}

int run_program(int argc, char** argv) {
  CLI::App program("Measures how exact vision is, and holds it against limits.");
  program.name("stereobench_vision_accuracy");
  Arguments arguments;
  add_options(program, arguments);
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& asked_for_help) {
    return program.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    throw std::runtime_error(fmt::format("{}; see --help", error.what()));
  }
  return study(arguments);
}

int fail(const std::exception& error, int exit_code) {
  fmt::print(stderr, "stereobench_vision_accuracy: {}\n", error.what());
  return exit_code;
}

}  // namespace
}  // namespace stereobench

int main(int argc, char** argv) {
  using namespace stereobench;
  try {
    return run_program(argc, argv);
  } catch (const harness::RunCrash& crash) {
    return fail(crash, ExitCode::kRunCrashed);
  } catch (const std::exception& error) {
    return fail(error, ExitCode::kBadInput);
  }
}
