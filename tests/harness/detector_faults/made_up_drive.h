/// A drive without pictures: a robot that stands before balls which a perfect detector finds in every frame.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "harness/detector/ball_geometry.h"
#include "harness/detector_faults/fault_draws.h"
#include "harness/detector_faults/faulty_detector.h"
#include "slam/math/elementary.h"

namespace stereobench::harness {

/// 99 % of a normal distribution lie within so many standard deviations.
inline constexpr double kWithin99 = 2.5758;

struct MadeUpDrive {
  worlds::Scenario scenario;
  std::vector<TracedDetection> perfect;  ///< of each frame
};

/// @param balls between 1.5 m and 3 m ahead, of the palette's first colours
/// @param sensor the oracle's detections have no pixels
inline MadeUpDrive made_up_drive(std::size_t frames, int balls = 4,
                                 worlds::SensorKind sensor = worlds::SensorKind::kStereo) {
  constexpr std::int64_t kStep_ns = 100'000'000;
  MadeUpDrive drive;
  drive.scenario.sensor = sensor;
  for (std::size_t i = 0; i < frames; ++i)
    drive.scenario.path.push_back({.stamp_ns = static_cast<std::int64_t>(i) * kStep_ns});
  for (int i = 0; i < balls; ++i) {
    drive.scenario.world.balls.push_back({.colour = i});
    TracedDetection& detection = drive.perfect.emplace_back();
    const double part = balls > 1 ? static_cast<double>(i) / (balls - 1) : 0.5;
    slam::RangeBearing& seen = detection.seen.range_bearing;
    seen.range_m = 1.5 + 1.5 * part;
    seen.bearing_rad = 0.4 * (part - 0.5);
    seen.colour_class = detection.seen.colour = i;
    detection.ball = i;
    detection.key = detection_key(i, 0);
    detection.visible_fraction = 1.0;
    detection.seen.has_pixels = detection.seen.has_radii = sensor == worlds::SensorKind::kStereo;
    if (!detection.seen.has_pixels) continue;
    const BallGeometry geometry{drive.scenario.believed_rig, 0.05};
    detection.seen.ball_in_camera = at_camera_height(geometry.rig, seen);
    imagine_pixels(geometry, detection.seen);
  }
  return drive;
}

/// What arrived at each frame.
using Arrived = std::vector<std::vector<TracedDetection>>;

struct FaultyDrive {
  Arrived frames;
  FaultCounts counts;
};

/// @param find gives each frame's detections in place of the perfect ones
inline FaultyDrive drive_with(const DetectorFaults& faults, const MadeUpDrive& drive, std::uint64_t seed = 1,
                              const std::function<std::vector<TracedDetection>(std::size_t)>& find = {}) {
  FaultyDetector detector(faults, drive.scenario, drive.scenario.world, seed);
  FaultyDrive faulty;
  for (std::size_t i = 0; i < drive.scenario.path.size(); ++i)
    faulty.frames.push_back(detector.arriving(i, find ? find(i) : drive.perfect));
  faulty.counts = detector.counts();
  return faulty;
}

/// Columns and rows of both cameras.
inline Eigen::Vector4d pixels_of(const TracedDetection& detection) {
  return (Eigen::Vector4d() << detection.seen.left_px, detection.seen.right_px).finished();
}

/// The errors of a ball's centres, frame by frame; all its detections must be there.
inline std::vector<Eigen::Vector4d> centre_errors(const Arrived& frames, const MadeUpDrive& drive,
                                                  std::size_t ball) {
  std::vector<Eigen::Vector4d> errors;
  for (const auto& detections : frames)
    errors.push_back(pixels_of(detections.at(ball)) - pixels_of(drive.perfect[ball]));
  return errors;
}

/// Whether a share that was counted is what was asked for: within the 99 % interval of so many draws.
inline bool is_share(long count, long draws, double asked) {
  const double n = static_cast<double>(draws);
  return std::abs(static_cast<double>(count) / n - asked) <= kWithin99 * std::sqrt(asked * (1.0 - asked) / n);
}

}  // namespace stereobench::harness
