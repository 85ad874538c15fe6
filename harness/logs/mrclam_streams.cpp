#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/logs/recorded_streams.h"
#include "harness/logs/stream_cells.h"

namespace stereobench::harness {

namespace fs = std::filesystem;

namespace {

/// Subject numbers by barcode: measurement files name barcodes, landmark files name subjects.
std::map<int, int> read_barcodes(const fs::path& folder) {
  const NumberTable table =
      read_blank_separated_table(require_plain_or_gz(folder / "Barcodes.dat"), {"Subject #", "Barcode #"});
  std::map<int, int> subjects;
  for (const TableRow& row : table.rows) {
    const int subject = whole_number_in(table, row, 0, 1);
    if (!subjects.emplace(whole_number_in(table, row, 1, 0), subject).second) {
      refuse(table, row, 1, "expected each barcode once");
    }
  }
  return subjects;
}

std::vector<LandmarkTruth> read_landmarks(const fs::path& folder) {
  const NumberTable table =
      read_blank_separated_table(require_plain_or_gz(folder / "Landmark_Groundtruth.dat"),
                                 {"Subject #", "x [m]", "y [m]", "x std-dev [m]", "y std-dev [m]"});
  for (const TableRow& row : table.rows) {
    for (const std::size_t column : {std::size_t{3}, std::size_t{4}}) {
      if (number_in(table, row, column) < 0.0) {
        refuse(table, row, column, "expected a deviation of at least 0");
      }
    }
  }
  return landmarks_from(table);
}

void read_sightings(const NumberTable& table, const std::map<int, int>& subjects, const SensorNoise& noise,
                    RecordedStreams& streams) {
  stamps_from(table);  // refuses time that runs backwards
  for (const TableRow& row : table.rows) {
    LoggedSighting sighting = sighting_from(table, row, noise);
    const auto subject = subjects.find(whole_number_in(table, row, 1, 0));
    if (subject == subjects.end()) {
      ++streams.unknown_barcodes;
    } else if (subject->second <= kMrclamRobots) {
      ++streams.robot_sightings;
    } else {
      sighting.measurement.landmark_id = subject->second;
      streams.sightings.push_back(sighting);
    }
  }
}

/// Counts all stamps from the whole second of the first odometry reading.
void count_from_first_second(RecordedStreams& streams) {
  const std::int64_t first_ns = streams.odometry.front().stamp_ns;
  const std::int64_t rest_ns = ((first_ns % kSecond_ns) + kSecond_ns) % kSecond_ns;
  const std::int64_t epoch_ns = first_ns - rest_ns;
  for (OdometryReading& reading : streams.odometry) reading.stamp_ns -= epoch_ns;
  for (LoggedSighting& sighting : streams.sightings) sighting.stamp_ns -= epoch_ns;
  for (StampedPose& pose : streams.truth) pose.stamp_ns -= epoch_ns;
}

}  // namespace

RecordedStreams read_mrclam_streams(const fs::path& folder, int robot, const SensorNoise& noise) {
  const auto file = [&](const char* what) { return folder / fmt::format("Robot{}_{}.dat", robot, what); };
  RecordedStreams streams;
  streams.odometry = odometry_from(
      read_blank_separated_table(require_plain_or_gz(file("Odometry")),
                                 {"Time [s]", "forward velocity [m/s]", "angular velocity[rad/s]"}));
  const NumberTable measurements = read_blank_separated_table(
      require_plain_or_gz(file("Measurement")), {"Time [s]", "Subject #", "range [m]", "bearing [rad]"});
  read_sightings(measurements, read_barcodes(folder), noise, streams);
  streams.noise_is_assumed = !streams.sightings.empty();
  if (const auto truth = find_plain_or_gz(file("Groundtruth"))) {
    streams.truth =
        truth_from(read_blank_separated_table(*truth, {"Time [s]", "x [m]", "y [m]", "orientation [rad]"}));
  }
  streams.landmarks = read_landmarks(folder);
  count_from_first_second(streams);
  return streams;
}

}  // namespace stereobench::harness
