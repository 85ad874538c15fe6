/// Pictures of the frames that changed most in cases that got worse.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/regression_commands/suite_plan.h"
#include "harness/suite/case_report.h"

namespace stereobench::harness {

/// Renders those that the cases' results have not kept, and writes them beside the kept ones
/// (harness/frames/pair_files.h), where the suite's page finds them.
/// @param reports of the cases of the plan, in its order
/// @throws std::runtime_error when a file cannot be written; RunCrash when a process dies
void keep_changed_pairs(const SuitePlan& plan, const SuiteArguments& arguments,
                        const std::filesystem::path& out, const std::vector<CaseReport>& reports);

}  // namespace stereobench::harness
