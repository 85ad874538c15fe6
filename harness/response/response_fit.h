/// What a response says: how much of each filter's error is the sensor's, and from which level on.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/response/floor_and_slope.h"
#include "harness/response/response.h"
#include "harness/statistics/bootstrap.h"

namespace stereobench::harness {

/// A value with its 95 % interval over seeds. Any of them may be infinite; NaN: not known.
struct ResponseValue {
  double value = std::numeric_limits<double>::quiet_NaN();
  Interval interval = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
};

/// One curve at one level.
struct LevelError {
  long runs = 0;             ///< that did not fail
  ResponseValue error_m;     ///< rms over seeds
  ResponseValue over_bound;  ///< that, over the rms of the bound; NaN for the bound and where there is none
  double off_law = 0.0;      ///< error / law - 1; NaN where there is no law
  bool is_off_by_chance = true;
};

/// The law of one curve.
struct ResponseLaw {
  FloorAndSlope law;
  ResponseValue floor_m;
  ResponseValue slope;             ///< m per unit of the level
  ResponseValue knee;              ///< in the unit of the level
  ResponseValue upper_knee;        ///< the same; infinite: errors grow in proportion up to the highest level
  ResponseValue exponent;          ///< local slope on log-log axes, over the upper half of the levels above 0
  double exponent_of_law = 0.0;    ///< what the law has there
  ResponseValue floor_over_bound;  ///< floor / floor of the bound; NaN where either is not known
  std::size_t farthest = 0;        ///< the level that is farthest off the law
  /// The law holds: no level is off by more than a tenth, unless by chance.
  bool holds = true;
};

struct CurveFit {
  std::string name;
  std::vector<LevelError> levels;  ///< in the order of ResponseFit::levels
  std::optional<ResponseLaw> law;  ///< none below 3 levels or 5 seeds
};

struct ResponseFit {
  std::string parameter;
  std::vector<double> levels;
  std::size_t seeds = 0;
  std::vector<CurveFit> filters;
  std::optional<CurveFit> bound;
};

/// Fits all curves, with intervals from seeds that are drawn anew, the same for all curves and levels.
///
/// Errors are rms over seeds, as the bound is one of mean squares, and mean squares of seeds that obey the
/// law obey it too. Equal responses give equal bytes.
/// @throws std::invalid_argument where levels are not ascending from 0 on, or a curve has another number of
///   levels or seeds than the others
ResponseFit fit_response(const Response& response);

}  // namespace stereobench::harness
