/// What charts share besides axes: each filter's look, the marks, and the legend that explains them.
#pragma once

#include <string>
#include <vector>

#include "harness/report/canvas.h"

namespace stereobench::harness {

inline constexpr Colour kBlack = {0.0, 0.0, 0.0, 1.0};
inline constexpr Colour kGrey = {0.5, 0.5, 0.5, 1.0};

/// @return the filter's line: always the same for a name, told apart by the colour-blind (colours of Okabe
/// and Ito); dead reckoning is grey and dashed
Stroke filter_stroke(const std::string& filter);

/// @return the filter's name as people write it, e.g. "FastSLAM 2.0"; the name itself when it is not known
std::string filter_title(const std::string& filter);

/// Draws a disc with a thin dark rim.
void draw_disc(Canvas& canvas, const Point& centre, double radius_px, const Colour& colour);

/// Draws a diagonal cross.
void draw_cross(Canvas& canvas, const Point& centre, double arm_px, const Stroke& stroke);

enum class Mark { kLine, kDisc, kCross, kEllipse, kStart };

struct LegendEntry {
  std::string text;
  std::string detail = {};  ///< a second line, smaller; may be empty
  Mark mark = Mark::kLine;
  Stroke stroke = {};
};

/// Writes the entries below each other, marks to their left. @param at top left corner
void draw_legend(Canvas& canvas, const Point& at, const std::vector<LegendEntry>& entries);

/// @return how wide the legend is drawn
double legend_width_px(const Canvas& canvas, const std::vector<LegendEntry>& entries);

/// @param left_px where the legend begins
/// @return width of a chart that ends with its legend: 1000, or more where names are long
int chart_width_px(double left_px, const std::vector<LegendEntry>& entries);

/// Draws a triangle that points in a direction. @param heading_rad counter-clockwise from the right
void draw_arrowhead(Canvas& canvas, const Point& centre, double heading_rad, const Colour& colour);

}  // namespace stereobench::harness
