/// A budget as a picture: what each run gave, and where the limit is.
#pragma once

#include <string>

#include "harness/budget/budget_report.h"

namespace stereobench::harness {

/// Draws a panel for each answer: the metric over the level, a disc for each run, the limit across and the
/// budget upright. A run without a value is a cross at the top. The level's axis is logarithmic where the
/// budget is a small part of the range; levels of zero are then left out.
/// @param study with one answer or more, of 8 the rest is cut
/// @return the bytes of a PNG file
std::string draw_budget_picture(const BudgetStudy& study);

}  // namespace stereobench::harness
