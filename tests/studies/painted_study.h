/// What painted pictures tell, an independent painter's: the S-curve, and balls that are hidden in part.
#pragma once

#include <vector>

#include "tests/studies/verdict.h"

namespace stereobench {

/// Errors of centres and disparities, mean over all colours without noise, by their phase between the pixels.
Section study_phases(int jobs);

/// Balls of which 10 to 70 % are hidden, by an edge, a ball or the border, and both cameras see 120 degrees
/// of arc: their ranges are right to 5 mm at 3 m, or they are flagged.
Section study_hidden_balls(int jobs);

}  // namespace stereobench
