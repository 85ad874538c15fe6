/// Verdicts as JUnit's XML, which GitLab, Jenkins and GitHub's actions read.
#pragma once

#include <string>
#include <vector>

#include "harness/regression/verdict.h"

namespace stereobench::harness {

/// One test case.
struct JunitCase {
  enum class Outcome { kPassed, kFailed, kError, kSkipped };
  std::string name;
  Outcome outcome = Outcome::kPassed;
  std::string type;  ///< of a failure, e.g. "REGRESSED"
  std::string text;  ///< why, with figures
};

/// Test cases that belong together.
struct JunitSuite {
  std::string name;
  std::vector<JunitCase> cases;
  std::string output;  ///< what the suite has to say as a whole; may be empty
};

/// One test case a metric: REGRESSED and VANISHED are failures, INCONCLUSIVE is skipped; all say by how much.
std::vector<JunitCase> junit_cases(const ResultComparison& comparison);

/// The XML. There is no time in it: equal results give equal bytes.
std::string junit_xml(const std::vector<JunitSuite>& suites);

}  // namespace stereobench::harness
