/// What charts and maps say, in words: for those who cannot see them, and for tests.
#pragma once

#include <string>

#include "harness/page/page.h"

namespace stereobench::harness {

/// The axes, and of each series how many points there are, the least, the greatest and the last value.
std::string text_alternative(const Chart& chart);

/// What is on the map, and how far each estimate is from the truth at the end.
std::string text_alternative(const PageMap& map);

}  // namespace stereobench::harness
