/// A sweep over one number as a response: errors over levels.
#pragma once

#include <optional>

#include "harness/response/response.h"
#include "harness/sweep/sweep_result.h"

namespace stereobench::harness {

/// The errors of a sweep over one number of the scenario, counted from 0 or, where the sweep is paired to a
/// value, from that: `believed_rig.baseline_m` has no level 0, but a right value.
/// @return none for other sweeps: of several keys, of words, of counts and severities, which are no amounts
/// of noise, of levels below 0 or out of order, of fewer than three, or of levels within a factor of two
std::optional<Response> response_of(const SweepResult& sweep);

}  // namespace stereobench::harness
