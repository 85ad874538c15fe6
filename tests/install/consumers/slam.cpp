// A robot drives on a circle. Its odometry says a tenth too much; four landmarks tell the filter better.
#include <cmath>
#include <cstdio>
#include <vector>

#include "slam/filter_registry.h"

using namespace stereobench;

int main() {
  const std::vector<Eigen::Vector2d> landmarks_m = {{4.0, 0.0}, {4.0, 3.0}, {0.0, 4.0}, {-1.0, 2.0}};
  slam::FilterConfig config;
  config.odometry_noise = {.v_constant_mps = 0.2, .w_constant_radps = 0.1};
  slam::Filter ekf = slam::make_filter("ekf", config, slam::Pose{}, 1);
  slam::Filter odometry = slam::make_filter("dead_reckoning", config, slam::Pose{}, 1);

  Eigen::Vector2d robot_m(0.0, 0.0);
  for (int step = 0; step <= 20; ++step) {
    const double heading_rad = 0.05 * step;  // 1 m/s and 0.5 rad/s for a tenth of a second each
    robot_m = {2.0 * std::sin(heading_rad), 2.0 - 2.0 * std::cos(heading_rad)};
    if (step > 0)
      for (slam::Filter* filter : {&ekf, &odometry})
        predict(*filter, {.v_mps = 1.1, .w_radps = 0.5, .duration_s = 0.1});
    std::vector<slam::RangeBearing> sightings;
    for (std::size_t i = 0; i < landmarks_m.size(); ++i) {
      const Eigen::Vector2d way_m = landmarks_m[i] - robot_m;
      slam::RangeBearing sighting;
      sighting.range_m = way_m.norm();
      sighting.bearing_rad = std::remainder(std::atan2(way_m.y(), way_m.x()) - heading_rad, 2.0 * M_PI);
      sighting.covariance = Eigen::Vector2d(1e-4, 1e-5).asDiagonal();
      sighting.landmark_id = static_cast<int>(i);
      sightings.push_back(sighting);
    }
    update(ekf, sightings);
  }

  const auto error_m = [&](const slam::Filter& filter) {
    const slam::Pose pose = estimate(filter).pose;
    return (Eigen::Vector2d(pose.x_m, pose.y_m) - robot_m).norm();
  };
  std::printf("odometry is %.3f m off, the filter %.3f m\n", error_m(odometry), error_m(ekf));
  return error_m(ekf) < 0.02 && error_m(odometry) > 0.1 ? 0 : 1;
}
