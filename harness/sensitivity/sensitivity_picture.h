/// The indices of a study as bars.
#pragma once

#include <string>

#include "harness/sensitivity/sensitivity.h"

namespace stereobench::harness {

/// Two bars a factor, the first and the total index, with lines for their intervals. Factors are ordered by
/// total index, the largest at the top. What has no value has no bar.
/// @return the bytes of a PNG file
std::string draw_sensitivity_picture(const Sensitivity& study);

}  // namespace stereobench::harness
