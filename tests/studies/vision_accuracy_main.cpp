/// How exact vision is, held against what is asked of it.
#include <cstdint>
#include <string>
#include <vector>

#include "tests/studies/depth_study.h"
#include "tests/studies/field_study.h"
#include "tests/studies/painted_study.h"
#include "tests/studies/study_program.h"

namespace stereobench {
namespace {

struct Arguments {
  StudyArguments study = {.seeds = "0..159"};
  int fields = 4;
};

void add_options(CLI::App& program, Arguments& arguments) {
  add_study_options(program, arguments.study, "of the calibration scenes, one each: 0..39, or 0,2,5");
  program.add_option("--fields", arguments.fields, "fields with distractors, four drawn worlds each")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  program.footer(
      std::string(
          "Prints what vision measures beside its limits: whole balls by depth (9 cm radius, plain walls, 2\n"
          "levels of noise, sizes exact and to 1 mm, in calibration scenes as `stereobench calibrate` makes "
          "them),\n"
          "painted balls by where they lie between pixels, balls among things that look like them, and "
          "balls\n"
          "that are hidden in part. +- is the 95 % interval; where it reaches across a limit, more --seeds\n"
          "decide.\n") +
      kStudyExitCodes + "Example: stereobench_vision_accuracy --seeds 160..319 --out accuracy.json");
}

int study(const Arguments& arguments) {
  const std::vector<std::uint64_t> seeds = seeds_of(arguments.study);
  const int jobs = arguments.study.jobs;
  std::vector<Section> sections = study_depths(seeds, jobs);
  sections.push_back(study_tolerance(seeds, jobs));
  sections.push_back(study_phases(jobs));
  for (const Section& section : study_fields(arguments.fields, jobs)) sections.push_back(section);
  sections.push_back(study_hidden_balls(jobs));
  return conclude(
      arguments.study,
      {{"schema", "stereobench.vision_accuracy/1"}, {"seeds", seeds}, {"fields", arguments.fields}},
      sections);
}

}  // namespace
}  // namespace stereobench

int main(int argc, char** argv) {
  using namespace stereobench;
  CLI::App program("Measures how exact vision is, and holds it against limits.",
                   "stereobench_vision_accuracy");
  Arguments arguments;
  add_options(program, arguments);
  return run_study(program, argc, argv, [&] { return study(arguments); });
}
