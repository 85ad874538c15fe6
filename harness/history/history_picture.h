/// Metrics over results as a picture: their means, with the steps marked.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "harness/history/history.h"

namespace stereobench::harness {

/// The metrics that are worth a look: those with steps, the worst first; then those that changed.
/// @param most how many at most; more than fit on a sheet (12) are cut
std::vector<const MetricHistory*> metrics_to_draw(const History& history, std::size_t most);

/// Draws a panel for each metric: its mean at each result as dots, its level between steps as lines, and the
/// steps, red where it got worse, green where it got better, grey within the margin.
/// @param metrics one or more, of as many results each
/// @return the bytes of a PNG file
std::string draw_history_picture(const std::string& title, const std::vector<const MetricHistory*>& metrics);

}  // namespace stereobench::harness
