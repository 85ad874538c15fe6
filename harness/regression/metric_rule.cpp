#include "harness/regression/metric_rule.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fnmatch.h>

#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

using Better = MetricRule::Better;

/// How much underconfidence counts beside overconfidence: it wastes information, but loses no filter.
constexpr double kUnderconfidence = 0.5;

struct NamedRule {
  const char* pattern;
  MetricRule rule;
};

/// The first that fits counts. From the pictures to the map.
constexpr std::array kRules = std::to_array<NamedRule>({
    {"vision.recall", {.better = Better::kHigher, .relative_margin = 0.0, .absolute_margin = 0.005}},
    {"vision.precision", {.better = Better::kHigher, .relative_margin = 0.0, .absolute_margin = 0.005}},
    {"vision.misidentified", {}},
    {"vision.spurious", {}},
    {"vision.repeated", {}},
    {"vision.flagged", {}},
    {"vision.*_rms_*", {}},
    {"vision.*_bias_*", {.better = Better::kNearZero, .relative_margin = 0.1}},
    {"vision.normalised_error", {.better = Better::kNearOne, .relative_margin = 0.0, .absolute_margin = 0.1}},
    {"filters.*.failures", {}},
    {"filters.*_rms_m", {}},
    {"filters.*_rms_rad", {}},
    {"filters.*.ate_max_m", {.relative_margin = 0.1}},
    {"filters.*.final_drift", {}},
    {"filters.*.anees", {.better = Better::kNearOne, .relative_margin = 0.0, .absolute_margin = 0.1}},
    {"filters.*.nis.per_run", {.better = Better::kNearOne, .relative_margin = 0.0, .absolute_margin = 0.1}},
    {"filters.*.within_50",
     {.better = Better::kNearLevel, .level = 0.50, .relative_margin = 0.0, .absolute_margin = 0.05}},
    {"filters.*.within_95",
     {.better = Better::kNearLevel, .level = 0.95, .relative_margin = 0.0, .absolute_margin = 0.02}},
    {"filters.*.within_99",
     {.better = Better::kNearLevel, .level = 0.99, .relative_margin = 0.0, .absolute_margin = 0.01}},
    {"filters.*.landmarks.found_once", {.better = Better::kHigher}},
    {"filters.*.association.correct", {.better = Better::kHigher}},
    {"filters.*.nis.refused", {}},
    {"filters.*.landmarks.*", {}},
    {"filters.*.association.*", {}},
    {"filters.*.counters.*", {}},
    {"batch.failures", {}},
    {"batch.*_m", {}},
});

const NamedRule* named_rule(const std::string& name) {
  return std::ranges::find_if(kRules, [&](const NamedRule& named) { return fits(name, named.pattern); });
}

}  // namespace

bool fits(const std::string& name, const std::string& pattern) {
  return fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) == 0;
}

bool fits_any(const std::string& name, std::span<const std::string> patterns) {
  return patterns.empty() ||
         std::ranges::any_of(patterns, [&](const std::string& pattern) { return fits(name, pattern); });
}

Margin parse_margin(const std::string& text) {
  const std::size_t at = text.rfind('=');
  Margin margin{.pattern = text.substr(0, at)};
  if (at != std::string::npos && at > 0) {
    margin.relative = text.ends_with('%');
    const char* const end = text.data() + text.size() - (margin.relative ? 1 : 0);
    const auto [read, error] = std::from_chars(text.data() + at + 1, end, margin.value);
    if (error == std::errc() && read == end && std::isfinite(margin.value) && margin.value >= 0.0) {
      if (margin.relative) margin.value /= 100.0;
      return margin;
    }
  }
  throw std::runtime_error(
      fmt::format("--margin: expected a metric and what may change, e.g. 'filters.*.ate_rms_m=5%' or "
                  "'vision.recall=0.01' (got '{}')",
                  text));
}

std::optional<MetricRule> rule_of(const std::string& name, std::span<const Margin> margins) {
  const NamedRule* const found = named_rule(name);
  if (found == kRules.end()) return {};
  MetricRule rule = found->rule;
  for (const Margin& margin : margins) {
    if (!fits(name, margin.pattern)) continue;
    rule.relative_margin = margin.relative ? margin.value : 0.0;
    rule.absolute_margin = margin.relative ? 0.0 : margin.value;
  }
  return rule;
}

MetricFamily family_of(const std::string& name) {
  constexpr std::array kCounts = {"vision.recall",   "vision.precision", "vision.misidentified",
                                  "vision.spurious", "vision.repeated",  "vision.flagged"};
  if (std::ranges::count(kCounts, name) > 0) return MetricFamily::kDetectionCounts;
  return name.starts_with("vision.") ? MetricFamily::kDetectionErrors : MetricFamily::kSlam;
}

int rank_of(const std::string& name) {
  return static_cast<int>(named_rule(name) - kRules.begin());
}

std::string scale_of(const std::string& name) {
  const std::string bias = "_bias_";
  const std::size_t at = name.find(bias);
  return at == std::string::npos ? name : std::string(name).replace(at, bias.size(), "_rms_");
}

double badness(const MetricRule& rule, double mean) {
  switch (rule.better) {
    case Better::kLower:
      return mean;
    case Better::kHigher:
      return -mean;
    case Better::kNearZero:
      return std::abs(mean);
    case Better::kNearOne: {
      const double over = slam::logarithm(mean);
      return over >= 0.0 ? over : -kUnderconfidence * over;
    }
    case Better::kNearLevel:
      return std::abs(mean - rule.level);
  }
  return mean;
}

}  // namespace stereobench::harness
