#include "harness/regression_commands/test_result.h"

#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/atomic_file.h"
#include "harness/io/json_file.h"
#include "harness/json/json_text.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaces = "places.json";
constexpr std::size_t kMostCases = 100'000;
constexpr std::size_t kMostMetrics = 1'000'000;

double number_or_nan(const JsonValue& value) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.number(-kLargest, kLargest);
}

std::vector<TestedMetric> changes_of(const JsonValue& comparison) {
  std::vector<TestedMetric> changes;
  if (comparison.is_null()) return changes;
  for (const JsonValue& metric : comparison.at("metrics").list(0, kMostMetrics)) {
    const std::string verdict = metric.at("verdict").text();
    if (verdict != text_of(Verdict::kPass))
      changes.push_back({metric.at("metric").text(), verdict, number_or_nan(metric.at("first_mean")),
                         number_or_nan(metric.at("second_mean"))});
  }
  return changes;
}

TestedCase case_of(const JsonValue& entry) {
  const JsonValue inputs = entry.at("inputs");
  return {.name = entry.at("name").text(),
          .verdict = entry.at("verdict").text(),
          .inputs = {inputs.at("sha256").text(), inputs.at("pixels").text(), inputs.at("detector").text()},
          .error = entry.at("error").text(),
          .partial = entry.at("partial").text(),
          .broken_gates = entry.at("broken_gates").list(0, kMostMetrics).size(),
          .changes = changes_of(entry.at("comparison"))};
}

}  // namespace

void write_side_file(const fs::path& out, const TestPlaces& places) {
  write_file_atomically(out / kPlaces, json_text({{"suite", fs::absolute(places.suite).string()},
                                                  {"baseline", fs::absolute(places.baseline).string()}}));
}

TestPlaces read_side_file(const fs::path& out) {
  return read_json_file(out / kPlaces, [](const JsonValue& places) {
    return TestPlaces{places.at("suite").text(), places.at("baseline").text()};
  });
}

std::vector<TestedCase> read_test_result(const fs::path& out) {
  const fs::path file = out / kTestResult;
  if (!fs::exists(file))
    throw std::runtime_error(fmt::format(
        "{}: expected a folder with a {}; `stereobench test` writes it last, so it did not end here",
        out.string(), kTestResult));
  return read_json_file(file, [](const JsonValue& test) {
    std::vector<TestedCase> cases;
    for (const JsonValue& entry : test.at("cases").list(1, kMostCases)) cases.push_back(case_of(entry));
    return cases;
  });
}

}  // namespace stereobench::harness
