/// The errors of a sweep over one number of the scenario: what the response of the filters is read from.
#pragma once

#include <string>
#include <vector>

namespace stereobench::harness {

/// The error of one filter, or of the bound.
struct ResponseCurve {
  std::string name;
  std::vector<std::vector<double>> values;  ///< m, by level, then by seed; NaN: the run failed
};

/// All filters at all levels, on the same seeds.
struct Response {
  std::string parameter;       ///< the varied key, e.g. "detector_noise.centre_sd_px"
  std::vector<double> levels;  ///< >= 0, ascending
  std::vector<ResponseCurve> filters;
  ResponseCurve bound;  ///< without values where there is none
};

}  // namespace stereobench::harness
