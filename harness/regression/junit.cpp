#include "harness/regression/junit.h"

#include <algorithm>
#include <sstream>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>

#include "harness/regression/verdict_report.h"

namespace stereobench::harness {
namespace {

using boost::property_tree::ptree;
using Outcome = JunitCase::Outcome;

/// XML has no way to write most control characters.
std::string writable(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c >= 0 && c < ' ' && c != '\n' && c != '\t'; }, '?');
  return text;
}

Outcome outcome_of(Verdict verdict) {
  if (verdict == Verdict::kRegressed || verdict == Verdict::kVanished) return Outcome::kFailed;
  return verdict == Verdict::kInconclusive ? Outcome::kSkipped : Outcome::kPassed;
}

ptree test_case(const JunitCase& test, const std::string& suite) {
  ptree tree;
  tree.put("<xmlattr>.classname", suite);
  tree.put("<xmlattr>.name", writable(test.name));
  const std::string text = writable(test.text);
  if (test.outcome == Outcome::kFailed || test.outcome == Outcome::kError) {
    const std::string element = test.outcome == Outcome::kFailed ? "failure" : "error";
    tree.put(element, text);
    tree.put(element + ".<xmlattr>.type", test.type);
    tree.put(element + ".<xmlattr>.message", text.substr(0, text.find('\n')));
  } else if (test.outcome == Outcome::kSkipped) {
    tree.put("skipped.<xmlattr>.message", text);
  }
  return tree;
}

ptree test_suite(const JunitSuite& suite) {
  const std::string name = writable(suite.name);
  ptree tree;
  tree.put("<xmlattr>.name", name);
  tree.put("<xmlattr>.tests", suite.cases.size());
  for (const auto& [counted, outcome] :
       {std::pair("failures", Outcome::kFailed), {"errors", Outcome::kError}, {"skipped", Outcome::kSkipped}})
    tree.put(std::string("<xmlattr>.") + counted,
             std::ranges::count(suite.cases, outcome, &JunitCase::outcome));
  for (const JunitCase& test : suite.cases) tree.add_child("testcase", test_case(test, name));
  if (!suite.output.empty()) tree.put("system-out", writable(suite.output));
  return tree;
}

}  // namespace

std::vector<JunitCase> junit_cases(const ResultComparison& comparison) {
  std::vector<JunitCase> cases;
  for (const MetricVerdict& metric : comparison.metrics)
    cases.push_back({metric.metric, outcome_of(metric.verdict), text_of(metric.verdict),
                     fmt::format("{}: {}", text_of(metric.verdict), change_line(metric))});
  return cases;
}

std::string junit_xml(const std::vector<JunitSuite>& suites) {
  ptree document;
  ptree& all = document.add_child("testsuites", {});
  for (const JunitSuite& suite : suites) all.add_child("testsuite", test_suite(suite));
  std::ostringstream xml;
  boost::property_tree::write_xml(xml, document,
                                  boost::property_tree::xml_writer_settings<std::string>(' ', 2));
  return xml.str() + "\n";
}

}  // namespace stereobench::harness
