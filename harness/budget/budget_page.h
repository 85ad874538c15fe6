/// The page of budgets.
#pragma once

#include <span>
#include <string>

#include "harness/budget/budget_report.h"
#include "harness/page/page.h"

namespace stereobench::harness {

/// The answers in words and as a table; the metric over the level for each; what each seed gave at the
/// budget.
/// @param words of the command line, but for the seeds; empty: none is shown
Page budget_page(const BudgetStudy& study, std::span<const std::string> words);

}  // namespace stereobench::harness
