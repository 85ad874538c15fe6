#include "harness/regression_commands/suite_page.h"

#include <sstream>

#include <fmt/format.h>

#include "harness/io/atomic_file.h"
#include "harness/page/command_words.h"
#include "harness/regression/result_folder.h"
#include "harness/result_pages/comparison_page.h"
#include "harness/result_pages/run_page.h"
#include "harness/suite/findings_file.h"
#include "harness/suite/suite_report.h"

namespace stereobench::harness {
namespace {

CellMark mark_of_case(CaseState state) {
  switch (state) {
    case CaseState::kError:
    case CaseState::kRegressed:
    case CaseState::kGateBroken:
    case CaseState::kPictureChanged:
      return mark_of(Verdict::kRegressed);
    case CaseState::kNoBaseline:
    case CaseState::kInconclusive:
      return mark_of(Verdict::kInconclusive);
    case CaseState::kImproved:
      return mark_of(Verdict::kImproved);
    case CaseState::kPassed:
      break;
  }
  return mark_of(Verdict::kPass);
}

void append_lines(const std::string& text, std::vector<std::string>& lines) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
}

/// What is to be said of a case beside its metrics.
Block remarks_block(const CaseReport& report, const std::optional<Baseline>& baseline,
                    const std::vector<std::string>& words) {
  PageText text;
  append_lines(remarks(report), text.lines);
  if (baseline)
    text.lines.push_back(fmt::format("the baseline was blessed because: {}", baseline->blessing.reason));
  return {.title = "Case",
          .note = report.error.empty()
                      ? fmt::format("{}/report.html shows its maps, errors over time and worst frames.",
                                    report.name)
                      : "It has no result.",
          .commands = words.empty() ? std::vector<std::string>() : std::vector{shell_line(words)},
          .content = std::move(text)};
}

std::optional<DetectedBalls> findings_of(const std::filesystem::path& file, const CaseReport& report) {
  if (!report.judgement->changes) return {};
  return read_findings(file);
}

ComparedCase compared_case(const SuitePlan& plan, const PlannedCase& planned,
                           const std::filesystem::path& out, const CaseReport& report) {
  const CaseState state = state_of(report);
  ComparedCase compared{.name = report.name, .verdict = text_of(state), .mark = mark_of_case(state)};
  compared.says = !report.error.empty()          ? report.error
                  : !report.not_compared.empty() ? report.not_compared
                  : report.judgement             ? verdict_summary(report.judgement->comparison)
                                                 : "";
  if (report.judgement && report.judgement->changes)
    compared.reason = slices_text(*report.judgement->changes);
  compared.blocks.push_back(remarks_block(report, planned.baseline, planned.arguments.run.words));
  if (!report.judgement) return compared;
  const StoredResult before{.scenario = planned.baseline->scenario, .seeds = planned.baseline->seeds};
  const StoredResult now = read_result(out / report.name);
  for (Block& block : comparison_blocks({.names = {"baseline", "now"},
                      .first = before,
                      .second = now,
                      .comparison = report.judgement->comparison,
                      .settings = report.settings,
                      .changes = report.judgement->changes,
                      .findings = findings_of(findings_file(plan.baseline, report.name), report)}))
    compared.blocks.push_back(std::move(block));
  return compared;
}

}  // namespace

void write_suite_page(const SuitePlan& plan, const std::filesystem::path& out,
                      const std::vector<CaseReport>& reports, const std::vector<std::string>& words) {
  std::vector<ComparedCase> cases;
  for (std::size_t i = 0; i < reports.size(); ++i)
    cases.push_back(compared_case(plan, plan.cases[i], out, reports[i]));
  const std::vector<std::string> facts = {fmt::format("{} cases", cases.size()), "A: the baseline", "B: now",
                                          shell_line(words)};
  write_file_atomically(out / kReport, page_html(cases_page(plan.suite.name, facts, std::move(cases))));
}

}  // namespace stereobench::harness
