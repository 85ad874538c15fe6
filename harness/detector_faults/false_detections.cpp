#include "harness/detector_faults/false_detections.h"

#include <cmath>

#include "harness/detector/detection_lines.h"
#include "harness/detector_faults/fault_draws.h"
#include "slam/math/elementary.h"
#include "slam/models/motion.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

/// A place in a sector, uniform over its area.
slam::RangeBearing somewhere(double within_m, double half_angle_rad, slam::RandomStream& draws) {
  slam::RangeBearing seen;
  seen.range_m = within_m * std::sqrt(draws.uniform());  // area grows with the square
  seen.bearing_rad = slam::wrap_angle(half_angle_rad * (2.0 * draws.uniform() - 1.0));
  return seen;
}

int some_colour(const std::vector<int>& colours, slam::RandomStream& draws) {
  const double index = std::floor(draws.uniform() * static_cast<double>(colours.size()));
  return colours.empty() ? slam::kUnknown : colours[static_cast<std::size_t>(index)];
}

/// Puts a ball where it is seen; false where it is not within both pictures.
bool put(const BallGeometry& geometry, const slam::RangeBearing& where, vision::BallObservation& ball) {
  ball.range_bearing = where;
  ball.ball_in_camera = at_camera_height(geometry.rig, where);
  const vision::Intrinsics& camera = geometry.rig.intrinsics;
  return imagine_pixels(geometry, ball) && vision::is_inside(camera, ball.left_px) &&
         vision::is_inside(camera, ball.right_px);
}

}  // namespace

// The product of uniform numbers falls below e^-mean after Poisson many of them (Knuth).
int false_count(double mean, std::uint64_t seed, std::size_t frame) {
  slam::RandomStream draws = fault_draws(seed, FaultDraw::kFalseCount, frame, 0);
  const double limit = slam::exponential(-mean);
  int count = 0;
  for (double product = draws.uniform(); product > limit; product *= draws.uniform()) ++count;
  return count;
}

std::optional<TracedDetection> false_in_pictures(double within_m, const BallGeometry& geometry,
                                                 const std::vector<int>& colours, std::uint64_t seed,
                                                 std::size_t frame, int number) {
  constexpr int kMostTries = 1000;
  const vision::Intrinsics& camera = geometry.rig.intrinsics;
  const double half_angle_rad = slam::arc_tangent(0.5 * camera.width_px, camera.focal_px);
  slam::RandomStream draws = fault_draws(seed, FaultDraw::kFalse, frame, static_cast<std::uint64_t>(number));
  TracedDetection imagined;
  vision::BallObservation& ball = imagined.seen;
  ball.has_radii = false;
  ball.colour = some_colour(colours, draws);
  for (int i = 0; i < kMostTries; ++i) {
    if (!put(geometry, somewhere(within_m, half_angle_rad, draws), ball)) continue;
    ball.range_bearing.covariance = seen_through(geometry, ball, kUnstatedSd_px).covariance;
    ball.range_bearing.colour_class = ball.colour;
    return imagined;
  }
  return {};
}

TracedDetection false_in_sector(const worlds::OracleSensor& sensor, worlds::Identity identity,
                                const std::vector<int>& colours, std::uint64_t seed, std::size_t frame,
                                int number) {
  slam::RandomStream draws = fault_draws(seed, FaultDraw::kFalse, frame, static_cast<std::uint64_t>(number));
  TracedDetection imagined;
  vision::BallObservation& ball = imagined.seen;
  ball.has_radii = ball.has_pixels = false;
  const int colour = some_colour(colours, draws);
  if (identity == worlds::Identity::kColourClass) ball.colour = colour;
  ball.range_bearing = somewhere(sensor.max_range_m, sensor.field_of_view_rad / 2.0, draws);
  ball.range_bearing.covariance.diagonal() << sensor.range_sd_m * sensor.range_sd_m,
      sensor.bearing_sd_rad * sensor.bearing_sd_rad;
  ball.range_bearing.colour_class = ball.colour;
  return imagined;
}

}  // namespace stereobench::harness
