// What several tests of the SLAM stage need: poses that are close, and a small world to drive in.
#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "slam/filter_registry.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {

// NaN fails: every comparison is written so that only a proof of closeness passes.
inline ::testing::AssertionResult near(const Pose& a, const Pose& b, double tolerance) {
  const double off =
      std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) + std::abs(wrap_angle(a.heading_rad - b.heading_rad));
  if (off <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "(" << a.x_m << ", " << a.y_m << ", " << a.heading_rad << ") is " << off << " from (" << b.x_m
         << ", " << b.y_m << ", " << b.heading_rad << ")";
}

template <class A, class B>
::testing::AssertionResult near(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b,
                                double tolerance) {
  const double off = (a - b).cwiseAbs().maxCoeff();
  if (off <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\n" << a << "\nis " << off << " from\n" << b;
}

inline bool all_finite(const Estimate& estimate) {
  bool finite = std::isfinite(estimate.pose.x_m) && std::isfinite(estimate.pose.y_m) &&
                std::isfinite(estimate.pose.heading_rad) && estimate.covariance.allFinite() &&
                std::isfinite(estimate.effective_particles);
  for (const LandmarkEstimate& landmark : estimate.landmarks) {
    finite = finite && landmark.position_m.allFinite() && landmark.covariance.allFinite();
  }
  return finite;
}

// A sighting with independent noise of the given standard deviations, which is also what it claims.
inline RangeBearing sighting(const Eigen::Vector2d& range_bearing, double range_sd_m, double bearing_sd_rad) {
  RangeBearing seen;
  seen.range_m = range_bearing.x();
  seen.bearing_rad = range_bearing.y();
  seen.covariance = Eigen::Vector2d(range_sd_m * range_sd_m, bearing_sd_rad * bearing_sd_rad).asDiagonal();
  return seen;
}

// A lap around a square block with landmarks on both sides, seen up to a range within the half plane ahead.
struct Drive {
  double side_m = 20.0;
  int laps = 1;
  double speed_mps = 1.0;
  double step_s = 0.5;
  double range_sd_m = 0.1;
  double bearing_sd_rad = 0.02;
  double max_range_m = 12.0;
  OdometryNoise odometry_noise{0.05, 0.0, 0.0, 0.02, 0.0, 0.0};
  bool looks_at_start = false;

  std::vector<Control> controls() const {
    std::vector<Control> list;
    const int straight = static_cast<int>(std::lround(side_m / (speed_mps * step_s)));
    for (int side = 0; side < 4 * laps; ++side) {
      list.insert(list.end(), static_cast<std::size_t>(straight), Control{speed_mps, 0.0, step_s});
      list.insert(list.end(), 4, Control{speed_mps, M_PI / 8.0 / step_s, step_s});
    }
    return list;
  }

  std::vector<Eigen::Vector2d> landmarks() const {
    std::vector<Eigen::Vector2d> places;
    for (double along = 1.0; along < side_m; along += 4.0) {
      for (const double off : {-3.0, 3.5}) {
        places.insert(
            places.end(),
            {{along, off}, {side_m - off, along}, {side_m - along, side_m - off}, {off, side_m - along}});
      }
    }
    return places;
  }

  std::vector<RangeBearing> look(const Pose& truth, RandomStream& noise) const {
    std::vector<RangeBearing> seen;
    const std::vector<Eigen::Vector2d> places = landmarks();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Eigen::Vector2d exact = predict_sighting(truth, places[i]);
      if (exact.x() < 0.5 || exact.x() > max_range_m || std::abs(exact.y()) > M_PI / 2.0) continue;
      RangeBearing one = sighting(exact, range_sd_m, bearing_sd_rad);
      one.range_m = std::abs(one.range_m + range_sd_m * noise.normal());
      one.bearing_rad = wrap_angle(one.bearing_rad + bearing_sd_rad * noise.normal());
      one.landmark_id = static_cast<int>(i);
      seen.push_back(one);
    }
    return seen;
  }
};

// How far a filter was from the truth over a drive.
struct DriveScore {
  double rms_m = 0.0;
  double map_rms_m = 0.0;
  Estimate last;
};

// @param visit (const Estimate& without map, const Pose& truth) after each step
template <class Visit>
DriveScore drive(Filter filter, const Drive& world, std::uint64_t seed, const Visit& visit) {
  RandomStream odometry(seed, Stream::kOdometry);
  RandomStream sensor(seed, Stream::kOracle);
  Pose truth;
  DriveScore score;
  const std::vector<Control> controls = world.controls();
  if (world.looks_at_start) update(filter, world.look(truth, sensor));
  for (const Control& control : controls) {
    truth = advance(truth, control);
    predict(filter, perturb(control, world.odometry_noise, odometry));
    update(filter, world.look(truth, sensor));
    const Estimate now = estimate_without_map(filter);
    score.rms_m += std::pow(now.pose.x_m - truth.x_m, 2) + std::pow(now.pose.y_m - truth.y_m, 2);
    visit(now, truth);
  }
  score.rms_m = std::sqrt(score.rms_m / static_cast<double>(controls.size()));
  score.last = estimate(filter);
  const std::vector<Eigen::Vector2d> places = world.landmarks();
  for (const LandmarkEstimate& landmark : score.last.landmarks) {
    score.map_rms_m +=
        (landmark.position_m - places[static_cast<std::size_t>(landmark.landmark_id)]).squaredNorm();
  }
  score.map_rms_m =
      std::sqrt(score.map_rms_m / std::fmax(1.0, static_cast<double>(score.last.landmarks.size())));
  return score;
}

inline DriveScore drive(Filter filter, const Drive& world, std::uint64_t seed) {
  return drive(std::move(filter), world, seed, [](const Estimate&, const Pose&) {});
}

// Two laps of a room where bearings are off by 14 degrees.
inline Drive drive_with_poor_bearings() {
  Drive world;
  world.side_m = 12.0;
  world.laps = 2;
  world.max_range_m = 30.0;
  world.range_sd_m = 0.3;
  world.bearing_sd_rad = 0.25;
  world.odometry_noise = {0.3, 0.0, 0.0, 0.05, 0.0, 0.0};
  return world;
}

}  // namespace stereobench::slam
