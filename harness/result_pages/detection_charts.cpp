#include "harness/result_pages/detection_charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <Eigen/LU>

#include "harness/statistics/chi_square.h"
#include "harness/vision_scoring/detection_outcome.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

constexpr double kMillimetres = 1e3;
constexpr std::size_t kMostDots = 1500;
constexpr std::size_t kMostBins = 8;
constexpr std::size_t kLeastInBin = 20;

/// Right detections that state their noise: one value each.
struct StatedNoise {
  std::vector<double> range_m;
  std::vector<double> range_error_mm;
  std::vector<double> range_sd_mm;
  std::vector<double> normalised;  ///< root of e' R^-1 e / 2
};

/// What charts are drawn from: one value a right detection.
struct RightDetections {
  std::vector<double> range_m;
  std::vector<double> range_error_mm;
  StatedNoise stated;
};

RightDetections right_ones(std::span<const DetectionRow> rows) {
  RightDetections right;
  for (const DetectionRow& row : rows) {
    if (row.outcome != text_of(DetectionOutcome::kTruePositive)) continue;
    const double range_error_mm = kMillimetres * row.range_error_m();
    if (!std::isfinite(range_error_mm)) continue;
    right.range_m.push_back(row.true_range_m);
    right.range_error_mm.push_back(range_error_mm);
    const Eigen::Vector2d error(row.range_error_m(),
                                slam::wrap_angle(row.bearing_rad - row.true_bearing_rad));
    const double half_nis = 0.5 * error.dot(row.covariance.inverse() * error);
    if (!std::isfinite(half_nis) || half_nis < 0.0) continue;
    right.stated.range_m.push_back(row.true_range_m);
    right.stated.range_error_mm.push_back(range_error_mm);
    right.stated.range_sd_mm.push_back(kMillimetres * std::sqrt(row.covariance(0, 0)));
    right.stated.normalised.push_back(std::sqrt(half_nis));
  }
  return right;
}

/// At most so many values, evenly spread.
std::vector<double> thinned(const std::vector<double>& values, std::size_t most) {
  const std::size_t stride = values.size() / (most + 1) + 1;
  std::vector<double> few;
  for (std::size_t i = 0; i < values.size(); i += stride) few.push_back(values[i]);
  return few;
}

Series rms_series(const std::string& name, const BinnedRms& bins) {
  return {.name = name, .look = Look::kLine, .x = bins.at, .y = bins.rms, .low = bins.low, .high = bins.high};
}

Series level(const std::string& name, const std::vector<double>& x, double y) {
  if (x.empty()) return {.name = name, .look = Look::kDashes};
  const auto [first, last] = std::ranges::minmax(x);
  return {.name = name, .look = Look::kDashes, .x = {first, last}, .y = {y, y}};
}

std::string named(const NamedDetections& set, const char* what) {
  return set.name.empty() ? what : set.name;
}

Chart range_chart(std::span<const NamedDetections> sets, const std::vector<RightDetections>& right) {
  Chart chart{.name = "range error over range", .x_label = "true range [m]", .y_label = "range error [mm]"};
  for (std::size_t i = 0; i < sets.size(); ++i)
    chart.series.push_back(
        rms_series(named(sets[i], "rms"), binned_rms(right[i].range_m, right[i].range_error_mm)));
  for (std::size_t i = 0; i < sets.size(); ++i)
    chart.series.push_back({.name = sets[i].name + (sets[i].name.empty() ? "" : ", ") + "single detections",
                            .look = Look::kPoints,
                            .x = thinned(right[i].range_m, kMostDots),
                            .y = thinned(right[i].range_error_mm, kMostDots)});
  return chart;
}

Chart noise_chart(std::span<const NamedDetections> sets, const std::vector<RightDetections>& right) {
  Chart chart{.name = "range error over stated noise",
              .x_label = "standard deviation of the range, as stated [mm]",
              .y_label = "rms range error [mm]",
              .x_is_logarithmic = true,
              .y_is_logarithmic = true};
  std::vector<double> all_sds;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const BinnedRms bins = binned_rms(right[i].stated.range_sd_mm, right[i].stated.range_error_mm);
    chart.series.push_back(rms_series(named(sets[i], "rms"), bins));
    all_sds.insert(all_sds.end(), bins.at.begin(), bins.at.end());
  }
  std::ranges::sort(all_sds);
  chart.series.push_back({.name = "consistent", .look = Look::kDashes, .x = all_sds, .y = all_sds});
  return chart;
}

Chart consistency_chart(std::span<const NamedDetections> sets, const std::vector<RightDetections>& right) {
  Chart chart{.name = "normalised error over range",
              .x_label = "true range [m]",
              .y_label = "rms error / stated noise",
              .y_is_logarithmic = true};
  for (std::size_t i = 0; i < sets.size(); ++i)
    chart.series.push_back(rms_series(named(sets[i], "rms"),
                                      binned_rms(right[i].stated.range_m, right[i].stated.normalised, 2)));
  chart.series.push_back(level("consistent", right.back().stated.range_m, 1.0));
  return chart;
}

Chart recall_chart(std::span<const NamedDetections> sets) {
  Chart chart{.name = "found balls over range",
              .x_label = "true range [m]",
              .y_label = "share of the balls that had to be found"};
  for (const NamedDetections& set : sets) {
    std::vector<double> range_m, is_found;
    for (const DetectionRow& row : set.rows) {
      const bool found = row.outcome == text_of(DetectionOutcome::kTruePositive);
      if (!row.is_required || (!found && row.outcome != kMiss)) continue;
      range_m.push_back(row.true_range_m);
      is_found.push_back(found ? 1.0 : 0.0);
    }
    BinnedRms bins = binned_rms(range_m, is_found);  // of zeros and ones the mean square is the mean
    for (double& share : bins.rms) share *= share;
    chart.series.push_back({.name = named(set, "found"), .x = bins.at, .y = bins.rms});
  }
  return chart;
}

}  // namespace

BinnedRms binned_rms(std::span<const double> quantity, std::span<const double> values, long degrees) {
  if (quantity.size() != values.size())
    throw std::invalid_argument("binned_rms: expected one value for each quantity");
  BinnedRms bins;
  if (quantity.empty()) return bins;
  std::vector<std::size_t> order(quantity.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return quantity[i]; });
  const std::size_t parts = std::clamp<std::size_t>(order.size() / kLeastInBin, 1, kMostBins);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t first = part * order.size() / parts;
    const std::size_t last = (part + 1) * order.size() / parts;
    const auto count = static_cast<double>(last - first);
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = first; i < last; ++i) {
      sum += quantity[order[i]];
      squares += values[order[i]] * values[order[i]];
    }
    const long of_bin = degrees * static_cast<long>(last - first);
    const double scaled = static_cast<double>(degrees) * squares;
    bins.at.push_back(sum / count);
    bins.rms.push_back(std::sqrt(squares / count));
    bins.low.push_back(std::sqrt(scaled / chi_square_quantile(0.975, of_bin)));
    bins.high.push_back(std::sqrt(scaled / chi_square_quantile(0.025, of_bin)));
  }
  return bins;
}

std::vector<Chart> detection_charts(std::span<const NamedDetections> sets) {
  std::vector<RightDetections> right;
  bool any = false;
  for (const NamedDetections& set : sets) {
    right.push_back(right_ones(set.rows));
    any = any || !right.back().range_m.empty();
  }
  if (!any) return {};
  return {range_chart(sets, right), noise_chart(sets, right), consistency_chart(sets, right),
          recall_chart(sets)};
}

}  // namespace stereobench::harness
