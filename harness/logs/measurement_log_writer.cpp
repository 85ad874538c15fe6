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

/// A reading per control.
void append_readings(std::int64_t from_ns, const LogStep& step, std::vector<OdometryReading>& readings) {
  double elapsed_s = 0.0;
  for (const slam::Control& control : step.odometry) {
    if (control.covariance || control.lateral_mps != 0.0)
      throw std::invalid_argument("log_files: odometry.csv has columns for wheels alone");
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

std::string odometry_csv(const MeasurementLog& log) {
  std::string csv = "t_s,v_mps,w_radps\n";
  for (const OdometryReading& reading : odometry_readings(log))
    csv += fmt::format("{},{},{}\n", seconds_of(reading.stamp_ns), reading.v_mps, reading.w_radps);
  return csv;
}

std::string observations_csv(const MeasurementLog& log) {
  std::string csv =
      "t_s,landmark_id,range_m,bearing_rad,colour_class,range_var_m2,cov_m_rad,bearing_var_rad2\n";
  for (const LogStep& step : log.steps) {
    for (const slam::RangeBearing& z : step.measurements) {
      fmt::format_to(std::back_inserter(csv), "{},{},{},{},{},{},{},{}\n", seconds_of(step.stamp_ns),
                     z.landmark_id, z.range_m, z.bearing_rad, z.colour_class, z.covariance(0, 0),
                     z.covariance(0, 1), z.covariance(1, 1));
    }
  }
  return csv;
}

std::string truth_csv(const MeasurementLog& log) {
  std::string csv = "t_s,x_m,y_m,theta_rad\n";
  for (const LogStep& step : log.steps) {
    if (!step.truth) continue;
    const slam::Pose& pose = *step.truth;
    fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", seconds_of(step.stamp_ns), pose.x_m, pose.y_m,
                   pose.heading_rad);
  }
  return csv;
}

std::string landmarks_csv(const MeasurementLog& log) {
  std::string csv = "landmark_id,x_m,y_m,colour_class\n";
  for (const LandmarkTruth& landmark : log.landmarks) {
    fmt::format_to(std::back_inserter(csv), "{},{},{},{}\n", landmark.landmark_id, landmark.position_m.x(),
                   landmark.position_m.y(), landmark.colour_class);
  }
  return csv;
}

std::string instants_csv(const MeasurementLog& log) {
  std::string csv = "t_s\n";
  for (const LogStep& step : log.steps) csv += seconds_of(step.stamp_ns) + '\n';
  return csv;
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
  std::vector<LogFile> files = {{"odometry.csv", odometry_csv(log)},
                                {"observations.csv", observations_csv(log)},
                                {"landmarks.csv", landmarks_csv(log)}};
  std::ranges::move(time_files(log), std::back_inserter(files));
  return files;
}

std::vector<LogFile> time_files(const MeasurementLog& log) {
  return {{"groundtruth.csv", truth_csv(log)}, {"instants.csv", instants_csv(log)}};
}

}  // namespace stereobench::harness
