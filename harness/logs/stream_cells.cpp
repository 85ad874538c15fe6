#include "harness/logs/stream_cells.h"

#include <cmath>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "slam/math/angles.h"
#include "slam/models/motion.h"

namespace stereobench::harness {

double angle_in(const NumberTable& table, const TableRow& row, std::size_t column) {
  const double angle = number_in(table, row, column);
  if (std::abs(angle) > 2.0 * slam::kPi) {
    refuse(table, row, column, "expected radians, at most a full turn");
  }
  return slam::wrap_angle(angle);
}

std::vector<std::int64_t> stamps_from(const NumberTable& table) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(table.rows.size());
  for (const TableRow& row : table.rows) {
    const std::int64_t stamp = stamp_ns_in(table, row, 0);
    if (!stamps.empty() && stamp < stamps.back()) {
      refuse(table, row, 0, "expected a time not before the line above");
    }
    stamps.push_back(stamp);
  }
  return stamps;
}

std::vector<OdometryReading> odometry_from(const NumberTable& table) {
  if (table.rows.empty()) {
    throw std::runtime_error(fmt::format("{}: expected at least one reading", table.file.string()));
  }
  const std::vector<std::int64_t> stamps = stamps_from(table);
  std::vector<OdometryReading> readings;
  readings.reserve(stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const TableRow& row = table.rows[i];
    readings.push_back({stamps[i], number_in(table, row, 1), number_in(table, row, 2)});
  }
  return readings;
}

std::vector<StampedPose> truth_from(const NumberTable& table) {
  const std::vector<std::int64_t> stamps = stamps_from(table);
  std::vector<StampedPose> poses;
  poses.reserve(stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const TableRow& row = table.rows[i];
    if (i > 0 && stamps[i] == stamps[i - 1]) {
      refuse(table, row, 0, "expected a time after the line above: there is one truth at a time");
    }
    const slam::Pose pose{number_in(table, row, 1), number_in(table, row, 2), angle_in(table, row, 3)};
    poses.push_back({stamps[i], pose});
  }
  return poses;
}

std::vector<LandmarkTruth> landmarks_from(const NumberTable& table) {
  std::vector<LandmarkTruth> landmarks;
  std::set<int> ids;
  for (const TableRow& row : table.rows) {
    const int id = whole_number_in(table, row, 0, 0);
    if (!ids.insert(id).second) refuse(table, row, 0, "expected each identity once");
    const Eigen::Vector2d position(number_in(table, row, 1), number_in(table, row, 2));
    landmarks.push_back({id, slam::kUnknown, position});
  }
  return landmarks;
}

LoggedSighting sighting_from(const NumberTable& table, const TableRow& row, const SensorNoise& noise) {
  LoggedSighting sighting;
  sighting.stamp_ns = stamp_ns_in(table, row, 0);
  sighting.measurement.range_m = number_in(table, row, 2);
  if (sighting.measurement.range_m < 0.0) refuse(table, row, 2, "expected a range of at least 0");
  sighting.measurement.bearing_rad = angle_in(table, row, 3);
  const Eigen::Vector2d deviations(noise.range_sd_m, noise.bearing_sd_rad);
  sighting.measurement.covariance = deviations.cwiseAbs2().asDiagonal();
  return sighting;
}

}  // namespace stereobench::harness
