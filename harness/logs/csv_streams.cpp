#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/logs/odometry_tables.h"
#include "harness/logs/recorded_streams.h"
#include "harness/logs/stream_cells.h"

namespace stereobench::harness {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kTruthHeaders = {"t_s,x_m,y_m,theta_rad"};
const std::vector<std::string> kInstantHeaders = {"t_s"};
const std::vector<std::string> kLandmarkHeaders = {"landmark_id,x_m,y_m", "landmark_id,x_m,y_m,colour_class"};
const std::vector<std::string> kSightingHeaders = {
    "t_s,landmark_id,range_m,bearing_rad", "t_s,landmark_id,range_m,bearing_rad,colour_class",
    "t_s,landmark_id,range_m,bearing_rad,colour_class,range_var_m2,cov_m_rad,bearing_var_rad2"};

Eigen::Matrix2d covariance_in(const NumberTable& table, const TableRow& row) {
  const double range_var_m2 = number_in(table, row, 5);
  const double cov_m_rad = number_in(table, row, 6);
  const double bearing_var_rad2 = number_in(table, row, 7);
  if (range_var_m2 < 0.0) refuse(table, row, 5, "expected a variance of at least 0");
  if (bearing_var_rad2 < 0.0) refuse(table, row, 7, "expected a variance of at least 0");
  if (cov_m_rad * cov_m_rad > range_var_m2 * bearing_var_rad2 * (1.0 + 1e-12)) {
    refuse(table, row, 6, "expected a covariance no larger than the variances allow");
  }
  Eigen::Matrix2d covariance;
  covariance << range_var_m2, cov_m_rad, cov_m_rad, bearing_var_rad2;
  return covariance;
}

/// Column 1 is the identity; `colour_class` and the covariance follow where the header names them.
std::vector<LoggedSighting> sightings_from(const NumberTable& table, const SensorNoise& noise) {
  stamps_from(table);  // refuses time that runs backwards
  std::vector<LoggedSighting> sightings;
  sightings.reserve(table.rows.size());
  for (const TableRow& row : table.rows) {
    LoggedSighting sighting = sighting_from(table, row, noise);
    sighting.measurement.landmark_id = whole_number_in(table, row, 1, slam::kUnknown);
    if (table.columns.size() > 4) {
      sighting.measurement.colour_class = whole_number_in(table, row, 4, slam::kUnknown);
    }
    if (table.columns.size() > 5) sighting.measurement.covariance = covariance_in(table, row);
    sightings.push_back(sighting);
  }
  return sightings;
}

std::vector<LandmarkTruth> coloured_landmarks_from(const NumberTable& table) {
  std::vector<LandmarkTruth> landmarks = landmarks_from(table);
  if (table.columns.size() > 3) {
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      landmarks[i].colour_class = whole_number_in(table, table.rows[i], 3, slam::kUnknown);
    }
  }
  return landmarks;
}

/// Whether a sorted list has a stamp within the resolution of another.
bool has_instant(const std::vector<std::int64_t>& instants_ns, std::int64_t stamp_ns) {
  const auto next = std::lower_bound(instants_ns.begin(), instants_ns.end(), stamp_ns - kSameInstant_ns);
  return next != instants_ns.end() && *next <= stamp_ns + kSameInstant_ns;
}

std::vector<std::int64_t> instants_from(const NumberTable& table) {
  const std::vector<std::int64_t> instants = stamps_from(table);
  if (instants.empty()) {
    throw std::runtime_error(fmt::format("{}: expected at least one instant", table.file.string()));
  }
  for (std::size_t i = 1; i < instants.size(); ++i) {
    if (instants[i] == instants[i - 1]) {
      refuse(table, table.rows[i], 0, "expected a time after the line above");
    }
  }
  return instants;
}

}  // namespace

RecordedStreams read_csv_streams(const fs::path& folder, const SensorNoise& noise) {
  RecordedStreams streams;
  const fs::path odometry_file = require_plain_or_gz(folder / "odometry.csv");
  streams.odometry = read_odometry(odometry_file);
  streams.odometry_states_noise = streams.odometry.front().covariance.has_value();
  const NumberTable observations =
      read_csv_table(require_plain_or_gz(folder / "observations.csv"), kSightingHeaders);
  streams.sightings = sightings_from(observations, noise);
  streams.noise_is_assumed = observations.columns.size() <= 5 && !streams.sightings.empty();
  if (const auto file = find_plain_or_gz(folder / "groundtruth.csv")) {
    streams.truth = truth_from(read_csv_table(*file, kTruthHeaders));
  }
  const fs::path above = fs::absolute(folder).lexically_normal() / ".." / "landmarks.csv";
  auto landmarks = find_plain_or_gz(folder / "landmarks.csv");
  if (!landmarks) landmarks = find_plain_or_gz(above.lexically_normal());
  if (landmarks) streams.landmarks = coloured_landmarks_from(read_csv_table(*landmarks, kLandmarkHeaders));
  if (const auto file = find_plain_or_gz(folder / "instants.csv")) {
    streams.instants_ns = instants_from(read_csv_table(*file, kInstantHeaders));
    for (std::size_t i = 0; i < streams.sightings.size(); ++i) {
      if (has_instant(*streams.instants_ns, streams.sightings[i].stamp_ns)) continue;
      refuse(observations, observations.rows[i], 0, "expected one of the times of instants.csv");
    }
  }
  return streams;
}

}  // namespace stereobench::harness
