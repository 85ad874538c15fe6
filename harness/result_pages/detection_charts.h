/// Charts of a result's detections: errors against range and against the noise that is stated.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/page/page.h"
#include "harness/result_pages/detection_row.h"

namespace stereobench::harness {

/// Detections of one detector.
struct NamedDetections {
  std::string name;  ///< of its series; empty: "rms error"
  std::span<const DetectionRow> rows;
};

/// Root mean squares over parts of a quantity.
struct BinnedRms {
  std::vector<double> at;   ///< mean of the quantity in each part
  std::vector<double> rms;  ///< of the values in it
  std::vector<double> low;  ///< 95 % interval of normal errors: chi-square
  std::vector<double> high;
};

/// Cuts values into parts of as many each, in order of a quantity: eight, or fewer where there are fewer than
/// 20 values for each.
/// @param degrees of freedom that each value's square is the mean of
/// @throws std::invalid_argument when there are not as many of both
BinnedRms binned_rms(std::span<const double> quantity, std::span<const double> values, long degrees = 1);

/// Of right detections: range error over range, range error over the range noise that is stated, normalised
/// error over range; and the share of balls that were found, over range. None where there is nothing to show.
/// @param sets one, or two beside each other
std::vector<Chart> detection_charts(std::span<const NamedDetections> sets);

}  // namespace stereobench::harness
