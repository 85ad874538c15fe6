#include "harness/logs/measurement_log_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/io/number_table.h"
#include "harness/logs/log_steps.h"
#include "harness/logs/odometry_delay.h"
#include "harness/logs/recorded_streams.h"
#include "harness/logs/repeated_sightings.h"

namespace stereobench::harness {

namespace fs = std::filesystem;

namespace {

constexpr double kLongestDelay_s = 60.0;

bool is_csv_file(const std::string& name) {
  for (const char* stem : {"odometry", "observations", "landmarks", "groundtruth", "instants"}) {
    if (name == fmt::format("{}.csv", stem) || name == fmt::format("{}.csv.gz", stem)) return true;
  }
  return false;
}

/// The robot that one of MRCLAM's files is about.
std::optional<int> robot_of(const std::string& name) {
  for (int robot = 1; robot <= kMrclamRobots; ++robot) {
    for (const char* what : {"Odometry", "Measurement", "Groundtruth"}) {
      const std::string plain = fmt::format("Robot{}_{}.dat", robot, what);
      if (name == plain || name == plain + ".gz") return robot;
    }
  }
  return {};
}

RecordedStreams read_file_named(const fs::path& file, const SensorNoise& noise) {
  const std::string name = file.filename().string();
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (is_csv_file(name)) return read_csv_streams(folder, noise);
  if (const auto robot = robot_of(name)) return read_mrclam_streams(folder, *robot, noise);
  throw std::runtime_error(fmt::format(
      "{}: expected a log's folder, its odometry.csv[.gz] or its Robot<k>_Odometry.dat[.gz]", file.string()));
}

RecordedStreams read_folder(const fs::path& folder, const SensorNoise& noise) {
  std::vector<int> robots;
  for (int robot = 1; robot <= kMrclamRobots; ++robot) {
    if (find_plain_or_gz(folder / fmt::format("Robot{}_Odometry.dat", robot))) robots.push_back(robot);
  }
  if (find_plain_or_gz(folder / "odometry.csv")) return read_csv_streams(folder, noise);
  if (robots.size() == 1) return read_mrclam_streams(folder, robots.front(), noise);
  if (robots.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: expected odometry.csv or Robot<k>_Odometry.dat in it, plain or .gz", folder.string()));
  }
  throw std::runtime_error(fmt::format("{}: holds robots {}; name one, as in {}", folder.string(),
                                       fmt::join(robots, ", "),
                                       (folder / fmt::format("Robot{}_Odometry.dat", robots[0])).string()));
}

void note_truth(const MeasurementLog& log, LogFacts& facts) {
  const auto has_truth = [](const LogStep& step) { return step.truth.has_value(); };
  const auto first = std::ranges::find_if(log.steps, has_truth);
  facts.steps = static_cast<long>(log.steps.size());
  facts.steps_without_truth = facts.steps - std::ranges::count_if(log.steps, has_truth);
  facts.has_truth = first != log.steps.end();
  if (facts.has_truth)
    facts.truth_starts_s = 1e-9 * static_cast<double>(first->stamp_ns - log.steps.front().stamp_ns);
}

}  // namespace

RecordedLog read_log(const fs::path& folder_or_file, const LogAssumptions& assumptions) {
  const SensorNoise& noise = assumptions.noise;
  if (!(noise.range_sd_m > 0.0 && noise.bearing_sd_rad > 0.0 && std::isfinite(noise.range_sd_m) &&
        std::isfinite(noise.bearing_sd_rad))) {
    throw std::invalid_argument("read_log: standard deviations must be positive and finite");
  }
  if (!(std::abs(assumptions.odometry_delay_s.value_or(0.0)) <= kLongestDelay_s)) {
    throw std::invalid_argument("read_log: the odometry's delay must be within a minute");
  }
  if (!fs::exists(folder_or_file)) {
    throw std::runtime_error(fmt::format("{}: no such file or folder", folder_or_file.string()));
  }
  RecordedStreams streams = fs::is_directory(folder_or_file) ? read_folder(folder_or_file, noise)
                                                             : read_file_named(folder_or_file, noise);
  LogFacts facts;
  facts.robot_sightings = streams.robot_sightings;
  facts.unknown_barcodes = streams.unknown_barcodes;
  facts.noise_is_assumed = streams.noise_is_assumed;
  facts.odometry_states_noise = streams.odometry_states_noise;
  facts.repeated_sightings = drop_repeated(streams.sightings);
  facts.concurrent_sightings = count_concurrent(streams.sightings);
  const OdometryDelay delay = assumptions.odometry_delay_s
                                  ? OdometryDelay{*assumptions.odometry_delay_s, DelaySource::kStated}
                                  : estimate_odometry_delay(streams);
  facts.odometry_delay_s = delay.delay_s;
  facts.delay_source = delay.source;
  delay_odometry(streams.odometry, delay.delay_s);
  try {
    MeasurementLog log = steps_from_streams(streams);
    note_truth(log, facts);
    return {std::move(log), facts};
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", folder_or_file.string(), error.what()));
  }
}

}  // namespace stereobench::harness
