/// What the sightings of a log say of their sensor.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "harness/logs/measurement_log_reader.h"
#include "slam/filter_config.h"

namespace stereobench::harness {

/// Tells filters the sector of a sensor that nobody describes (slam::find_sector), where some sightings have
/// no identity. What was found is noted in the log's facts.
///
/// @param config whose sector receives it
void find_sensor_sector(RecordedLog& recorded, slam::FilterConfig& config);

/// Finds how long the errors of a log's sightings last (slam::find_lasting_errors), and makes sightings in
/// close order less certain (slam::weigh_by_gaps). What was found is noted in the log's facts. The truth is
/// not looked at.
///
/// @param config as filters are told
/// @param stated_s of (range, bearing), where the caller knows how long errors last; 0 = each is its own
void weigh_sightings(RecordedLog& recorded, const slam::FilterConfig& config,
                     const std::optional<Eigen::Vector2d>& stated_s);

}  // namespace stereobench::harness
