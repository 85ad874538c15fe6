/// Whether a sensor's errors last from one sighting of a landmark to the next.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "slam/filter_config.h"
#include "slam/reference/batch.h"

namespace stereobench::slam {

/// Errors of range and bearing of which each sighting of a landmark keeps exp(-gap / time) from the one
/// before: an autoregressive process of first order.
struct LastingErrors {
  Eigen::Vector2d time_s = Eigen::Vector2d::Zero();       ///< of (range, bearing); 0 = each error is its own
  Eigen::Vector2d correlation = Eigen::Vector2d::Zero();  ///< over the gap
  double gap_s = 0.0;  ///< mean time between two sightings of a landmark that follow each other soon
};

/// Correlation from which on errors are taken to last.
inline constexpr double kCorrelated = 0.5;

/// Finds how long errors last from pairs of sightings of a landmark that follow each other.
///
/// Of a sensor whose errors are their own the innovations of a filter that is right are independent, however
/// many there are. Here they are those of an iterated EKF, in standard deviations. A filter that is told too
/// precise an odometry lags behind, and its innovations are correlated as well: it is told the odometry's
/// noise that the log has (fit_noise). Correlations are taken over pairs within twice the median gap; one
/// that is chance, or below kCorrelated, is taken for none.
///
/// @param config as the filter is told
/// @param start world_from_robot before the first control
LastingErrors find_lasting_errors(const FilterConfig& config, const Pose& start,
                                  std::span<const BatchStep> steps);

/// Makes the standard deviations of sightings larger, so that many in close order weigh little more than one:
/// the variance of a sighting that comes `gap` after the last one of its landmark is divided by 1 - exp(-gap
/// / time). A landmark then counts about once in the time that its errors last. Sightings of one instant have
/// the same gap.
///
/// @param time_s of (range, bearing); 0 = each error is its own
/// @param steps whose sightings receive RangeBearing::sd_scale; whose each is, is decided by an iterated EKF
/// where they do not say so
void weigh_by_gaps(const FilterConfig& config, const Pose& start, const Eigen::Vector2d& time_s,
                   std::span<BatchStep> steps);

}  // namespace stereobench::slam
