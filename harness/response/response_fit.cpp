#include "harness/response/response_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "harness/response/seed_resampling.h"
#include "harness/statistics/statistics.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kLevel = 0.95;
constexpr std::size_t kFewestLevels = 3;

/// A curve as one choice of seeds shows it.
struct CurveView {
  std::vector<double> mean_squares;  ///< one a level; NaN: no run
  std::vector<double> runs;          ///< one a level
  FloorAndSlope law;
};

/// A number of a view of a curve, and of the view of the bound by the same seeds.
using Statistic = std::function<double(const CurveView& view, const CurveView& bound)>;

std::size_t seeds_of(const Response& response) {
  for (const ResponseCurve& curve : response.filters)
    if (!curve.values.empty()) return curve.values.front().size();
  return response.bound.values.empty() ? 0 : response.bound.values.front().size();
}

void check(const ResponseCurve& curve, std::size_t levels, std::size_t seeds) {
  if (curve.values.size() != levels)
    throw std::invalid_argument(
        fmt::format("response of {}: expected {} levels (got {})", curve.name, levels, curve.values.size()));
  for (const std::vector<double>& values : curve.values)
    if (values.size() != seeds)
      throw std::invalid_argument(
          fmt::format("response of {}: expected {} seeds (got {})", curve.name, seeds, values.size()));
}

void check(const Response& response) {
  for (std::size_t i = 0; i < response.levels.size(); ++i) {
    const bool is_next = i == 0 || response.levels[i] > response.levels[i - 1];
    if (!(response.levels[i] >= 0.0) || !std::isfinite(response.levels[i]) || !is_next)
      throw std::invalid_argument(fmt::format("response to {}: expected levels from 0 on, ascending (got {})",
                                              response.parameter, response.levels[i]));
  }
  const std::size_t seeds = seeds_of(response);
  for (const ResponseCurve& curve : response.filters) check(curve, response.levels.size(), seeds);
  if (!response.bound.values.empty()) check(response.bound, response.levels.size(), seeds);
}

/// How a curve is looked at.
struct Lens {
  const std::vector<double>& levels;
  bool has_upper_knee = false;
};

CurveView view_of(const ResponseCurve& curve, const Lens& lens, const SeedCounts& counts) {
  CurveView view;
  for (const std::vector<double>& values : curve.values) {
    double squares = 0.0;
    double runs = 0.0;
    for (std::size_t seed = 0; seed < values.size(); ++seed) {
      if (!std::isfinite(values[seed])) continue;
      squares += counts[seed] * values[seed] * values[seed];
      runs += counts[seed];
    }
    view.mean_squares.push_back(squares / runs);
    view.runs.push_back(runs);
  }
  if (curve.values.empty()) return view;
  const auto& fit = lens.has_upper_knee ? fit_with_upper_knee : fit_floor_and_slope;
  view.law = fit(lens.levels, view.mean_squares, view.runs);
  return view;
}

/// A curve by all seeds, and by drawn ones.
struct CurveViews {
  CurveView all;
  std::vector<CurveView> drawn;
};

/// The seeds as they are, and as they are drawn.
struct SeedChoices {
  SeedCounts all;
  std::vector<SeedCounts> drawn;
};

CurveViews views_of(const ResponseCurve& curve, const Lens& lens, const SeedChoices& seeds) {
  CurveViews views{view_of(curve, lens, seeds.all), {}};
  for (const SeedCounts& counts : seeds.drawn) views.drawn.push_back(view_of(curve, lens, counts));
  return views;
}

/// A curve and the bound, by the same seeds.
struct Compared {
  std::size_t seeds = 0;
  CurveViews curve;
  const CurveViews& bound;
};

std::vector<double> drawn_values(const Compared& views, const Statistic& statistic) {
  std::vector<double> values;
  for (std::size_t i = 0; i < views.curve.drawn.size(); ++i)
    values.push_back(statistic(views.curve.drawn[i], views.bound.drawn[i]));
  return values;
}

ResponseValue value_of(const Compared& views, const Statistic& statistic) {
  ResponseValue value;
  value.value = statistic(views.curve.all, views.bound.all);
  if (!views.curve.drawn.empty() && !std::isnan(value.value))
    value.interval = percentile_interval(drawn_values(views, statistic), views.seeds, kLevel);
  return value;
}

/// The upper half of the levels above 0 that have an error, two or more.
std::vector<std::size_t> upper_levels(const CurveView& view, const std::vector<double>& levels) {
  std::vector<std::size_t> upper;
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (levels[i] > 0.0 && view.mean_squares[i] > 0.0) upper.push_back(i);
  const std::size_t kept = std::max<std::size_t>(2, (upper.size() + 1) / 2);
  if (upper.size() > kept) upper.erase(upper.begin(), upper.end() - static_cast<std::ptrdiff_t>(kept));
  return upper;
}

/// The slope of a line through logarithms. @param mean_square_of of a level, by its place
template <typename MeanSquare>
double exponent_of(const std::vector<std::size_t>& places, const std::vector<double>& levels,
                   const MeanSquare& mean_square_of) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const std::size_t place : places) {
    const double log_level = slam::logarithm(levels[place]);
    const double log_error = 0.5 * slam::logarithm(mean_square_of(place) / mean_square_of(places.front()));
    x += log_level, y += log_error, xx += log_level * log_level, xy += log_level * log_error;
  }
  const auto n = static_cast<double>(places.size());
  return places.size() < 2 ? kNone : (n * xy - x * y) / (n * xx - x * x);
}

/// The logarithm of error / law at a level.
double log_off_law(const CurveView& view, const std::vector<double>& levels, std::size_t i) {
  return 0.5 * slam::logarithm(view.mean_squares[i]) - slam::logarithm(view.law.at(levels[i]));
}

/// What a level is off the law by, and whether seeds alone can do that: by Student's t, shared among the
/// levels.
void compare_with_law(const Compared& views, const std::vector<double>& levels, std::size_t i,
                      LevelError& error) {
  const auto off = [&](const CurveView& view, const CurveView&) { return log_off_law(view, levels, i); };
  const double log_off = off(views.curve.all, views.bound.all);
  const double chance = 0.05 / static_cast<double>(levels.size());
  const double t = student_t_bound(1.0 - chance, static_cast<long>(views.seeds) - 1);
  error.off_law = slam::exponential(log_off) - 1.0;
  error.is_off_by_chance = !(std::abs(log_off) > t * drawn_error(drawn_values(views, off), views.seeds));
}

ResponseLaw law_of(const Compared& views, const std::vector<double>& levels) {
  ResponseLaw law;
  law.law = views.curve.all.law;
  law.floor_m = value_of(views, [](const CurveView& view, const CurveView&) { return view.law.floor; });
  law.slope = value_of(views, [](const CurveView& view, const CurveView&) { return view.law.slope; });
  law.knee = value_of(views, [](const CurveView& view, const CurveView&) { return view.law.knee(); });
  law.upper_knee =
      value_of(views, [](const CurveView& view, const CurveView&) { return view.law.upper_knee; });
  law.floor_over_bound = value_of(views, [](const CurveView& view, const CurveView& bound) {
    return bound.mean_squares.empty() ? kNone : view.law.floor / bound.law.floor;
  });
  const std::vector<std::size_t> upper = upper_levels(views.curve.all, levels);
  law.exponent = value_of(views, [&](const CurveView& view, const CurveView&) {
    return exponent_of(upper, levels, [&](std::size_t i) { return view.mean_squares[i]; });
  });
  law.exponent_of_law = exponent_of(upper, levels, [&](std::size_t i) {
    return views.curve.all.law.at(levels[i]) * views.curve.all.law.at(levels[i]);
  });
  return law;
}

/// Adds how well the law describes each level.
void judge_law(const Compared& views, const std::vector<double>& levels, CurveFit& fit) {
  constexpr double kMostOff = 0.1;  // a bent curve that is 18 % off a line had a knee 2.4 times too high
  double farthest = 0.0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    LevelError& error = fit.levels[i];
    if (error.runs == 0) continue;
    compare_with_law(views, levels, i, error);
    if (std::abs(error.off_law) > kMostOff && !error.is_off_by_chance) fit.law->holds = false;
    if (!(std::abs(error.off_law) > farthest)) continue;
    farthest = std::abs(error.off_law);
    fit.law->farthest = i;
  }
}

CurveFit fit_of(const std::string& name, const Compared& views, const std::vector<double>& levels) {
  CurveFit fit{.name = name, .levels = std::vector<LevelError>(levels.size()), .law = {}};
  std::size_t with_error = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    LevelError& error = fit.levels[i];
    error.runs = std::lround(views.curve.all.runs[i]);
    error.off_law = kNone;
    error.error_m = value_of(
        views, [i](const CurveView& view, const CurveView&) { return std::sqrt(view.mean_squares[i]); });
    error.over_bound = value_of(views, [i](const CurveView& view, const CurveView& bound) {
      return bound.mean_squares.empty() ? kNone : std::sqrt(view.mean_squares[i] / bound.mean_squares[i]);
    });
    with_error += error.runs > 0 ? 1 : 0;
  }
  if (with_error < kFewestLevels || views.seeds < kFewestSeedsToResample) return fit;
  fit.law = law_of(views, levels);
  judge_law(views, levels, fit);
  return fit;
}

/// A curve by its best lens, and what is seen of it.
struct SeenCurve {
  CurveFit fit;
  CurveViews views;
};

SeenCurve see(const ResponseCurve& curve, const std::vector<double>& levels, const SeedChoices& seeds,
              const CurveViews& bound) {
  constexpr std::ptrdiff_t kFewestForUpperKnee = 4;
  const auto seen_by = [&](const Lens& lens) {
    const Compared views{seeds.all.size(), views_of(curve, lens, seeds), bound};
    return SeenCurve{fit_of(curve.name, views, levels), views.curve};
  };
  SeenCurve line = seen_by({levels});
  const auto& errors = line.fit.levels;
  const auto with_error =
      std::ranges::count_if(errors, [](const LevelError& error) { return error.runs > 0; });
  const bool is_doubted =
      std::ranges::any_of(errors, [](const LevelError& error) { return !error.is_off_by_chance; });
  if (!line.fit.law || !is_doubted || with_error < kFewestForUpperKnee) return line;
  SeenCurve bent = seen_by({levels, true});
  return bent.fit.law->holds ? bent : line;
}

}  // namespace

ResponseFit fit_response(const Response& response) {
  check(response);
  ResponseFit fit;
  fit.parameter = response.parameter;
  fit.levels = response.levels;
  fit.seeds = seeds_of(response);
  SeedChoices seeds{SeedCounts(fit.seeds, 1.0), {}};
  if (fit.seeds >= kFewestSeedsToResample) seeds.drawn = drawn_seeds(fit.seeds);
  const CurveViews none{{}, std::vector<CurveView>(seeds.drawn.size())};
  CurveViews bound = none;
  if (!response.bound.values.empty()) {
    SeenCurve seen = see(response.bound, fit.levels, seeds, none);
    fit.bound = std::move(seen.fit);
    bound = std::move(seen.views);
  }
  for (const ResponseCurve& curve : response.filters)
    fit.filters.push_back(see(curve, fit.levels, seeds, bound).fit);
  return fit;
}

}  // namespace stereobench::harness
