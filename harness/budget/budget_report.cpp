#include "harness/budget/budget_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"
#include "harness/page/command_words.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

const char* relation_of(const Gate& limit) {
  return limit.relation == Gate::Relation::kAtMost ? "<=" : ">=";
}

/// Whether more is worse; so it is for fractions of a mix.
bool rises(const BudgetMix& mix) {
  return mix.size() > 1 || mix.front().high > mix.front().low;
}

/// "none may fail" or "3 may fail"
std::string may_fail(long seeds) {
  return seeds == 0 ? "none may fail" : fmt::format("{} may fail", seeds);
}

/// "and none does", "and 1 does" or "and 3 do"
std::string do_fail(long seeds) {
  return seeds == 0 ? "and none does" : fmt::format("and {} do{}", seeds, seeds == 1 ? "es" : "");
}

/// What an answer rests on: the seeds, and the next level.
std::string basis(const BudgetStudy& study, const Budget& budget) {
  const std::string seeds = fmt::format("Of {} seeds {}, {}. ", study.seeds.size(), may_fail(budget.may_fail),
                                        do_fail(budget.failing));
  return seeds + (budget.fails_at ? fmt::format("At {} too many fail.", *budget.fails_at)
                                  : "Nothing worse was tried.");
}

std::string outcome_word(BudgetOutcome outcome) {
  if (outcome == BudgetOutcome::kNone) return "none";
  return outcome == BudgetOutcome::kFound ? "found" : "whole range";
}

std::vector<std::string> table_row(const BudgetAnswer& answer, std::size_t seeds) {
  const Budget& budget = answer.budget;
  const bool is_none = budget.outcome == BudgetOutcome::kNone;
  return {name_of(answer.mix),
          is_none ? "-" : fmt::format("{}{}", budget.level, answer.mix.size() == 1 ? "" : " of the way"),
          is_none           ? fmt::format("{}", budget.level)
          : budget.fails_at ? fmt::format("{}", *budget.fails_at)
                            : "-",
          fmt::format("{} of {}", budget.failing, seeds),
          fmt::format("{}", budget.runs.size()),
          fmt::format("{}", budget.grid_runs)};
}

/// Seeds as --seeds reads them, or only how many where there are many.
std::string seeds_in_short(const std::vector<std::uint64_t>& seeds) {
  constexpr std::size_t kMost = 10;
  if (seeds.size() > kMost) return fmt::format("{} seeds", seeds.size());
  return fmt::format("seed{} {}", seeds.size() == 1 ? "" : "s", seeds_word(seeds));
}

Json values_json(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

Json mix_json(const BudgetAnswer& answer) {
  Json keys = Json::array();
  for (const BudgetRange& range : answer.mix)
    keys.push_back({{"key", range.key},
                    {"low", range.low},
                    {"high", range.high},
                    {"value", value_at(answer.mix, range, answer.budget.level)}});
  return keys;
}

Json answer_json(const BudgetStudy& study, const BudgetAnswer& answer) {
  const Budget& budget = answer.budget;
  Json runs = Json::array();
  for (const BudgetRun& run : budget.runs)
    runs.push_back({{"level", run.level}, {"seed", run.seed}, {"value", number(run.value)}});
  return {{"keys", mix_json(answer)},
          {"outcome", outcome_word(budget.outcome)},
          {"level", budget.level},
          {"fails_at", budget.fails_at ? Json(*budget.fails_at) : Json(nullptr)},
          {"says", budget_sentence(study, answer)},
          {"may_fail", budget.may_fail},
          {"failing", budget.failing},
          {"values", values_json(budget.values)},
          {"not_monotone", budget.not_monotone},
          {"grid_runs", budget.grid_runs},
          {"runs", std::move(runs)}};
}

}  // namespace

std::string limit_in_words(const Gate& limit) {
  return fmt::format("{} {} {}", limit.metric, relation_of(limit), limit.limit);
}

std::string budget_in_short(const BudgetAnswer& answer) {
  const auto& [mix, budget] = answer;
  if (budget.outcome == BudgetOutcome::kNone) return "no budget";
  return fmt::format("{} {}{}{}", rises(mix) ? "up to" : "down to", budget.level,
                     mix.size() == 1 ? "" : " of the way",
                     budget.outcome == BudgetOutcome::kWholeRange ? ", the end of the range" : "");
}

std::string budget_sentence(const BudgetStudy& study, const BudgetAnswer& answer) {
  const auto& [mix, budget] = answer;
  const bool is_one = mix.size() == 1;
  const std::string values =
      is_one ? "" : fmt::format(" ({})", fmt::join(overrides_at(mix, budget.level), ", "));
  const std::string limit = limit_in_words(study.limit);
  if (budget.outcome == BudgetOutcome::kNone)
    return fmt::format("{} {} {}: {} is broken by {} of {} seeds at {}{} already, and {}.", name_of(mix),
                       is_one ? "has" : "together have", budget_in_short(answer), limit, budget.failing,
                       study.seeds.size(), budget.level, values, may_fail(budget.may_fail));
  return fmt::format("{} may {} {}{}: {} in {}. {}", name_of(mix), is_one ? "be" : "together go",
                     budget_in_short(answer), values, limit, in_words(study.wanted), basis(study, budget));
}

std::string budget_table(const BudgetStudy& study) {
  AlignedTable table{
      .header = {"may get worse", "up to", "fails at", "seeds that fail", "runs", "full grid"}};
  for (const BudgetAnswer& answer : study.answers)
    table.rows.push_back(table_row(answer, study.seeds.size()));
  return plain_text(table);
}

std::string budget_warnings(const BudgetStudy& study) {
  std::string warnings;
  for (const auto& [mix, budget] : study.answers) {
    const auto without = std::ranges::count_if(budget.values, [](double value) { return std::isnan(value); });
    if (!budget.not_monotone.empty())
      warnings += fmt::format(
          "warning: {}: {} kept the limit at a worse level than one at which they broke it; the bound takes "
          "worse levels to be worse for all\n",
          name_of(mix), seeds_in_short(budget.not_monotone));
    if (without > 0)
      warnings += fmt::format("warning: {}: {} of {} seeds have no {} at {}, and count as failed\n",
                              name_of(mix), without, study.seeds.size(), study.limit.metric, budget.level);
  }
  return warnings;
}

Json budget_json(const BudgetStudy& study) {
  Json answers = Json::array();
  for (const BudgetAnswer& answer : study.answers) answers.push_back(answer_json(study, answer));
  return {{"schema", 1},
          {"scenario", study.scenario},
          {"metric", study.limit.metric},
          {"relation", relation_of(study.limit)},
          {"limit", study.limit.limit},
          {"share", study.wanted.share},
          {"confidence", study.wanted.confidence},
          {"tolerance", study.tolerance},
          {"seeds", study.seeds},
          {"budgets", std::move(answers)}};
}

}  // namespace stereobench::harness
