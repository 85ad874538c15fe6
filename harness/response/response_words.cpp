#include "harness/response/response_words.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/run/metric_keys.h"

namespace stereobench::harness {
namespace {

/// "0.31 px (0.25 to 0.40)"; the value alone where all digits of the ends are the same.
std::string with_unit(const ResponseValue& value, const std::string& unit, int digits) {
  const std::string low = format_number(value.interval.low, digits);
  const std::string high = format_number(value.interval.high, digits);
  const std::string behind = unit.empty() ? "" : " " + unit;
  if (!std::isfinite(value.interval.high)) return low + behind + " or more";
  const std::string text = format_number(value.value, digits) + behind;
  return low == high ? text : fmt::format("{} ({} to {})", text, low, high);
}

/// All that a sentence is made of.
struct Subject {
  const ResponseFit& fit;
  const CurveFit& curve;
  bool is_bound = false;

  const ResponseLaw& law() const { return *curve.law; }
  std::string unit() const { return unit_of(fit.parameter); }
  std::string level(double level) const { return level_word(level, fit.parameter); }
  double lowest() const { return fit.levels.front() > 0.0 ? fit.levels.front() : fit.levels[1]; }
};

/// A level that was not set: to two digits.
std::string measured_level(double level, const Subject& subject) {
  return format_number(level, 2) + (subject.unit().empty() ? "" : " " + subject.unit());
}

/// Whose the error is that is not the sensor's.
std::string whose(const Subject& subject) {
  if (subject.is_bound) return "is that of odometry, geometry and other noise";
  const ResponseValue& ratio = subject.law().floor_over_bound;
  const bool is_known = subject.fit.bound && subject.fit.bound->law && subject.fit.bound->law->holds;
  if (!is_known || std::isnan(ratio.interval.low)) return "is not the sensor's";
  const std::string times = with_unit(ratio, "", 3) + " times the bound";
  if (ratio.interval.low > std::numbers::sqrt2) return "is mostly the filter's own: " + times;
  if (ratio.interval.high < std::numbers::sqrt2)
    return "is that of odometry, geometry and other noise: " + times;
  return "is that of odometry, geometry, other noise and the filter, and these seeds do not say whose most "
         "is: " +
         times;
}

std::string sentence_without_law(const Subject& subject) {
  const ResponseLaw& law = subject.law();
  const double off = 100.0 * subject.curve.levels[law.farthest].off_law;
  return fmt::format(
      "no knee: the error at {} of {} is {:.0f} % {} what a floor and a line give; over the upper levels it "
      "grows as the level to the power {}",
      subject.level(subject.fit.levels[law.farthest]), subject.fit.parameter, std::abs(off),
      off > 0.0 ? "above" : "below", value_word(law.exponent));
}

std::string sentence_without_slope(const Subject& subject) {
  return fmt::format("up to {} of {}, the highest level, the sensor does not matter: the error, {}, {}",
                     subject.level(subject.fit.levels.back()), subject.fit.parameter,
                     with_unit(subject.law().floor_m, "m", 2), whose(subject));
}

std::string sentence_without_floor(const Subject& subject) {
  const double highest_knee = subject.law().knee.interval.high;
  if (highest_knee < subject.lowest())
    return fmt::format("at all levels of {}, from {} on, the error is that of the sensor; a knee is below {}",
                       subject.fit.parameter, subject.level(subject.lowest()),
                       measured_level(highest_knee, subject));
  return fmt::format(
      "from {} of {} on the error is that of the sensor; whether there is a floor below it, "
      "these levels do not say",
      measured_level(highest_knee, subject), subject.fit.parameter);
}

/// What is said where errors stop to grow with the level.
std::string above_upper_knee(const Subject& subject) {
  const ResponseValue& upper_knee = subject.law().upper_knee;
  if (!std::isfinite(upper_knee.value)) return {};
  return fmt::format("; above {} odometry knows more than the sensor says",
                     with_unit(upper_knee, subject.unit(), 2));
}

std::string sentence_of(const Subject& subject) {
  const ResponseLaw& law = subject.law();
  if (!law.holds) return sentence_without_law(subject);
  const bool slope_is_seen =
      law.slope.interval.low > 0.0 && law.knee.interval.low < subject.fit.levels.back();
  if (!slope_is_seen) return sentence_without_slope(subject);
  if (!(law.floor_m.interval.low > 0.0)) return sentence_without_floor(subject) + above_upper_knee(subject);
  return fmt::format("below {} of {} the error {}", knee_word(subject.fit, law), subject.fit.parameter,
                     whose(subject)) +
         above_upper_knee(subject);
}

}  // namespace

std::string level_word(double level, const std::string& parameter) {
  return fmt::format("{}{}{}", level, unit_of(parameter).empty() ? "" : " ", unit_of(parameter));
}

std::string value_word(const ResponseValue& value) {
  const bool is_known = !std::isnan(value.value) && std::isfinite(value.interval.low);
  return is_known ? with_unit(value, "", 3) : "-";
}

std::string knee_word(const ResponseFit& fit, const ResponseLaw& law) {
  return std::isfinite(law.knee.interval.low) ? with_unit(law.knee, unit_of(fit.parameter), 2) : "-";
}

std::vector<std::string> response_header(const ResponseFit& fit) {
  const std::string unit = unit_of(fit.parameter);
  return {"curve",
          "floor [m]",
          fmt::format("slope [m{}{}]", unit.empty() ? "" : " / ", unit),
          unit.empty() ? "knee" : fmt::format("knee [{}]", unit),
          unit.empty() ? "upper knee" : fmt::format("upper knee [{}]", unit),
          "upper exponent (of the law)",
          "farthest off the law",
          "floor / bound"};
}

std::vector<std::string> response_row(const ResponseFit& fit, const CurveFit& curve) {
  const ResponseLaw& law = *curve.law;
  return {
      curve.name,
      value_word(law.floor_m),
      value_word(law.slope),
      value_word(law.knee),
      value_word(law.upper_knee),
      fmt::format("{} ({})", value_word(law.exponent), format_number(law.exponent_of_law, 2)),
      fmt::format("{:+.0f} % at {}{}", 100.0 * curve.levels[law.farthest].off_law,
                  level_word(fit.levels[law.farthest], fit.parameter), law.holds ? "" : ": it does not hold"),
      value_word(law.floor_over_bound)};
}

std::vector<std::string> response_sentences(const ResponseFit& fit) {
  std::vector<std::string> sentences;
  const auto add = [&](const CurveFit& curve, bool is_bound) {
    if (curve.law) sentences.push_back(curve.name + ": " + sentence_of({fit, curve, is_bound}));
  };
  if (fit.bound) add(*fit.bound, true);
  for (const CurveFit& curve : fit.filters) add(curve, false);
  return sentences;
}

}  // namespace stereobench::harness
