#include "harness/verify/readers/recording/recorded_log.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "harness/dataset/formats/container/ros_drive.h"

namespace stereobench::harness {
namespace {

/// A whole number of a table.
int whole_in(double value) {
  if (!(std::abs(value) <= std::numeric_limits<int>::max()) || value != std::trunc(value))
    throw std::runtime_error(fmt::format("expected a whole number (got {})", value));
  return static_cast<int>(value);
}

/// Readers of tables refuse numbers that are none.
void require_finite(const std::vector<double>& row) {
  for (const double value : row)
    if (!std::isfinite(value))
      throw std::runtime_error(fmt::format("expected finite numbers (got {})", value));
}

std::vector<LoggedSighting> sightings_in(RosVersion version, std::string_view bytes) {
  std::vector<LoggedSighting> sightings;
  const std::int64_t stamp_ns = read_ros_header(version, bytes).stamp_ns;
  for (const std::vector<double>& row : read_ros_table(version, bytes, kSightingColumns)) {
    require_finite(row);
    slam::RangeBearing& seen = sightings.emplace_back(LoggedSighting{stamp_ns, {}}).measurement;
    seen.landmark_id = whole_in(row[0]);
    seen.range_m = row[1], seen.bearing_rad = row[2];
    seen.colour_class = whole_in(row[3]);
    seen.covariance << row[4], row[5], row[5], row[6];
  }
  return sightings;
}

std::vector<LandmarkTruth> landmarks_in(RosVersion version, std::string_view bytes) {
  std::vector<LandmarkTruth> landmarks;
  for (const std::vector<double>& row : read_ros_table(version, bytes, kLandmarkColumns)) {
    require_finite(row);
    landmarks.push_back({whole_in(row[0]), whole_in(row[3]), {row[1], row[2]}});
  }
  return landmarks;
}

/// A message whose time is not after that of the one before is a fault, and left out.
class RisingTimes {
 public:
  RisingTimes(OpenRecording& from, const std::string& topic) : from_(from), topic_(topic) {}
  bool takes(std::int64_t stamp_ns) {
    if (before_ns_ && stamp_ns <= *before_ns_) {
      from_.faults.push_back(
          {from_.place_of(topic_), fmt::format("{}", stamp_ns),
           fmt::format("the time is not after that of the message before, {} ns", *before_ns_)});
      return false;
    }
    before_ns_ = stamp_ns;
    return true;
  }

 private:
  OpenRecording& from_;
  std::string topic_;
  std::optional<std::int64_t> before_ns_;
};

void read_odometry_messages(OpenRecording& from, RecordedStreams& streams) {
  RisingTimes times(from, from.odometry);
  std::optional<OdometryReading> last;
  for (const auto& [message, odometry] :
       read_messages(from, from.odometry, "nav_msgs/Odometry", read_ros_odometry)) {
    const std::int64_t stamp_ns = odometry.header.stamp_ns;
    if (!std::isfinite(odometry.v_mps) || !std::isfinite(odometry.w_radps) ||
        !std::isfinite(odometry.lateral_mps)) {
      from.faults.push_back(
          {from.place_of(from.odometry), fmt::format("{}", stamp_ns), "expected finite speeds"});
      continue;
    }
    if (!times.takes(stamp_ns)) continue;
    OdometryReading reading = {.stamp_ns = stamp_ns,
                               .v_mps = odometry.v_mps,
                               .w_radps = odometry.w_radps,
                               .lateral_mps = odometry.lateral_mps,
                               .covariance = {}};
    if (last) {
      const std::int64_t ends_ns = reading.stamp_ns;
      reading.stamp_ns = last->stamp_ns;
      streams.odometry.push_back(reading);
      reading.stamp_ns = ends_ns;
    }
    last = reading;
  }
  if (streams.odometry.empty() && last) streams.odometry.push_back(*last);
}

}  // namespace

RecordedStreams recorded_streams(OpenRecording& from) {
  RecordedStreams streams;
  if (!from.odometry.empty()) read_odometry_messages(from, streams);
  RisingTimes seen(from, "/sightings"), moved(from, "/ground_truth/pose_2d");
  for (const auto& [message, sightings] :
       read_messages(from, "/sightings", "sensor_msgs/PointCloud2", sightings_in))
    if (!sightings.empty() && seen.takes(sightings.front().stamp_ns))
      streams.sightings.insert(streams.sightings.end(), sightings.begin(), sightings.end());
  for (const auto& [message, pose] :
       read_messages(from, "/ground_truth/pose_2d", "geometry_msgs/Pose2D", read_ros_planar_pose))
    if (moved.takes(message->stamp_ns)) streams.truth.push_back({message->stamp_ns, pose});
  for (auto& [message, landmarks] :
       read_messages(from, "/ground_truth/landmarks", "sensor_msgs/PointCloud2", landmarks_in))
    streams.landmarks = landmarks;
  return streams;
}

}  // namespace stereobench::harness
