/// What vision makes of photographs of balls, held against what is asked of it.
#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "harness/commands/commands.h"
#include "harness/dataset/atomic_file.h"
#include "harness/run/process_pool.h"
#include "tests/studies/photograph_study.h"
#include "worlds/seeds.h"

namespace stereobench {
namespace {

struct Arguments {
  std::string seeds = "0..199";
  int jobs = 2;
  std::filesystem::path out;
  std::filesystem::path pictures;
};

void add_options(CLI::App& program, Arguments& arguments) {
  program.add_option("--seeds", arguments.seeds, "of the pictures, one each")->capture_default_str();
  program.add_option("--jobs,-j", arguments.jobs, "processes at a time; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  program.add_option("--out,-o", arguments.out, "the table as JSON")->type_name("FILE");
  program.add_option("--pictures", arguments.pictures, "folder for the pictures, to look at")
      ->type_name("DIR");
  program.footer(
      "Makes pictures of balls with seams, prints and sheen, in their shadows, in grass, moved and out of\n"
      "focus, as JPEGs; learns the colours of four of them, and counts what is found in the others.\n"
      "Exit codes: 0 all limits are met, 1 one is short, 2 bad usage, 4 a process crashed.\n\n"
      "Example: stereobench_photographs --seeds 1000..1099 --pictures out/photographs");
}

int study(const Arguments& arguments) {
  std::vector<std::uint64_t> seeds;
  try {
    seeds = worlds::parse_seeds(arguments.seeds);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("--seeds: {}", error.what()));
  }
  if (!arguments.pictures.empty()) harness::prepare_output_folder(arguments.pictures);
  const std::vector<Section> sections = {
      section_of(study_photographs(seeds, arguments.jobs, arguments.pictures))};
  if (!arguments.out.empty()) {
    harness::prepare_output_folder(std::filesystem::absolute(arguments.out).parent_path());
    const nlohmann::ordered_json json = {
        {"schema", "stereobench.photographs/1"}, {"seeds", seeds}, {"sections", json_of(sections)}};
    harness::write_file_atomically(arguments.out, json.dump(2) + "\n");
  }
  fmt::print("{}", tables_of(sections));
  return all_met(sections) ? harness::ExitCode::kPassed : harness::ExitCode::kGateBroken;
}

int run_program(int argc, char** argv) {
  CLI::App program("Counts which balls of photographs are found and trusted, and holds that against limits.");
  program.name("stereobench_photographs");
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
  fmt::print(stderr, "stereobench_photographs: {}\n", error.what());
  return exit_code;
}

}  // namespace
}  // namespace stereobench

int main(int argc, char** argv) {
  using namespace stereobench;
  try {
    return run_program(argc, argv);
  } catch (const harness::RunCrash& crash) {
    return fail(crash, harness::ExitCode::kRunCrashed);
  } catch (const std::exception& error) {
    return fail(error, harness::ExitCode::kBadInput);
  }
}
