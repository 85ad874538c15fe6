/// Budgets for people and for programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/budget/budget_range.h"
#include "harness/budget/budget_search.h"

namespace stereobench::harness {

/// A budget and what it is of.
struct BudgetAnswer {
  BudgetMix mix;  ///< one line, or several that get worse together
  Budget budget;
};

/// Budgets of one metric in one scenario. Each has the confidence for itself.
struct BudgetStudy {
  std::string scenario;  ///< name
  Gate limit;
  WorldShare wanted;
  double tolerance = 0.02;           ///< that budget_levels was given
  std::vector<std::uint64_t> seeds;  ///< of all answers
  std::vector<BudgetAnswer> answers;
};

/// "filters.smoother.ate_rms_m <= 0.05"
std::string limit_in_words(const Gate& limit);

/// "up to 0.62", "up to 0.45 of the way", "up to 2, the end of the range" or "no budget".
std::string budget_in_short(const BudgetAnswer& answer);

/// The answer in a sentence or two: how bad it may get, in which share of worlds, with which confidence, and
/// on how many seeds this rests.
std::string budget_sentence(const BudgetStudy& study, const BudgetAnswer& answer);

/// A row an answer: the level, the next one, the seeds that fail at the level, the runs.
std::string budget_table(const BudgetStudy& study);

/// Lines that begin with "warning: ": seeds that are not monotone; seeds without a value at the level.
std::string budget_warnings(const BudgetStudy& study);

/// The content of budget.json: the question, and each answer with all its runs.
nlohmann::ordered_json budget_json(const BudgetStudy& study);

}  // namespace stereobench::harness
