#include "harness/report/axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

constexpr double kLargest = 1e12;  // numbers beyond it are no measurement; they would swallow all others
constexpr double kBreak = 0.07;    // where the range begins on an axis with a 0, as a fraction of its length
constexpr double kZero = 0.03;     // where its 0 is
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr Colour kGrid = {0.88, 0.88, 0.88, 1.0};
constexpr Colour kFrame = {0.35, 0.35, 0.35, 1.0};

/// To the numbers in which the axis is straight.
double straightened(double number, Scale scale) {
  return scale == Scale::kLog ? std::log10(number) : number;
}

double straightened_back(double number, Scale scale) {
  return scale == Scale::kLog ? std::pow(10.0, number) : number;
}

bool can_be_drawn(double number, Scale scale) {
  return std::abs(number) <= kLargest && (scale == Scale::kLinear || number > 1.0 / kLargest);
}

/// @return the number's place along the axis: 0 at its beginning, 1 at its end
double fraction_along(const Axis& axis, double number) {
  if (axis.has_zero && number == 0.0) return kZero;
  if (!can_be_drawn(number, axis.scale)) return kNotANumber;
  const double low = straightened(axis.range.low, axis.scale);
  const double high = straightened(axis.range.high, axis.scale);
  const double begin = axis.has_zero ? kBreak : 0.0;
  return begin + (1.0 - begin) * (straightened(number, axis.scale) - low) / (high - low);
}

/// The smallest of 1, 2, 5 times a power of ten that is not below the length.
double step_not_below(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= length * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

std::vector<double> linear_ticks(const AxisRange& range, int count) {
  const double step = step_not_below((range.high - range.low) / count);
  const double slack = 1e-9 * (range.high - range.low) / step;
  std::vector<double> result;
  for (double k = std::ceil(range.low / step - slack); k <= range.high / step + slack; k += 1.0) {
    result.push_back(k == 0.0 ? 0.0 : k * step);
  }
  return result;
}

double decades_in(const AxisRange& range) {
  return std::log10(range.high / range.low);
}

/// Below a decade 1, 2 and 5 are too far apart; there a log scale is nearly straight and is ticked like one.
bool ticked_by_decades(const AxisRange& range, Scale scale) {
  return scale == Scale::kLog && decades_in(range) >= 1.0;
}

std::vector<double> log_ticks(const AxisRange& range, int count) {
  const double decades = decades_in(range);
  const double stride = std::max(1.0, std::ceil(decades / count));
  const bool few = decades < 2.5;
  const double first = stride * std::floor(std::log10(range.low) / stride);
  std::vector<double> result;
  for (double k = first; k <= std::log10(range.high) + 1e-9; k += stride) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10.0, k);
      const bool inside = tick >= range.low * (1.0 - 1e-9) && tick <= range.high * (1.0 + 1e-9);
      if (inside && (few || factor == 1.0)) result.push_back(tick);
    }
  }
  return result;
}

struct LabelledTick {
  double value = 0.0;
  std::string label;
};

std::vector<LabelledTick> labelled_ticks(const Axis& axis, int count) {
  std::vector<LabelledTick> result;
  for (std::size_t i = 0; i < axis.categories.size(); ++i) {
    result.push_back({static_cast<double>(i), axis.categories[i]});
  }
  if (!axis.categories.empty()) return result;
  if (axis.has_zero) result.push_back({0.0, "0"});
  const std::vector<double> values = ticks(axis.range, axis.scale, count);
  const double step = values.size() > 1 ? values[1] - values[0] : axis.range.high - axis.range.low;
  for (const double value : values) {
    result.push_back({value, tick_label(value, ticked_by_decades(axis.range, axis.scale) ? value : step)});
  }
  return result;
}

void check(const AxisRange& range, Scale scale) {
  const bool ordered = range.low < range.high && std::isfinite(range.high - range.low);
  if (!ordered || (scale == Scale::kLog && !(range.low > 0.0))) {
    throw std::invalid_argument("an axis needs low < high, both finite, and > 0 when logarithmic");
  }
}

void check(const Axis& axis) {
  check(axis.range, axis.scale);
  if (axis.has_zero && axis.scale != Scale::kLog)
    throw std::invalid_argument("a place for 0 before the range is one of a logarithmic axis");
}

}  // namespace

AxisRange range_of(std::span<const double> numbers, Scale scale, double margin) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double number : numbers) {
    if (!can_be_drawn(number, scale)) continue;
    low = std::min(low, straightened(number, scale));
    high = std::max(high, straightened(number, scale));
  }
  if (low > high) return scale == Scale::kLog ? AxisRange{0.1, 1.0} : AxisRange{0.0, 1.0};
  double widening = margin * (high - low);
  if (high - low <= 1e-9 * std::abs(high)) {
    widening = scale == Scale::kLog ? 0.5 : (high == 0.0 ? 0.5 : 0.5 * std::abs(high));
  }
  return {straightened_back(low - widening, scale), straightened_back(high + widening, scale)};
}

std::vector<double> ticks(const AxisRange& range, Scale scale, int count) {
  check(range, scale);
  count = std::max(count, 1);
  return ticked_by_decades(range, scale) ? log_ticks(range, count) : linear_ticks(range, count);
}

std::string tick_label(double tick, double step) {
  const double decimals = std::ceil(-std::log10(step) - 1e-9);
  if (!(std::abs(tick) < 1e6) || !(decimals <= 5.0)) return fmt::format("{:.6g}", tick);
  return fmt::format("{:.{}f}", tick, static_cast<int>(std::max(decimals, 0.0)));
}

Scale scale_for(std::span<const double> sizes, double factor) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0.0;
  for (const double size : sizes) {
    if (!can_be_drawn(size, Scale::kLog)) continue;
    least = std::min(least, size);
    greatest = std::max(greatest, size);
  }
  return greatest > factor * least ? Scale::kLog : Scale::kLinear;
}

Axes::Axes(const Axis& horizontal, const Axis& vertical, const Box& plot)
    : horizontal_(horizontal), vertical_(vertical), plot_(plot) {
  check(horizontal);
  check(vertical);
  if (!(plot.width_px > 0.0 && plot.height_px > 0.0)) {
    throw std::invalid_argument("a plot needs a width and a height");
  }
}

Axes Axes::with_equal_scale(const Axis& horizontal, const Axis& vertical, const Box& plot) {
  Axes axes(horizontal, vertical, plot);
  const auto widen = [](AxisRange& range, double length) {
    const double centre = 0.5 * (range.low + range.high);
    range = {centre - 0.5 * length, centre + 0.5 * length};
  };
  const double across = horizontal.range.high - horizontal.range.low;
  const double up = vertical.range.high - vertical.range.low;
  const double metres_per_pixel = std::max(across / plot.width_px, up / plot.height_px);
  widen(axes.horizontal_.range, metres_per_pixel * plot.width_px);
  widen(axes.vertical_.range, metres_per_pixel * plot.height_px);
  return axes;
}

Point Axes::to_pixel(double x, double y) const {
  return {plot_.left_px + fraction_along(horizontal_, x) * plot_.width_px,
          plot_.top_px + (1.0 - fraction_along(vertical_, y)) * plot_.height_px};
}

void Axes::draw(Canvas& canvas) const {
  draw_horizontal(canvas);
  draw_vertical(canvas);
  const double right = plot_.left_px + plot_.width_px;
  const double bottom = plot_.top_px + plot_.height_px;
  const std::array<Point, 5> frame = {{{plot_.left_px, plot_.top_px},
                                       {right, plot_.top_px},
                                       {right, bottom},
                                       {plot_.left_px, bottom},
                                       {plot_.left_px, plot_.top_px}}};
  canvas.draw_line(frame, {kFrame, 1.0});
  if (horizontal_.has_zero) draw_break(canvas);
}

/// Two slanted strokes through the lower edge, which is interrupted between them.
void Axes::draw_break(Canvas& canvas) const {
  constexpr double kHalf_px = 5.0;
  const double middle = plot_.left_px + 0.5 * (kZero + kBreak) * plot_.width_px;
  for (const double y : {plot_.top_px, plot_.top_px + plot_.height_px}) {
    const std::array<Point, 2> gap = {{{middle - 3.0, y}, {middle + 3.0, y}}};
    canvas.draw_line(gap, {{1.0, 1.0, 1.0, 1.0}, 3.0});
    for (const double x : {middle - 3.0, middle + 3.0}) {
      const std::array<Point, 2> stroke = {{{x - 2.0, y + kHalf_px}, {x + 2.0, y - kHalf_px}}};
      canvas.draw_line(stroke, {kFrame, 1.0});
    }
  }
}

void Axes::draw_horizontal(Canvas& canvas) const {
  const double bottom = plot_.top_px + plot_.height_px;
  for (const auto& [value, label] : labelled_ticks(horizontal_, static_cast<int>(plot_.width_px / 85.0))) {
    const double x = plot_.left_px + fraction_along(horizontal_, value) * plot_.width_px;
    const std::array<Point, 2> line = {{{x, plot_.top_px}, {x, bottom}}};
    canvas.draw_line(line, {kGrid, 1.0});
    canvas.write({x, bottom + 12.0}, label, {.size_px = 12.0, .align_x = 0.5});
  }
  canvas.write({plot_.left_px + 0.5 * plot_.width_px, bottom + 32.0}, horizontal_.label, {.align_x = 0.5});
}

void Axes::draw_vertical(Canvas& canvas) const {
  const TextStyle tick_style = {.size_px = 12.0, .align_x = 1.0};
  double widest = 0.0;
  for (const auto& [value, label] : labelled_ticks(vertical_, static_cast<int>(plot_.height_px / 38.0))) {
    const double y = plot_.top_px + (1.0 - fraction_along(vertical_, value)) * plot_.height_px;
    const std::array<Point, 2> line = {{{plot_.left_px, y}, {plot_.left_px + plot_.width_px, y}}};
    canvas.draw_line(line, {kGrid, 1.0});
    canvas.write({plot_.left_px - 6.0, y}, label, tick_style);
    widest = std::max(widest, canvas.text_width_px(label, tick_style));
  }
  const Point at = {plot_.left_px - widest - 20.0, plot_.top_px + 0.5 * plot_.height_px};
  canvas.write(at, vertical_.label, {.align_x = 0.5, .upwards = true});
}

}  // namespace stereobench::harness
