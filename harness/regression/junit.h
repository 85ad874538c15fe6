/// Verdicts as JUnit's XML, which GitLab, Jenkins and GitHub's actions read.
#pragma once

#include <string>

#include "harness/regression/verdict.h"

namespace stereobench::harness {

/// A test suite with one test case a metric. REGRESSED and VANISHED are failures, INCONCLUSIVE is skipped;
/// all say by how much. There is no time in it: equal results give equal bytes.
/// @param suite its name, e.g. that of the scenario
/// @param detections what changes_text() says: the suite's output
std::string junit_xml(const ResultComparison& comparison, const std::string& suite,
                      const std::string& detections);

}  // namespace stereobench::harness
