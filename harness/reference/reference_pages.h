/// The pages of the guide that list every key, made of the keys' declarations.
#pragma once

#include <string>

namespace stereobench::harness {

/// docs/guide/scenario_reference.md: the keys of scenario files, a table a group.
std::string scenario_reference();

/// docs/guide/metrics_reference.md: the keys of run.json, a table a group.
std::string metrics_reference();

/// docs/guide/faults_reference.md: the named faults and what their severities are, a table a group.
std::string faults_reference();

}  // namespace stereobench::harness
