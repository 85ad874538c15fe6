#include "harness/logs/measurement_log_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace stereobench::harness {

namespace {

constexpr std::int64_t kTolerance_ns = 1'000;

bool same(const slam::Pose& a, const slam::Pose& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.heading_rad == b.heading_rad;
}

/// @param motion a control or a reading
template <class Motion>
void require_wheels(const Motion& motion) {
  if (motion.covariance || motion.lateral_mps != 0.0)
    throw std::invalid_argument("log_files: odometry.csv has columns for wheels alone");
}

/// A reading per control.
void append_readings(std::int64_t from_ns, const LogStep& step, std::vector<OdometryReading>& readings) {
  double elapsed_s = 0.0;
  for (const slam::Control& control : step.odometry) {
    require_wheels(control);
    const std::int64_t begin_ns = from_ns + std::llround(elapsed_s * 1e9);
    readings.push_back({.stamp_ns = begin_ns, .v_mps = control.v_mps, .w_radps = control.w_radps});
    elapsed_s += control.duration_s;
  }
  if (std::abs(from_ns + std::llround(elapsed_s * 1e9) - step.stamp_ns) > kTolerance_ns) {
    throw std::invalid_argument(fmt::format("log_files: odometry up to {} s lasts {} s, the step {} s",
                                            seconds_of(step.stamp_ns), elapsed_s,
                                            static_cast<double>(step.stamp_ns - from_ns) * 1e-9));
  }
}

std::string odometry_csv(const std::vector<OdometryReading>& readings) {
  std::string csv = "t_s,v_mps,w_radps\n";
  for (const OdometryReading& reading : readings) {
    require_wheels(reading);
    csv += fmt::format("{},{},{}\n", seconds_of(reading.stamp_ns), reading.v_mps, reading.w_radps);
  }
  return csv;
}

std::string observations_csv(const std::vector<LoggedSighting>& sightings) {
  std::string csv =
      "t_s,landmark_id,range_m,bearing_rad,colour_class,range_var_m2,cov_m_rad,bearing_var_rad2\n";
  for (const auto& [stamp_ns, z] : sightings)
    fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{}\n", seconds_of(stamp_ns), z.landmark_id,
                   z.range_m, z.bearing_rad, z.colour_class, z.covariance(0, 0), z.covariance(0, 1),
                   z.covariance(1, 1));
  return csv;
}

std::string truth_csv(const std::vector<StampedPose>& truth) {
  std::string csv = "t_s,x_m,y_m,theta_rad\n";
  for (const auto& [stamp_ns, pose] : truth)
    fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", seconds_of(stamp_ns), pose.x_m, pose.y_m,
                   pose.heading_rad);
  return csv;
}

std::string landmarks_csv(const std::vector<LandmarkTruth>& landmarks) {
  std::string csv = "landmark_id,x_m,y_m,colour_class\n";
  for (const LandmarkTruth& landmark : landmarks)
    fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", landmark.landmark_id, landmark.position_m.x(),
                   landmark.position_m.y(), landmark.colour_class);
  return csv;
}

std::string instants_csv(const std::vector<std::int64_t>& instants_ns) {
  std::string csv = "t_s\n";
  for (const std::int64_t stamp_ns : instants_ns) csv += seconds_of(stamp_ns) + '\n';
  return csv;
}

/// All of a log but its odometry.
RecordedStreams streams_of(const MeasurementLog& log) {
  RecordedStreams streams;
  streams.landmarks = log.landmarks;
  streams.instants_ns.emplace();
  for (const LogStep& step : log.steps) {
    streams.instants_ns->push_back(step.stamp_ns);
    if (step.truth) streams.truth.push_back({step.stamp_ns, *step.truth});
    for (const slam::RangeBearing& z : step.measurements) streams.sightings.push_back({step.stamp_ns, z});
  }
  return streams;
}

std::vector<LogFile> time_files(const RecordedStreams& streams) {
  std::vector<LogFile> files = {{"groundtruth.csv", truth_csv(streams.truth)}};
  if (streams.instants_ns) files.push_back({"instants.csv", instants_csv(*streams.instants_ns)});
  return files;
}

}  // namespace

std::string seconds_of(std::int64_t stamp_ns) {
  const std::int64_t magnitude_ns = std::abs(stamp_ns);
  return fmt::format("{}{}.{:09}", stamp_ns < 0 ? "-" : "", magnitude_ns / kSecond_ns,
                     magnitude_ns % kSecond_ns);
}

std::vector<OdometryReading> odometry_readings(const MeasurementLog& log) {
  if (!log.steps.front().odometry.empty()) {
    throw std::invalid_argument("log_files: the first step has odometry, but there is no time before it");
  }
  std::vector<OdometryReading> readings;
  for (std::size_t i = 1; i < log.steps.size(); ++i)
    append_readings(log.steps[i - 1].stamp_ns, log.steps[i], readings);
  if (log.steps.size() == 1) readings.push_back({.stamp_ns = log.steps.front().stamp_ns});
  return readings;
}

std::vector<LogFile> log_files(const MeasurementLog& log) {
  if (log.steps.empty()) throw std::invalid_argument("log_files: a log has at least one step");
  if (!same(log.start, log.steps.front().truth.value_or(slam::Pose{}))) {
    throw std::invalid_argument("log_files: a reader starts at the first step's truth, this log does not");
  }
  RecordedStreams streams = streams_of(log);
  streams.odometry = odometry_readings(log);
  return log_files(streams);
}

std::vector<LogFile> log_files(const RecordedStreams& streams) {
  std::vector<LogFile> files = {{"odometry.csv", odometry_csv(streams.odometry)},
                                {"observations.csv", observations_csv(streams.sightings)},
                                {"landmarks.csv", landmarks_csv(streams.landmarks)}};
  std::ranges::move(time_files(streams), std::back_inserter(files));
  return files;
}

std::vector<LogFile> time_files(const MeasurementLog& log) {
  return time_files(streams_of(log));
}

}  // namespace stereobench::harness
