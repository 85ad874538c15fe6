/// A suite's cases for people and for programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/regression/junit.h"
#include "harness/suite/case_report.h"

namespace stereobench::harness {

/// What is to be said of a case beside its metrics and detections, a line each; may be empty.
std::string remarks(const CaseReport& report);

/// A table with one row a case, and below it what is to be said of those that did not pass.
/// @param out the folder of the results, for commands, and so below
std::string suite_text(const std::vector<CaseReport>& cases, const std::filesystem::path& out);

/// The same as a page for pull requests, in Markdown.
std::string suite_page(const std::string& suite, const std::vector<CaseReport>& cases,
                       const std::filesystem::path& out);

/// The content of test.json: no time, path or host in it.
nlohmann::ordered_json suite_json(const std::string& suite, const std::vector<CaseReport>& cases);

/// One JUnit suite a case, with a test case a metric, a gate, a picture; a case that broke down is one error.
std::vector<JunitSuite> suite_junit(const std::string& suite, const std::vector<CaseReport>& cases);

}  // namespace stereobench::harness
