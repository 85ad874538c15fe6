#include "harness/budget/budget_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/page/command_words.h"

namespace stereobench::harness {
namespace {

PageCell numeric_cell(double value) {
  return {.text = format_number(value, 4), .number = value};
}

PageCell exact_cell(double value) {
  return {.text = fmt::format("{}", value), .number = value};
}

/// Sentences, then warnings.
Block answers_in_words(const BudgetStudy& study) {
  PageText text;
  for (const BudgetAnswer& answer : study.answers) text.lines.push_back(budget_sentence(study, answer));
  std::istringstream warnings(budget_warnings(study));
  for (std::string line; std::getline(warnings, line);) text.lines.push_back(line);
  return {.title = "Answer",
          .note = study.answers.size() > 1 ? "Each answer has the confidence for itself." : "",
          .content = std::move(text)};
}

Block budgets_block(const BudgetStudy& study) {
  PageTable table{.header = {"may get worse", "up to", "fails at", "seeds that fail", "may fail", "runs",
                             "runs of a full grid"}};
  for (const auto& [mix, budget] : study.answers) {
    const bool is_none = budget.outcome == BudgetOutcome::kNone;
    const auto fails_at = is_none ? std::optional(budget.level) : budget.fails_at;
    table.rows.push_back({{{.text = name_of(mix)},
                           is_none ? PageCell{.text = "-", .mark = CellMark::kBad} : exact_cell(budget.level),
                           fails_at ? exact_cell(*fails_at) : PageCell{.text = "-"},
                           exact_cell(static_cast<double>(budget.failing)),
                           exact_cell(static_cast<double>(budget.may_fail)),
                           exact_cell(static_cast<double>(budget.runs.size())),
                           exact_cell(static_cast<double>(budget.grid_runs))}});
  }
  const bool has_mix =
      std::ranges::any_of(study.answers, [](const auto& answer) { return answer.mix.size() > 1; });
  return {.title = "Budgets",
          .note = has_mix
                      ? "A level of several lines is the fraction of the way from the good to the bad end "
                        "of each."
                      : "",
          .content = std::move(table)};
}

/// The runs that keep the limit, or those that break it.
Series runs_series(const Gate& limit, const Budget& budget, bool keeps) {
  Series series{.name = keeps ? "keeps the limit" : "breaks the limit", .look = Look::kPoints};
  for (const BudgetRun& run : budget.runs) {
    if (keeps_limit(limit, run.value) != keeps) continue;
    series.x.push_back(run.level);
    series.y.push_back(run.value);
  }
  return series;
}

Chart chart_of_budget(const BudgetStudy& study, const BudgetAnswer& answer) {
  const Budget& budget = answer.budget;
  Chart chart{.name = name_of(answer.mix), .x_label = name_of(answer.mix), .y_label = study.limit.metric};
  chart.series = {runs_series(study.limit, budget, true), runs_series(study.limit, budget, false)};
  const auto [least, most] = std::ranges::minmax(budget.runs, {}, &BudgetRun::level);
  chart.series.push_back({.name = "limit",
                          .look = Look::kDashes,
                          .x = {least.level, most.level},
                          .y = {study.limit.limit, study.limit.limit}});
  if (budget.outcome == BudgetOutcome::kNone) return chart;
  std::vector<double> values = {study.limit.limit};
  for (const BudgetRun& run : budget.runs)
    if (std::isfinite(run.value)) values.push_back(run.value);
  const auto [lowest, highest] = std::ranges::minmax(values);
  chart.series.push_back({.name = "budget", .x = {budget.level, budget.level}, .y = {lowest, highest}});
  return chart;
}

Block charts_block(const BudgetStudy& study) {
  PageCharts charts;
  for (const BudgetAnswer& answer : study.answers) charts.charts.push_back(chart_of_budget(study, answer));
  return {.title = study.limit.metric + " against the level",
          .note = "A point is a run: one seed at one level.",
          .content = std::move(charts)};
}

/// One row a seed, one column an answer.
Block seeds_block(const BudgetStudy& study) {
  PageTable table{.header = {"seed"}};
  for (const BudgetAnswer& answer : study.answers)
    table.header.push_back(fmt::format("{} at {}", name_of(answer.mix), answer.budget.level));
  for (std::size_t i = 0; i < study.seeds.size(); ++i) {
    PageRow row{.cells = {{.text = fmt::format("{}", study.seeds[i]),
                           .number = static_cast<double>(study.seeds[i])}}};
    for (const BudgetAnswer& answer : study.answers) {
      const double value = answer.budget.values.at(i);
      row.cells.push_back(numeric_cell(value));
      row.cells.back().mark = keeps_limit(study.limit, value) ? CellMark::kGood : CellMark::kBad;
    }
    table.rows.push_back(std::move(row));
  }
  return {.title = "Seeds at the budget",
          .note = study.limit.metric + " of each seed; green keeps the limit.",
          .content = std::move(table)};
}

}  // namespace

Page budget_page(const BudgetStudy& study, std::span<const std::string> words) {
  Page page{.title = study.scenario + ": budget",
            .facts = {limit_in_words(study.limit), "in " + in_words(study.wanted),
                      fmt::format("seed{} {}", study.seeds.size() == 1 ? "" : "s", seeds_word(study.seeds)),
                      fmt::format("stereobench {}", STEREOBENCH_VERSION)}};
  page.blocks = {answers_in_words(study), charts_block(study), budgets_block(study), seeds_block(study)};
  if (words.empty()) return page;
  std::vector<std::string> line(words.begin(), words.end());
  line.insert(line.end(), {"--seeds", seeds_word(study.seeds)});
  for (Block& block : page.blocks) block.commands = {shell_line(line)};
  return page;
}

}  // namespace stereobench::harness
