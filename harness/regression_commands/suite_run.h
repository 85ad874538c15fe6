/// A suite that is run: each case into a folder of its own, and held against its baseline.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/commands/kept_drives.h"
#include "harness/regression_commands/suite_plan.h"
#include "harness/suite/case_report.h"

namespace stereobench::harness {

/// With --shard, or for `merge`: what do_shard does with the drives of the first look.
/// @return the exit code, where the command is at its end
std::optional<int> do_suite_shard(const SuitePlan& plan, const SuiteArguments& arguments,
                                  const std::filesystem::path& out);

/// Runs the cases of a plan into OUT/<case>/, as `run` does, and judges each. A case whose detector fails, or
/// whose process dies, is an error of its own; the others go on. What was done is kept until
/// `kept.discard()`.
/// @param kept the store of OUT
/// @return one report a case, in the order of the plan
std::vector<CaseReport> run_suite(const SuitePlan& plan, const SuiteArguments& arguments,
                                  const std::filesystem::path& out, KeptDrives& kept);

}  // namespace stereobench::harness
