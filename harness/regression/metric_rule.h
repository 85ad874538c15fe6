/// What a change of a metric means: which way is worse, and from where on it matters.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace stereobench::harness {

/// How a metric is judged.
struct MetricRule {
  enum class Better {
    kLower,      ///< errors and counts of faults
    kHigher,     ///< rates and counts of what is right
    kNearZero,   ///< biases: the absolute value of the mean is judged
    kNearOne,    ///< NIS, NEES: the mean's logarithm is judged; below 0 (underconfident) half its size
    kNearLevel,  ///< coverage: the distance of the mean from `level` is judged
  };
  Better better = Better::kLower;
  double level = 0.0;             ///< for kNearLevel
  double relative_margin = 0.05;  ///< changes below this share of the first result do not matter,
  double absolute_margin = 0.0;   ///< nor do those below this; the larger one counts
};

/// A margin that a user gives: for all metrics whose names fit.
struct Margin {
  std::string pattern;  ///< a metric's name, in which `*` stands for anything
  bool relative = true;
  double value = 0.0;
};

/// Reads "filters.*.ate_rms_m=5%" or "vision.recall=0.01".
/// @throws std::runtime_error that begins with "--margin: "
Margin parse_margin(const std::string& text);

/// @return whether a name fits a pattern as of a shell: `*` stands for any characters, `?` for one, `[ab]`
/// for one of some
bool fits(const std::string& name, const std::string& pattern);

/// @return whether a name fits one of the patterns, or there are none
bool fits_any(const std::string& name, std::span<const std::string> patterns);

/// @param margins of which the last one that fits counts
/// @return how a metric is judged; empty for numbers that are neither good nor bad, such as how many balls
/// were to be found
std::optional<MetricRule> rule_of(const std::string& name, std::span<const Margin> margins = {});

/// Metrics whose p-values are corrected together.
enum class MetricFamily { kDetectionCounts, kDetectionErrors, kSlam };
MetricFamily family_of(const std::string& name);

/// @return the place of a judged metric on the way from the pictures to the map: causes come before effects
int rank_of(const std::string& name);

/// @return the metric whose mean in the first result a relative margin is a share of: of a bias the rms
/// error, else the metric itself
std::string scale_of(const std::string& name);

/// @param mean of a metric over seeds
/// @return a number that is the larger the worse, in the unit of the margins
double badness(const MetricRule& rule, double mean);

}  // namespace stereobench::harness
