#include "harness/logs/odometry_tables.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "harness/logs/stream_cells.h"
#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "slam/models/chord.h"

namespace stereobench::harness {
namespace {

constexpr const char* kWheels = "t_s,v_mps,w_radps";
constexpr const char* kSteering = "t_s,v_mps,steering_rad,wheelbase_m";
constexpr const char* kRelativePoses =
    "from_s,to_s,x_m,y_m,theta_rad,x_var_m2,xy_m2,xt_m_rad,y_var_m2,yt_m_rad,theta_var_rad2";
constexpr std::size_t kSteeringColumns = 4;
constexpr std::size_t kRelativePoseColumns = 11;

std::vector<OdometryReading> from_steering(const NumberTable& table) {
  const std::vector<std::int64_t> stamps = stamps_from(table);
  std::vector<OdometryReading> readings;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const TableRow& row = table.rows[i];
    const double v_mps = number_in(table, row, 1);
    const double steering_rad = number_in(table, row, 2);
    const double wheelbase_m = number_in(table, row, 3);
    if (!(std::abs(steering_rad) < 0.5 * slam::kPi))
      refuse(table, row, 2, "expected radians, less than a quarter of a turn");
    if (!(wheelbase_m > 0.0)) refuse(table, row, 3, "expected metres, more than 0");
    readings.push_back({stamps[i], v_mps, v_mps * slam::tangent(steering_rad) / wheelbase_m});
  }
  return readings;
}

Eigen::Matrix3d pose_covariance_in(const NumberTable& table, const TableRow& row) {
  Eigen::Matrix3d covariance;
  std::size_t column = 5;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) covariance(i, j) = covariance(j, i) = number_in(table, row, column++);
  }
  constexpr std::array<std::size_t, 3> kVariances = {5, 8, 10};
  for (std::size_t i = 0; i < kVariances.size(); ++i) {
    if (covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) < 0.0)
      refuse(table, row, kVariances[i], "expected a variance of at least 0");
  }
  // In standard deviations, so that metres and radians compare.
  const Eigen::Vector3d scale = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::Matrix3d correlation = scale.asDiagonal() * covariance * scale.asDiagonal();
  if (Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(correlation).eigenvalues().minCoeff() < -1e-9)
    refuse(table, row, 6, "expected covariances no larger than the variances allow");
  return covariance;
}

OdometryReading reading_of(const slam::PoseBelief& motion, std::int64_t from_ns, std::int64_t to_ns) {
  const double lasts_s = 1e-9 * static_cast<double>(to_ns - from_ns);
  const slam::Control control = slam::control_of(motion, lasts_s);
  return {from_ns, control.v_mps, control.w_radps, control.lateral_mps, control.covariance, lasts_s};
}

/// After the last pose the robot stands: nothing says how it moves.
std::vector<OdometryReading> from_relative_poses(const NumberTable& table) {
  std::vector<OdometryReading> readings;
  std::int64_t last_ns = 0;
  for (const TableRow& row : table.rows) {
    const std::int64_t from_ns = stamp_ns_in(table, row, 0);
    const std::int64_t to_ns = stamp_ns_in(table, row, 1);
    if (!readings.empty() && std::abs(from_ns - last_ns) > kSameInstant_ns)
      refuse(table, row, 0, "expected the time at which the line above ends: poses follow each other");
    if (to_ns - from_ns <= kSameInstant_ns) refuse(table, row, 1, "expected a time after from_s");
    const slam::Pose end{number_in(table, row, 2), number_in(table, row, 3), angle_in(table, row, 4)};
    readings.push_back(reading_of({end, pose_covariance_in(table, row)}, from_ns, to_ns));
    last_ns = to_ns;
  }
  readings.push_back({last_ns, 0.0, 0.0});
  return readings;
}

}  // namespace

std::vector<OdometryReading> read_odometry(const std::filesystem::path& file) {
  const NumberTable table = read_csv_table(file, {kWheels, kSteering, kRelativePoses});
  if (table.rows.empty())
    throw std::runtime_error(fmt::format("{}: expected at least one reading", table.file.string()));
  if (table.columns.size() == kSteeringColumns) return from_steering(table);
  if (table.columns.size() == kRelativePoseColumns) return from_relative_poses(table);
  return odometry_from(table);
}

}  // namespace stereobench::harness
