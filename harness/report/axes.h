/// Axes: from numbers to pixels, with ticks, grid, labels and legend.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/report/canvas.h"

namespace stereobench::harness {

/// The numbers along one axis, low < high.
struct AxisRange {
  double low = 0.0;
  double high = 1.0;
};

enum class Scale { kLinear, kLog };

struct Axis {
  std::string label;     ///< with its unit
  AxisRange range = {};  ///< > 0 when logarithmic
  Scale scale = Scale::kLinear;
  std::vector<std::string> categories = {};  ///< when not empty: names of the values 0, 1, 2...
  bool has_zero = false;  ///< a logarithmic axis: 0 has a place before the range, and a break is drawn
};

/// @return the smallest range that holds every finite number (every number > 0 on a log scale), widened on
/// both sides by a fraction of its length; 0..1 (0.1..1 on a log scale) when there is none
AxisRange range_of(std::span<const double> numbers, Scale scale = Scale::kLinear, double margin = 0.04);

/// @return multiples of 1, 2 or 5 times a power of ten that lie in the range, about `count` of them; on a log
/// scale powers of ten, with 2 and 5 times them when those are few
std::vector<double> ticks(const AxisRange& range, Scale scale = Scale::kLinear, int count = 6);

/// @return the tick's number, with as many decimals as the step between ticks needs
std::string tick_label(double tick, double step);

/// @return logarithmic when the sizes > 0 differ by more than a factor, so that the small ones would lie flat
/// on the axis; linear otherwise
Scale scale_for(std::span<const double> sizes, double factor = 12.0);

/// Where the data lie on the sheet.
class Axes {
 public:
  Axes(const Axis& horizontal, const Axis& vertical, const Box& plot);
  /// The same, with one range widened so that a metre is as long across as it is up.
  static Axes with_equal_scale(const Axis& horizontal, const Axis& vertical, const Box& plot);

  /// @return where the numbers lie; not finite where a number is not, or is not > 0 on a log scale (but for
  /// the 0 of an axis that has one)
  Point to_pixel(double x, double y) const;
  /// Draws grid, frame, ticks and labels.
  void draw(Canvas& canvas) const;
  const Box& plot() const { return plot_; }

 private:
  void draw_horizontal(Canvas& canvas) const;
  void draw_vertical(Canvas& canvas) const;
  void draw_break(Canvas& canvas) const;

  Axis horizontal_;
  Axis vertical_;
  Box plot_;
};

}  // namespace stereobench::harness
