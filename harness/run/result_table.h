/// The tables that people see at the end of a run.
#pragma once

#include <string>

#include "harness/run/run_result.h"

namespace stereobench::harness {

/// Vision in a line, what the detector's faults did in another, each filter beside the filtering bound and
/// the batch beside the smoothing bound, how far filters know their own errors, what they repaired or
/// refused, and, where identities are not known, how they told landmarks apart.
std::string result_table(const RunResult& result);

}  // namespace stereobench::harness
