#include "slam/diagnosis/lasting_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "slam/diagnosis/decided_log.h"
#include "slam/diagnosis/noise_fit.h"
#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

constexpr double kBeyondChance = 5.0;  ///< standard deviations of a correlation that is none
constexpr long kFewestPairs = 50;
constexpr double kMostCorrelated = 0.999;
constexpr double kClose = 2.0;  ///< pairs are looked at up to so many median gaps

/// Two innovations of a landmark that follow each other, in standard deviations.
struct Pair {
  double gap_s;
  Eigen::Vector2d before;
  Eigen::Vector2d after;
};

/// The time of each step, which its controls add up to.
std::vector<double> times_of(std::span<const BatchStep> steps) {
  std::vector<double> times;
  double now_s = 0.0;
  for (const BatchStep& step : steps) {
    for (const Control& control : step.controls)
      now_s += std::isfinite(control.duration_s) ? control.duration_s : 0.0;
    times.push_back(now_s);
  }
  return times;
}

Eigen::Vector2d in_sd(const RangeBearing& seen, const ExpectedSighting& expected) {
  const Eigen::Vector2d residual(seen.range_m - expected.range_bearing[0],
                                 wrap_angle(seen.bearing_rad - expected.range_bearing[1]));
  return residual.cwiseQuotient(expected.covariance.diagonal().cwiseSqrt());
}

std::vector<Pair> pairs_of(const FilterConfig& config, const Pose& start, std::span<const BatchStep> steps) {
  struct Last {
    double time_s;
    Eigen::Vector2d innovation;
  };
  const DecidedLog log = decide(config, start, steps);
  const std::vector<double> times = times_of(steps);
  std::map<int, Last> last;  // by landmark
  std::vector<Pair> pairs;
  replay(config, start, log, [&](const EkfSlam& filter, std::size_t step) {
    for (std::size_t k = 0; k < log.steps[step].sightings.size(); ++k) {
      const ExpectedSighting& expected = filter.expected()[k];
      if (!expected.exists) continue;
      const RangeBearing& seen = log.steps[step].sightings[k];
      const Last now{times[step], in_sd(seen, expected)};
      if (!now.innovation.allFinite()) continue;
      const auto [before, is_first] = last.try_emplace(seen.landmark_id, now);
      if (!is_first && now.time_s > before->second.time_s)
        pairs.push_back({now.time_s - before->second.time_s, before->second.innovation, now.innovation});
      before->second = now;
    }
  });
  return pairs;
}

FilterConfig with_fitted_odometry(const FilterConfig& config, const Pose& start,
                                  std::span<const BatchStep> steps) {
  LogFactors factors =
      fit_noise([&](const LogFactors& at) { return noise_evidence(config, start, steps, at); }).factors;
  factors.tail<2>().setZero();
  return without_floor(with_factors(config, factors));
}

double median_gap_s(const std::vector<Pair>& pairs) {
  std::vector<double> gaps;
  for (const Pair& pair : pairs) gaps.push_back(pair.gap_s);
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::ranges::nth_element(gaps, middle);
  return *middle;
}

}  // namespace

LastingErrors find_lasting_errors(const FilterConfig& config, const Pose& start,
                                  std::span<const BatchStep> steps) {
  std::vector<Pair> pairs = pairs_of(with_fitted_odometry(config, start, steps), start, steps);
  if (static_cast<long>(pairs.size()) < kFewestPairs) return {};
  const double most_s = kClose * median_gap_s(pairs);
  std::erase_if(pairs, [&](const Pair& pair) { return pair.gap_s > most_s; });
  const auto count = static_cast<double>(pairs.size());
  LastingErrors found;
  Eigen::Vector2d products = Eigen::Vector2d::Zero(), squares = Eigen::Vector2d::Zero();
  for (const auto& [gap_s, before, after] : pairs) {
    found.gap_s += gap_s / count;
    products += before.cwiseProduct(after);
    squares += 0.5 * (before.cwiseAbs2() + after.cwiseAbs2());
  }
  for (int part = 0; part < 2; ++part) {
    const double correlation = squares[part] > 0.0 ? products[part] / squares[part] : 0.0;
    if (correlation < kCorrelated || correlation * std::sqrt(count) < kBeyondChance) continue;
    found.correlation[part] = std::min(correlation, kMostCorrelated);
    found.time_s[part] = -found.gap_s / logarithm(found.correlation[part]);
  }
  return found;
}

void weigh_by_gaps(const FilterConfig& config, const Pose& start, const Eigen::Vector2d& time_s,
                   std::span<BatchStep> steps) {
  struct Last {
    double time_s;
    double gap_s;
  };
  const DecidedLog log = decide(without_floor(config), start, steps);
  const std::vector<double> times = times_of(steps);
  std::map<std::pair<bool, int>, Last> last;  // by landmark that is known, or decided
  for (std::size_t k = 0; k < steps.size(); ++k) {
    for (std::size_t i = 0; i < steps[k].sightings.size(); ++i) {
      RangeBearing& seen = steps[k].sightings[i];
      const bool is_known = seen.landmark_id >= 0;
      const int landmark = is_known ? seen.landmark_id : log.landmarks[k][i];
      if (landmark == kUnknown) continue;
      constexpr double kNever = std::numeric_limits<double>::infinity();
      Last& before = last.try_emplace({is_known, landmark}, Last{times[k], kNever}).first->second;
      if (times[k] > before.time_s) before = {times[k], times[k] - before.time_s};
      for (int part = 0; part < 2; ++part) {
        const double kept = time_s[part] > 0.0 ? exponential(-before.gap_s / time_s[part]) : 0.0;
        seen.sd_scale[part] = 1.0 / std::sqrt(1.0 - kept);
      }
    }
  }
}

}  // namespace stereobench::slam
