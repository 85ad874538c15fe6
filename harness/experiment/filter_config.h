/// What filters are told before they start, as an experiment says.
#pragma once

#include "harness/experiment/types.h"

namespace stereobench::harness {

/// The sector and the rates of an oracle, as filters would have to know them.
slam::SensorSector sector_of(const worlds::OracleSensor& sensor);

/// Of the start pose (x, y, heading).
Eigen::Matrix3d start_covariance(const worlds::StartNoise& noise);

/// The settings that an experiment gives its filters.
slam::FilterConfig filter_config(const Experiment& experiment);

}  // namespace stereobench::harness
