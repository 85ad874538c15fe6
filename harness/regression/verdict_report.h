/// Verdicts for people and for programs.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "harness/regression/verdict.h"

namespace stereobench::harness {

/// Who is compared, for titles.
struct ComparedNames {
  std::string first = "A";
  std::string second = "B";
};

/// One line of a metric: both means, by how much it is worse, and what that is held against.
std::string change_line(const MetricVerdict& metric);

/// "+12 [+8, +17] %": by how much a metric is worse, with its interval; "-" where that is not known.
std::string change_text(const MetricVerdict& metric);

/// "5 %": what that is held against.
std::string margin_text(const MetricVerdict& metric);

/// How many more seeds decide, or why there are no statistics; empty where there is nothing to say.
std::string note_text(const MetricVerdict& metric);

/// One line: how many metrics have which verdict, among how many comparisons.
std::string verdict_summary(const ResultComparison& comparison);

/// A table of the metrics that did not pass, worst verdict first, and what it rests on.
/// @param all whether metrics that passed are listed too, and more than ten INCONCLUSIVE ones
std::string verdict_table(const ResultComparison& comparison, const VerdictSettings& settings, bool all);

/// A line that begins with "warning: " where there are too few seeds for any verdict but PASS; else empty.
std::string few_seeds_warning(const ResultComparison& comparison, const VerdictSettings& settings);

/// The same as a page for pull requests, in Markdown.
/// @param detections what changes_text() says
std::string verdict_page(const ResultComparison& comparison, const VerdictSettings& settings,
                         const ComparedNames& names, const std::string& detections, bool all);

/// The verdicts for programs.
nlohmann::ordered_json verdict_json(const ResultComparison& comparison, const VerdictSettings& settings,
                                    const ComparedNames& names);

}  // namespace stereobench::harness
