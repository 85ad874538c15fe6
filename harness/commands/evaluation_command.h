/// `slam --evaluate`: scores a trajectory that was made elsewhere.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "harness/experiment/types.h"
#include "harness/trajectories/evaluation.h"

namespace stereobench::harness {

struct EvaluationArguments {
  std::filesystem::path estimate;
  std::filesystem::path truth;
  EvaluationRules rules;
  std::vector<std::string> words;  ///< of the command line; empty: not known
};

/// Adds --evaluate and the options that go with it.
void add_evaluation_options(CLI::App& command, EvaluationArguments& arguments);

/// @throws CLI::ParseError that names an option of the command that has no meaning beside --evaluate
void check_evaluation_options(const CLI::App& command);

/// @param out empty: out/<the estimate's name>_evaluation
/// @return the exit code
int run_evaluation(const EvaluationArguments& arguments, std::filesystem::path out,
                   const std::vector<Gate>& gates, bool dry_run);

}  // namespace stereobench::harness
