#include "harness/regression_commands/suite_plan.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "harness/commands/kept_drives.h"
#include "harness/experiment/stage_lines.h"
#include "harness/experiment/write_experiment.h"
#include "harness/golden/golden_limits.h"
#include "harness/io/sha256.h"
#include "harness/page/command_words.h"
#include "harness/regression/gates.h"
#include "renderer/backend.h"
#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

/// Keys of a scenario that say what is compared, and not what it is compared on.
const std::set<std::string> kNoInputs = {
    "name", "description", "seeds", "gates", "filters", "detector", "detector_timeout_s", "detector_start_s"};

ScenarioArguments arguments_of(const SuiteCase& what) {
  ScenarioArguments arguments{.scenario = what.scenario,
                              .overrides = what.set,
                              .detector = what.detector,
                              .detector_timeout_s = what.detector_timeout_s,
                              .detector_start_s = what.detector_start_s};
  arguments.run.filters = what.filters;
  arguments.run.particles = what.particles;
  arguments.run.seeds = what.seeds;
  arguments.run.gates = what.gates;
  return arguments;
}

/// The words of a `run` of the case alone, but for its seeds.
std::vector<std::string> words_of_run(const ScenarioArguments& arguments) {
  const RunArguments& run = arguments.run;
  std::vector<std::string> words = {"stereobench", "run", arguments.scenario.string()};
  for (const std::string& change : arguments.overrides) words.insert(words.end(), {"--set", change});
  if (!run.filters.empty())
    words.insert(words.end(), {"--filters", fmt::format("{}", fmt::join(run.filters, ","))});
  if (run.particles > 0) words.insert(words.end(), {"--particles", std::to_string(run.particles)});
  if (!run.seeds.empty()) words.insert(words.end(), {"--seeds", seeds_word(run.seeds)});
  if (!arguments.detector.empty()) words.insert(words.end(), {"--detector", arguments.detector});
  return words;
}

bool has_pictures(const Experiment& experiment) {
  return experiment.scenario.sensor == worlds::SensorKind::kStereo;
}

/// Some of the scenario's lines, and the hashes of its files.
template <class Lines>
std::string text_of(const ScenarioArguments& arguments, const Experiment& experiment, const Lines& lines_of) {
  std::vector<std::string> overrides = arguments.overrides;
  overrides.push_back(fmt::format("particles={}", experiment.particles));
  return lines_of(with_overrides(arguments.scenario, overrides)) +
         nlohmann::json(hashes_of_named_files(arguments.scenario, overrides)).dump();
}

std::string lines_of_inputs(const std::string& scenario) {
  return without_keys(scenario, kNoInputs);
}

/// Names of numbers as compare_results has them: without ".mean".
void append_names(const nlohmann::ordered_json& json, const std::string& name,
                  std::vector<std::string>& names) {
  if (!json.is_object()) return names.push_back(name);
  if (json.contains("mean")) names.push_back(name);
  for (const auto& [key, child] : json.items())
    append_names(child, name.empty() ? key : name + "." + key, names);
}

/// @throws std::runtime_error for a pattern of metrics that no metric of the case fits
void check_patterns(const SuiteCase& what, const nlohmann::ordered_json& result) {
  std::vector<std::string> names;
  append_names(result, "", names);
  for (const std::string& pattern : what.metrics)
    if (std::ranges::none_of(names, [&](const std::string& name) { return fits(name, pattern); }))
      throw std::runtime_error(fmt::format("metrics: no metric of the case fits '{}'", pattern));
}

void check_frames(const PlannedCase& planned) {
  const auto& frames = planned.what.golden.frames;
  if (frames.empty()) return;
  golden_limits(planned.what.golden.limits);
  if (!has_pictures(planned.experiment))
    throw std::runtime_error("golden: the sensor of the scenario is the oracle, which has no pictures");
  const std::size_t steps = planned.experiment.scenario.path.size();
  for (const int frame : frames)
    if (static_cast<std::size_t>(frame) >= steps)
      throw std::runtime_error(fmt::format("golden.frames: expected frames below {} (got {})", steps, frame));
}

PlannedCase plan_case(const SuiteCase& what, const SuiteArguments& suite) {
  PlannedCase planned{.what = what, .arguments = arguments_of(what)};
  planned.experiment = read_experiment(planned.arguments);
  planned.asked_seeds = planned.experiment.seeds;
  planned.arguments.backend = suite.backend;
  planned.arguments.run.jobs = suite.run.jobs;
  if (!suite.run.seeds.empty()) planned.arguments.run.seeds = suite.run.seeds;
  if (!suite.detector.empty() && has_pictures(planned.experiment))
    planned.arguments.detector = suite.detector;
  planned.arguments.run.words = words_of_run(planned.arguments);
  planned.experiment = read_experiment(planned.arguments);
  check_patterns(what, result_without_values(planned.experiment));
  planned.gates = gates_of(planned.experiment);
  check_metrics(planned.gates, result_without_values(planned.experiment));
  check_frames(planned);
  planned.inputs.sha256 = sha256_of(text_of(planned.arguments, planned.experiment, lines_of_inputs));
  planned.pictures = text_of(planned.arguments, planned.experiment, lines_of_pictures);
  return planned;
}

}  // namespace

SuitePlan plan_suite(const SuiteArguments& arguments) {
  SuitePlan plan{.suite = read_suite(arguments.suite)};
  plan.out = output_folder(arguments.run, plan.suite.name + "_suite");
  plan.baseline = arguments.baseline.empty() ? usual_baseline(arguments.suite) : arguments.baseline;
  for (const SuiteCase& what : plan.suite.cases) {
    if (!fits_any(what.name, arguments.only)) continue;
    try {
      plan.cases.push_back(plan_case(what, arguments));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("case {}: {}", what.name, error.what()));
    }
  }
  if (plan.cases.empty())
    throw std::runtime_error(fmt::format("--only: no case of {} has such a name", arguments.suite.string()));
  for (PlannedCase& planned : plan.cases) {
    if (has_pictures(planned.experiment)) {
      if (plan.pixels.empty()) plan.pixels = pixels_of(planned.experiment.scenario, arguments.backend);
      planned.inputs.pixels = plan.pixels;
    }
    planned.baseline = read_baseline(baseline_file(plan.baseline, planned.what.name));
  }
  return plan;
}

std::string obstacle_to_comparison(const PlannedCase& planned, const SuitePlan& plan) {
  const std::vector<std::string> words = {"stereobench", "bless", plan.out.string(), "--reason", "WHY"};
  const std::string bless = "look at the result; where it is good: " + shell_line(words);
  if (!planned.baseline)
    return fmt::format("there is no {}; {}", baseline_file(plan.baseline, planned.what.name).string(), bless);
  const BaselineInputs& before = planned.baseline->inputs;
  const std::string name = planned.what.name + ".json";
  if (before.sha256 != planned.inputs.sha256)
    return fmt::format("{} is of another scenario: its file, `set:`, `particles:` or a mesh has changed; {}",
                       name, bless);
  if (before.pixels != planned.inputs.pixels)
    return fmt::format(
        "{} was made with pixels {}, this renderer has {}: take the same packages (`stereobench doctor`), or "
        "a "
        "baseline of this machine: stereobench test {} --baseline OTHER, then stereobench bless",
        name, worlds::excerpt(before.pixels), planned.inputs.pixels, plan.suite.file.filename().string());
  const auto is_new = [&](std::uint64_t seed) {
    return std::ranges::count(planned.baseline->seeds.seeds, seed) == 0;
  };
  const auto missing = std::ranges::count_if(planned.experiment.seeds, is_new);
  if (missing > 0)
    return fmt::format("{} lacks {} of {} seeds; {}", name, missing, planned.experiment.seeds.size(), bless);
  return {};
}

}  // namespace stereobench::harness
