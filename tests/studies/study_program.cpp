#include "tests/studies/study_program.h"

#include <exception>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/commands/commands.h"
#include "harness/experiment/seeds.h"
#include "harness/io/atomic_file.h"
#include "harness/process/process_pool.h"

namespace stereobench {
namespace {

using harness::ExitCode;

int fail(const CLI::App& program, const std::exception& error, int exit_code) {
  fmt::print(stderr, "{}: {}\n", program.get_name(), error.what());
  return exit_code;
}

}  // namespace

void add_study_options(CLI::App& program, StudyArguments& arguments, const std::string& seeds_are) {
  program.add_option("--seeds", arguments.seeds, seeds_are)->capture_default_str();
  program.add_option("--jobs,-j", arguments.jobs, "processes at a time; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  program.add_option("--out,-o", arguments.out, "the same as JSON")->type_name("FILE");
}

std::vector<std::uint64_t> seeds_of(const StudyArguments& arguments) {
  std::vector<std::uint64_t> seeds;
  try {
    seeds = harness::parse_seeds(arguments.seeds);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("--seeds: {}", error.what()));
  }
  if (!arguments.out.empty())
    harness::prepare_output_folder(std::filesystem::absolute(arguments.out).parent_path());
  return seeds;
}

int conclude(const StudyArguments& arguments, nlohmann::ordered_json facts,
             const std::vector<Section>& sections) {
  facts["sections"] = json_of(sections);
  if (!arguments.out.empty()) harness::write_file_atomically(arguments.out, facts.dump(2) + "\n");
  fmt::print("{}", tables_of(sections));
  return all_met(sections) ? ExitCode::kPassed : ExitCode::kGateBroken;
}

int run_study(CLI::App& program, int argc, char** argv, const std::function<int()>& study) {
  try {
    program.parse(argc, argv);
    return study();
  } catch (const CLI::Success& asked_for_help) {
    return program.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    return fail(program, std::runtime_error(fmt::format("{}; see --help", error.what())),
                ExitCode::kBadInput);
  } catch (const harness::RunCrash& crash) {
    return fail(program, crash, ExitCode::kRunCrashed);
  } catch (const std::exception& error) {
    return fail(program, error, ExitCode::kBadInput);
  }
}

}  // namespace stereobench
