/// How far each filter was from the truth, over time.
#pragma once

#include <string>
#include <vector>

#include "harness/report/anees_panel.h"

namespace stereobench::harness {

/// Position errors of one filter, of every run of it.
struct ErrorCurves {
  std::string filter;
  std::vector<std::vector<double>> error_m_by_run;  ///< one row a run, aligned with ErrorPicture::time_s
};

struct ErrorPicture {
  std::string title;
  std::vector<double> time_s;
  std::vector<ErrorCurves> filters;
  std::vector<double> bound_m;  ///< the least rms error at each instant; empty when it is not known
  AneesPanel anees;             ///< below it; may be empty
};

/// @return the mean over runs of each run's rms error over time; NaN when no error is finite
double mean_rms_m(const ErrorCurves& curves);

/// Draws each filter's rms error over its runs, a band from the least to the greatest, the least rms that is
/// possible, and in the legend the mean over runs of each run's rms. The error axis is logarithmic when those
/// are more than a factor of 12 apart. Below it the normalised errors, when there are any.
/// @return the bytes of a PNG file; errors that are not finite are left out
std::string draw_error_picture(const ErrorPicture& picture);

}  // namespace stereobench::harness
