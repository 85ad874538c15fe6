/// The page of a suite: report.html.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/regression_commands/suite_plan.h"
#include "harness/suite/case_report.h"

namespace stereobench::harness {

/// Writes OUT/report.html: a table of the cases, and of each what changed since its baseline.
/// @param reports of the cases of the plan, in its order; their results are in OUT/<case>/
/// @param words of the command line
/// @throws std::runtime_error when a result cannot be read or the page cannot be written
void write_suite_page(const SuitePlan& plan, const std::filesystem::path& out,
                      const std::vector<CaseReport>& reports, const std::vector<std::string>& words);

}  // namespace stereobench::harness
