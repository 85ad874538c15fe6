#include "harness/dataset_import/recorded_odometry.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {

std::string why_without(const RecordedStreams& streams, const Eigen::Isometry3d& body_from_robot) {
  constexpr double kSame_m = 1e-3, kSame_rad = 1e-3, kStill_mps = 1e-3;
  const Eigen::Vector3d at_m = body_from_robot.translation();
  const double turn_rad = slam::arc_tangent(body_from_robot.linear()(1, 0), body_from_robot.linear()(0, 0));
  if (at_m.head<2>().norm() > kSame_m || std::abs(turn_rad) > kSame_rad)
    return fmt::format(
        "it is that of a point from which the middle of the cameras is {:.3f} m ahead, {:.3f} m to "
        "the left and turned by {:.2f} deg",
        at_m.x(), at_m.y(), turn_rad * slam::kDegreesPerRad);
  for (const OdometryReading& reading : streams.odometry)
    if (std::abs(reading.lateral_mps) > kStill_mps)
      return fmt::format("it slides sideways, by {:.3f} m/s", reading.lateral_mps);
  return {};
}

void complete_streams(const std::vector<ViewFrame>& frames, const MeasurementLog& log,
                      RecordedStreams& streams) {
  if (streams.truth.empty())
    for (const LogStep& step : log.steps)
      if (step.truth) streams.truth.push_back({step.stamp_ns, *step.truth});
  std::set<std::int64_t> instants_ns;
  for (const ViewFrame& frame : frames) instants_ns.insert(frame.stamp_ns[0].value());
  for (const StampedPose& pose : streams.truth) instants_ns.insert(pose.stamp_ns);
  for (const LoggedSighting& sighting : streams.sightings) instants_ns.insert(sighting.stamp_ns);
  streams.instants_ns.emplace(instants_ns.begin(), instants_ns.end());
  for (OdometryReading& reading : streams.odometry) reading.lateral_mps = 0.0;  // of rounding
}

RecordedStreams since(std::int64_t epoch_ns, RecordedStreams streams) {
  for (OdometryReading& reading : streams.odometry) reading.stamp_ns -= epoch_ns;
  for (LoggedSighting& sighting : streams.sightings) sighting.stamp_ns -= epoch_ns;
  for (StampedPose& pose : streams.truth) pose.stamp_ns -= epoch_ns;
  if (streams.instants_ns)
    for (std::int64_t& stamp_ns : *streams.instants_ns) stamp_ns -= epoch_ns;
  return streams;
}

MeasurementLog since(std::int64_t epoch_ns, MeasurementLog log) {
  for (LogStep& step : log.steps) step.stamp_ns -= epoch_ns;
  return log;
}

}  // namespace stereobench::harness
