/// Golden pictures of a suite's cases.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/regression_commands/suite_plan.h"
#include "harness/suite/case_report.h"

namespace stereobench::harness {

/// Where a result keeps the golden frames of its case, and a baseline those of one.
std::filesystem::path golden_folder(const std::filesystem::path& result);
std::filesystem::path golden_baseline(const std::filesystem::path& baseline, const std::string& name);

/// The files of golden frames in a folder. Whatever else lies there is not among them.
std::vector<std::filesystem::path> golden_files_in(const std::filesystem::path& folder);

/// Renders the golden frames of the cases that did not break down into OUT/<case>/golden/, and holds them
/// against those of the baseline. Differences are drawn beside them.
/// @param reports of the cases of the plan, in its order; gets the pictures
/// @throws std::runtime_error where a frame has no pictures or a file cannot be written
void check_pictures(const SuitePlan& plan, const SuiteArguments& arguments, const std::filesystem::path& out,
                    std::vector<CaseReport>& reports);

}  // namespace stereobench::harness
