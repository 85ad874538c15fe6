#include "tests/studies/field_study.h"

#include <fmt/format.h>

#include "harness/commands/scenario_arguments.h"
#include "harness/run/seed_result.h"

namespace stereobench {
namespace {

/// How far the white balance is off, and what must be found nevertheless.
struct Balance {
  int off_percent;
  double recall;
};

// All of 2,659 balls were found with 5 %, all but one with 10 %: less three standard errors (the rule of
// three).
constexpr Balance kBalances[] = {{5, 0.9988}, {10, 0.998}};

/// @param number of the field, from 0
harness::Experiment field(int number, int off_percent) {
  harness::ScenarioArguments arguments;
  arguments.scenario = STEREOBENCH_SOURCE_DIR "/assets/scenarios/ball_circle.yaml";
  arguments.run.seeds = {0, 1, 2, 3};
  arguments.overrides = {
      "path.laps=1",
      "placement_jitter_m=0",
      "identity=colour_class",
      "gates=[]",
      fmt::format("world={{floor: tiles, ball_radius_m: 0.06, generator: {{kind: ball_field, balls: 40, "
                  "low_m: [-3, -2], high_m: [3, 4], seed: {}}}}}",
                  number + 1),
      fmt::format("camera.white_balance_rgb=[{}, 1, {}]", 1.0 + off_percent / 100.0,
                  1.0 - off_percent / 100.0),
      "randomise={walls: {}, floor: {}, light: {}, clutter: {}, distractors: {}}"};
  harness::Experiment experiment = harness::read_experiment(arguments);
  experiment.filters.clear();
  return experiment;
}

/// What vision made of some drives.
struct Seen {
  harness::VisionScore score;
  long pairs = 0;
};

Seen drive_through(const std::vector<harness::Experiment>& fields, int jobs, const std::string& what) {
  std::vector<harness::DriveTask> tasks;
  for (const harness::Experiment& experiment : fields)
    for (const std::uint64_t seed : experiment.seeds) tasks.push_back({&experiment, seed});
  Seen seen;
  harness::drive_seeds(tasks, jobs, what, [&](std::size_t, const harness::SeedResult& seed) {
    seen.score += *seed.vision;
    seen.pairs += seed.steps;
  });
  return seen;
}

double per_thousand(long part, long whole) {
  return 1e3 * static_cast<double>(part) / static_cast<double>(whole);
}

Section section_of(const Seen& seen, const Balance& balance) {
  const harness::VisionScore& score = seen.score;
  return {fmt::format("among distractors, white balance off by {} %", balance.off_percent),
          {{"pairs of images", static_cast<double>(seen.pairs)},
           {"balls at least 95 % visible, r >= 5 px", static_cast<double>(score.visible)},
           {"recall of these", score.recall(), 0.0, {.at_least = balance.recall}},
           {"trusted detections", static_cast<double>(score.observations)},
           {"of nothing or of a ball twice, per 1,000 pairs",
            per_thousand(score.spurious + score.repeated, seen.pairs),
            0.0,
            {.at_most = 1.0}},
           {"wrong identities per 1,000 detections",
            per_thousand(score.misidentified, score.observations),
            0.0,
            {.at_most = 1.0}}}};
}

}  // namespace

std::vector<Section> study_fields(int fields, int jobs) {
  std::vector<Section> sections;
  for (const Balance& balance : kBalances) {
    std::vector<harness::Experiment> experiments;
    for (int i = 0; i < fields; ++i) experiments.push_back(field(i, balance.off_percent));
    const std::string what = fmt::format("fields, white balance off by {} %", balance.off_percent);
    sections.push_back(section_of(drive_through(experiments, jobs, what), balance));
  }
  return sections;
}

}  // namespace stereobench
