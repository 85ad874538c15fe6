/// What `test` leaves for `bless`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/suite/baseline.h"

namespace stereobench::harness {

/// The verdicts of a test; written last of all.
inline constexpr const char* kTestResult = "test.json";

/// Where a test's suite and baseline are. Nothing that is compared knows of it.
struct TestPlaces {
  std::filesystem::path suite;
  std::filesystem::path baseline;
};

/// Writes them beside the result, absolute.
void write_side_file(const std::filesystem::path& out, const TestPlaces& places);

/// @throws std::runtime_error where the file is missing or is not as `test` writes it
TestPlaces read_side_file(const std::filesystem::path& out);

/// A metric that did not pass.
struct TestedMetric {
  std::string name;
  std::string verdict;
  double before = 0.0;  ///< means; NaN where there is none
  double now = 0.0;
};

/// A case of a test that has ended.
struct TestedCase {
  std::string name;
  std::string verdict;  ///< as of text_of(CaseState)
  BaselineInputs inputs;
  std::string error;
  std::string partial;  ///< see CaseReport
  std::size_t broken_gates = 0;
  std::vector<TestedMetric> changes;
};

/// The cases of a test.
/// @throws std::runtime_error where there is no test.json: the test did not end
std::vector<TestedCase> read_test_result(const std::filesystem::path& out);

}  // namespace stereobench::harness
