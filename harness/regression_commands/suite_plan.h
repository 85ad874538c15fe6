/// A suite made ready to be run: all that is wrong with its input is known before any work is done.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/commands/scenario_arguments.h"
#include "harness/suite/baseline.h"
#include "harness/suite/suite.h"

namespace stereobench::harness {

/// What the command line says of a suite.
struct SuiteArguments {
  std::filesystem::path suite;
  std::vector<std::string> only;   ///< patterns of the cases that are run; empty: all
  std::filesystem::path baseline;  ///< a folder; empty: the usual one
  std::string detector;            ///< in place of those of all cases with pictures; empty: as they say
  renderer::Backend backend = renderer::Backend::kSoftware;
  RunArguments run;            ///< seeds in place of those of all cases, jobs, folder of the results
  bool until_decided = false;  ///< more and more seeds of the baseline, until they decide
  int max_seeds = 80;
};

/// A case that can be run.
struct PlannedCase {
  SuiteCase what;
  ScenarioArguments arguments;
  Experiment experiment;
  std::vector<std::uint64_t> asked_seeds;  ///< by the suite, whatever the command line says
  std::vector<Gate> gates;
  BaselineInputs inputs;
  std::string pictures;  ///< cases with the same text see the same pictures of a seed
  std::optional<Baseline> baseline;
};

struct SuitePlan {
  Suite suite;
  std::filesystem::path baseline;
  std::filesystem::path out;  ///< of the results
  std::vector<PlannedCase> cases;
  std::string pixels;  ///< as of pixels_of; empty where no case has pictures
};

/// Reads the suite, its scenarios and its baseline.
/// @throws std::runtime_error for whatever is wrong with one of them, and where no case is asked for
SuitePlan plan_suite(const SuiteArguments& arguments);

/// Why a case cannot be compared with its baseline, and what to do; empty where it can.
std::string obstacle_to_comparison(const PlannedCase& planned, const SuitePlan& plan);

}  // namespace stereobench::harness
