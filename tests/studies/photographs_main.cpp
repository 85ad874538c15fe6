/// What vision makes of photographs of balls, held against what is asked of it.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/io/atomic_file.h"
#include "tests/studies/photograph_study.h"
#include "tests/studies/study_program.h"

namespace stereobench {
namespace {

struct Arguments {
  StudyArguments study = {.seeds = "0..199"};
  std::filesystem::path pictures;
};

void add_options(CLI::App& program, Arguments& arguments) {
  add_study_options(program, arguments.study, "of the pictures, one each");
  program.add_option("--pictures", arguments.pictures, "folder for the pictures, to look at")
      ->type_name("DIR");
  program.footer(
      std::string(
          "Makes pictures of balls with seams, prints and sheen, in their shadows, in grass, moved and out "
          "of\n"
          "focus, as JPEGs; learns the colours of four of them, and counts what is found in the others.\n") +
      kStudyExitCodes + "Example: stereobench_photographs --seeds 1000..1099 --pictures out/photographs");
}

int study(const Arguments& arguments) {
  const std::vector<std::uint64_t> seeds = seeds_of(arguments.study);
  if (!arguments.pictures.empty()) harness::prepare_output_folder(arguments.pictures);
  return conclude(arguments.study, {{"schema", "stereobench.photographs/1"}, {"seeds", seeds}},
                  {section_of(study_photographs(seeds, arguments.study.jobs, arguments.pictures))});
}

}  // namespace
}  // namespace stereobench

int main(int argc, char** argv) {
  using namespace stereobench;
  CLI::App program("Counts which balls of photographs are found and trusted, and holds that against limits.",
                   "stereobench_photographs");
  Arguments arguments;
  add_options(program, arguments);
  return run_study(program, argc, argv, [&] { return study(arguments); });
}
