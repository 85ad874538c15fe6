/// How far each filter was from the truth, over time.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "harness/report/anees_panel.h"

namespace stereobench::harness {

/// Position errors of one filter, run by run. It keeps sums over the runs at each instant, and no run.
class ErrorCurves {
 public:
  explicit ErrorCurves(std::string filter) : filter_(std::move(filter)) {}

  /// Adds a run. @param errors_m aligned with ErrorPicture::time_s; those that are not finite are left out
  void add(const std::vector<double>& errors_m);

  const std::string& filter() const { return filter_; }
  /// The rms, the least and the greatest error over the runs at an instant; NaN where no run has one.
  double rms_m(std::size_t instant) const;
  double least_m(std::size_t instant) const;
  double greatest_m(std::size_t instant) const;
  /// The mean over runs of each run's rms error over time; NaN when no error is finite.
  double mean_rms_m() const { return sum_of_rms_m_ / runs_; }

 private:
  struct Instant {
    double sum_m2 = 0.0;
    double count = 0.0;
    double least_m = 0.0;
    double greatest_m = 0.0;
  };
  bool is_known(std::size_t instant) const {
    return instant < instants_.size() && instants_[instant].count > 0;
  }

  std::string filter_;
  std::vector<Instant> instants_;
  double sum_of_rms_m_ = 0.0;
  double runs_ = 0.0;  ///< that have an rms
};

struct ErrorPicture {
  std::string title;
  std::vector<double> time_s;
  std::vector<ErrorCurves> filters;
  std::vector<double> bound_m;  ///< the least rms error at each instant; empty when it is not known
  AneesPanel anees;             ///< below it; may be empty
  std::string time_axis = "time [s]";
};

/// Draws each filter's rms error over its runs, a band from the least to the greatest, the least rms that is
/// possible, and in the legend the mean over runs of each run's rms. The error axis is logarithmic when those
/// are more than a factor of 12 apart. Below it the normalised errors, when there are any.
/// @return the bytes of a PNG file; errors that are not finite are left out
std::string draw_error_picture(const ErrorPicture& picture);

}  // namespace stereobench::harness
