/// The kinds of odometry that a measurement log may have.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/logs/recorded_streams.h"

namespace stereobench::harness {

/// Reads `odometry.csv`, whose header says which kind it is:
///
/// - velocities of wheels: `t_s,v_mps,w_radps`;
/// - a car's, by its steering: `t_s,v_mps,steering_rad,wheelbase_m`. The turn rate of its rear axle's
/// midpoint is
///   v tan(steering) / wheelbase;
/// - poses relative to the one before, with their covariance, as cameras or scans give them:
///   `from_s,to_s,x_m,y_m,theta_rad,x_var_m2,xy_m2,xt_m_rad,y_var_m2,yt_m_rad,theta_var_rad2`, in the robot
///   frame at from_s. A line begins where the one above ends.
///
/// @param file plain or gzip
/// @return at least one reading, in order of time
/// @throws std::runtime_error `file:line: column: what was expected`
std::vector<OdometryReading> read_odometry(const std::filesystem::path& file);

}  // namespace stereobench::harness
