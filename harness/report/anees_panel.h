/// How consistent each filter's covariance was, over time.
#pragma once

#include <string>
#include <vector>

#include "harness/report/axes.h"

namespace stereobench::harness {

/// One filter's normalised errors over its degrees of freedom, over all runs at each instant.
struct AneesCurve {
  std::string filter;
  std::vector<double> anees;  ///< NaN where there is none
};

struct AneesPanel {
  std::vector<AneesCurve> filters;
  std::vector<double>
      low;  ///< between these two 95 % of consistent ones lie, at each instant; NaN where unknown
  std::vector<double> high;

  /// @return whether there is anything to draw
  bool any() const;
};

/// Draws the curves on a logarithmic axis, the band of consistent ones behind them.
/// @param time its axis and the instants that the curves are aligned with
void draw_anees_panel(Canvas& canvas, const AneesPanel& panel, const Axis& time,
                      const std::vector<double>& time_s, const Box& plot);

}  // namespace stereobench::harness
