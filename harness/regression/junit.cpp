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

/// XML has no way to write most control characters.
std::string writable(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c >= 0 && c < ' ' && c != '\n' && c != '\t'; }, '?');
  return text;
}

bool is_failure(Verdict verdict) {
  return verdict == Verdict::kRegressed || verdict == Verdict::kVanished;
}

ptree test_case(const MetricVerdict& metric, const std::string& suite) {
  ptree test;
  test.put("<xmlattr>.classname", suite);
  test.put("<xmlattr>.name", metric.metric);
  const std::string line = fmt::format("{}: {}", text_of(metric.verdict), change_line(metric));
  if (is_failure(metric.verdict)) {
    test.put("failure", line);
    test.put("failure.<xmlattr>.type", text_of(metric.verdict));
    test.put("failure.<xmlattr>.message", line);
  } else if (metric.verdict == Verdict::kInconclusive) {
    test.put("skipped.<xmlattr>.message", line);
  }
  return test;
}

}  // namespace

std::string junit_xml(const ResultComparison& comparison, const std::string& suite,
                      const std::string& detections) {
  const std::string name = writable(suite);
  ptree cases;
  cases.put("<xmlattr>.name", name);
  cases.put("<xmlattr>.tests", comparison.metrics.size());
  cases.put("<xmlattr>.failures",
            std::ranges::count_if(comparison.metrics, is_failure, &MetricVerdict::verdict));
  cases.put("<xmlattr>.errors", 0);
  cases.put("<xmlattr>.skipped",
            std::ranges::count(comparison.metrics, Verdict::kInconclusive, &MetricVerdict::verdict));
  for (const MetricVerdict& metric : comparison.metrics) cases.add_child("testcase", test_case(metric, name));
  if (!detections.empty()) cases.put("system-out", writable(detections));
  ptree document;
  document.add_child("testsuites.testsuite", cases);
  std::ostringstream xml;
  boost::property_tree::write_xml(xml, document,
                                  boost::property_tree::xml_writer_settings<std::string>(' ', 2));
  return xml.str() + "\n";
}

}  // namespace stereobench::harness
