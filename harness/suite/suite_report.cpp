#include "harness/suite/suite_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/regression/verdict_report.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using Outcome = JunitCase::Outcome;

constexpr const char* kBaselineName = "baseline";
constexpr const char* kNowName = "now";

std::string count_cell(const CaseReport& report, Verdict verdict) {
  if (!report.judgement) return "-";
  const auto& metrics = report.judgement->comparison.metrics;
  return fmt::format("{}", std::ranges::count(metrics, verdict, &MetricVerdict::verdict));
}

std::string seeds_cell(const CaseReport& report) {
  if (!report.judgement) return "-";
  return fmt::format("{}", report.judgement->comparison.seeds.size());
}

AlignedTable table_of(const std::vector<CaseReport>& cases) {
  AlignedTable table{.header = {"case", "verdict", "metrics", "seeds", "worse", "vanished", "inconclusive",
                                "better", "gates broken", "pictures changed"}};
  for (const CaseReport& report : cases)
    table.rows.push_back(
        {report.name, text_of(state_of(report)),
         report.judgement ? fmt::format("{}", report.judgement->comparison.metrics.size()) : "-",
         seeds_cell(report), count_cell(report, Verdict::kRegressed), count_cell(report, Verdict::kVanished),
         count_cell(report, Verdict::kInconclusive), count_cell(report, Verdict::kImproved),
         fmt::format("{} of {}", report.broken_gates.size(), report.gates),
         fmt::format("{} of {}", std::ranges::count(report.pictures, false, &PictureRecord::is_as_before),
                     report.pictures.size())});
  return table;
}

Json looks_json(const CaseReport& report) {
  Json looks = Json::array();
  for (const LookRecord& look : report.looks)
    looks.push_back({{"seeds", look.seeds}, {"alpha", look.alpha}, {"inconclusive", look.inconclusive}});
  return looks;
}

Json case_json(const CaseReport& report) {
  Json pictures = Json::array();
  for (const PictureRecord& picture : report.pictures)
    pictures.push_back({{"name", picture.name}, {"as_before", picture.is_as_before}, {"text", picture.text}});
  Json json = {{"name", report.name},
               {"verdict", text_of(state_of(report))},
               {"inputs",
                {{"sha256", report.inputs.sha256},
                 {"pixels", report.inputs.pixels},
                 {"detector", report.inputs.detector}}},
               {"error", report.error},
               {"partial", report.partial},
               {"not_compared", report.not_compared},
               {"gates", report.gates},
               {"broken_gates", report.broken_gates},
               {"looks", looks_json(report)},
               {"pictures", pictures},
               {"comparison", nullptr},
               {"detections", nullptr}};
  if (!report.judgement) return json;
  json["comparison"] = verdict_json(report.judgement->comparison, report.settings, {kBaselineName, kNowName});
  if (report.judgement->changes) json["detections"] = changes_json(*report.judgement->changes);
  return json;
}

std::vector<JunitCase> tests_of(const CaseReport& report) {
  if (!report.error.empty()) return {{"run", Outcome::kError, "ERROR", report.error}};
  std::vector<JunitCase> tests = {{"run"}};
  if (!report.not_compared.empty())
    tests.push_back({"baseline", Outcome::kError, "NO BASELINE", report.not_compared});
  for (std::size_t i = 0; i < report.broken_gates.size(); ++i)
    tests.push_back({fmt::format("gate {}", i + 1), Outcome::kFailed, "GATE", report.broken_gates[i]});
  for (const PictureRecord& picture : report.pictures)
    tests.push_back(
        {picture.name, picture.is_as_before ? Outcome::kPassed : Outcome::kFailed, "PICTURE", picture.text});
  if (!report.judgement) return tests;
  for (const JunitCase& metric : junit_cases(report.judgement->comparison)) tests.push_back(metric);
  return tests;
}

}  // namespace

std::string remarks(const CaseReport& report) {
  std::string text;
  if (!report.error.empty()) text += report.error + "\n";
  if (!report.not_compared.empty()) text += report.not_compared + "\n";
  if (!report.not_compared.empty() && !report.measured.empty()) text += "now: " + report.measured + "\n";
  if (!report.partial.empty()) text += "partial: " + report.partial + "; bless refuses such a result\n";
  for (const std::string& gate : report.broken_gates) text += "gate broken: " + gate + "\n";
  for (const PictureRecord& picture : report.pictures)
    if (!picture.is_as_before) text += picture.name + ": " + picture.text + "\n";
  if (report.judgement) text += few_seeds_warning(report.judgement->comparison, report.settings);
  for (const LookRecord& look : report.looks)
    text += fmt::format("look at {} seeds, alpha {:.2g}: {} inconclusive\n", look.seeds, look.alpha,
                        look.inconclusive);
  return text;
}

std::string suite_text(const std::vector<CaseReport>& cases, const std::filesystem::path& out) {
  std::string text = plain_text(table_of(cases));
  for (const CaseReport& report : cases) {
    if (state_of(report) == CaseState::kPassed && report.partial.empty()) continue;
    text += fmt::format("\n{}: {}\n{}", report.name, text_of(state_of(report)), remarks(report));
    if (report.judgement)
      text += "A is the baseline, B is now\n" +
              detection_lines(*report.judgement, (out / report.name).string()) + "\n" +
              verdict_table(report.judgement->comparison, report.settings, false);
  }
  return text;
}

std::string suite_page(const std::string& suite, const std::vector<CaseReport>& cases,
                       const std::filesystem::path& out) {
  std::string page = fmt::format("## {}\n\n{}", suite, markdown(table_of(cases)));
  for (const CaseReport& report : cases) {
    if (state_of(report) == CaseState::kPassed && report.partial.empty()) continue;
    const std::string lines = remarks(report);
    page += fmt::format("\n## {}: {}\n\n", report.name, text_of(state_of(report)));
    if (!lines.empty()) page += "```text\n" + lines + "```\n\n";
    if (report.judgement)
      page += verdict_page(report.judgement->comparison, report.settings, {kBaselineName, kNowName},
                           detection_lines(*report.judgement, (out / report.name).string()), false);
  }
  return page;
}

Json suite_json(const std::string& suite, const std::vector<CaseReport>& cases) {
  Json list = Json::array();
  for (const CaseReport& report : cases) list.push_back(case_json(report));
  return {{"schema", 1}, {"suite", suite}, {"cases", list}};
}

std::vector<JunitSuite> suite_junit(const std::string& suite, const std::vector<CaseReport>& cases) {
  std::vector<JunitSuite> suites;
  for (const CaseReport& report : cases)
    suites.push_back(
        {suite + "." + report.name, tests_of(report), report.judgement ? report.judgement->detections : ""});
  return suites;
}

}  // namespace stereobench::harness
