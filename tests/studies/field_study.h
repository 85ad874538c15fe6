/// Balls among things that look like balls, under a white balance that is off.
#pragma once

#include <vector>

#include "tests/studies/verdict.h"

namespace stereobench {

/// Drives through fields of 40 balls with anything on walls and floor, any light, boxes about, and boxes and
/// balls of nearly a palette colour among them.
/// @param fields of which four worlds are drawn each
std::vector<Section> study_fields(int fields, int jobs);

}  // namespace stereobench
