/// A picture of whose an error is: from the error there is down to the bound, a step a part.
#pragma once

#include <string>

#include "harness/attribution/attribution.h"

namespace stereobench::harness {

/// Draws a waterfall for each filter that has a metric: a bar a part, as high as its share, with the share's
/// 95 % interval.
/// @param metric e.g. "ate_rms_m"
/// @return the bytes of a PNG file
std::string draw_waterfalls(const Attribution& attribution, const std::string& metric);

}  // namespace stereobench::harness
