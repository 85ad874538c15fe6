/// Lines and areas over an axis of numbers.
#pragma once

#include <vector>

#include "harness/report/axes.h"

namespace stereobench::harness {

/// Draws y over x; the line is interrupted where a number cannot be drawn.
/// @param x and y as long as each other, or the longer is cut
void draw_curve(Canvas& canvas, const Axes& axes, const std::vector<double>& x, const std::vector<double>& y,
                const Stroke& stroke);

/// Fills between two curves, faintly; corners that cannot be drawn are left out.
/// @param low and high as long as x
void draw_band(Canvas& canvas, const Axes& axes, const std::vector<double>& x, const std::vector<double>& low,
               const std::vector<double>& high, Colour colour);

/// Draws an upright bar with caps from the low to the high end of an interval.
void draw_interval(Canvas& canvas, const Point& low, const Point& high, const Stroke& stroke);

}  // namespace stereobench::harness
