#include "harness/detector_faults/centre_noise.h"

#include <cmath>
#include <optional>
#include <utility>

#include "harness/detector_faults/fault_draws.h"
#include "slam/math/elementary.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

constexpr double kNsPerS = 1e9;

CentreShift bias_of(const DetectorFaults& faults) {
  return (CentreShift() << faults.centre_bias_px[0], faults.centre_bias_px[1]).finished();
}

CentreShift centres_of(const vision::BallObservation& seen) {
  return (CentreShift() << seen.left_px, seen.right_px).finished();
}

std::optional<Eigen::Vector3d> place_by(const BallGeometry& geometry, const vision::BallObservation& seen) {
  return place_of(geometry, rectified_centres(geometry, seen));
}

/// Moves range and bearing with the ball. @param moved_m in the left camera's frame
void move_range_bearing(const vision::StereoRig& rig, const Eigen::Vector3d& moved_m,
                        slam::RangeBearing& seen) {
  const auto [s, c] = slam::sine_cosine(seen.bearing_rad);
  const Eigen::Vector3d in_robot = vision::robot_from_camera(rig).linear() * moved_m;
  const Eigen::Vector2d place = seen.range_m * Eigen::Vector2d(c, s) + in_robot.head<2>();
  seen.range_m = place.norm();
  seen.bearing_rad = slam::arc_tangent(place.y(), place.x());
}

}  // namespace

CentreNoise::CentreNoise(const DetectorFaults& faults, std::uint64_t seed,
                         std::vector<std::int64_t> stamps_ns)
    : faults_(faults), seed_(seed), stamps_ns_(std::move(stamps_ns)) {}

CentreShift CentreNoise::at(std::size_t frame, std::uint64_t detection) {
  if (faults_.centre_sd_px == 0.0) return CentreShift::Zero();
  const bool is_tail =
      fault_draws(seed_, FaultDraw::kTail, frame, detection).uniform() < faults_.heavy_tail.share;
  const double sd_px = faults_.centre_sd_px * (is_tail ? faults_.heavy_tail.sd_scale : 1.0);
  return sd_px * (faults_.correlated_s > 0.0 ? lasting(frame, detection) : fresh(frame, detection));
}

CentreShift CentreNoise::fresh(std::size_t frame, std::uint64_t detection) const {
  slam::RandomStream draws = fault_draws(seed_, FaultDraw::kCentre, frame, detection);
  CentreShift shift;
  for (double& coordinate : shift) coordinate = draws.normal();
  return shift;
}

// A Gauss-Markov process that is stationary from the first frame on.
CentreShift CentreNoise::lasting(std::size_t frame, std::uint64_t detection) {
  auto found = lasting_.find(detection);
  if (found == lasting_.end() || found->second.frame > frame)
    found = lasting_.insert_or_assign(detection, Lasting{0, fresh(0, detection)}).first;
  Lasting& last = found->second;
  while (last.frame < frame) {
    const double passed_s =
        static_cast<double>(stamps_ns_[last.frame + 1] - stamps_ns_[last.frame]) / kNsPerS;
    const double kept = slam::exponential(-passed_s / faults_.correlated_s);
    ++last.frame;
    last.shift = kept * last.shift + std::sqrt(1.0 - kept * kept) * fresh(last.frame, detection);
  }
  return last.shift;
}

double centre_variance_px2(const DetectorFaults& faults) {
  const double scale = faults.heavy_tail.sd_scale;
  const double tail = 1.0 + faults.heavy_tail.share * (scale * scale - 1.0);
  return faults.centre_sd_px * faults.centre_sd_px * tail + faults.quantise_px * faults.quantise_px / 12.0;
}

bool moves_centres(const DetectorFaults& faults) {
  return faults.centre_sd_px > 0.0 || faults.quantise_px > 0.0 || !bias_of(faults).isZero(0.0);
}

CentreFate move_centres(const DetectorFaults& faults, const BallGeometry& geometry, const CentreShift& noise,
                        vision::BallObservation& seen) {
  vision::BallObservation moved = seen;
  if (!seen.has_pixels) {
    moved.ball_in_camera = at_camera_height(geometry.rig, seen.range_bearing);
    if (!imagine_pixels(geometry, moved)) return CentreFate::kLeft;
  }
  const auto before = place_by(geometry, moved);
  if (!before) return CentreFate::kLeft;
  CentreShift centres = centres_of(moved) + noise + bias_of(faults);
  if (faults.quantise_px > 0.0)
    for (double& coordinate : centres)
      coordinate = faults.quantise_px * std::round(coordinate / faults.quantise_px);
  moved.left_px = centres.head<2>();
  moved.right_px = centres.tail<2>();
  const auto after = place_by(geometry, moved);
  if (!after) return CentreFate::kLost;
  const Eigen::Vector3d moved_m = *after - *before;
  moved.ball_in_camera += moved_m;
  move_range_bearing(geometry.rig, moved_m, moved.range_bearing);
  const double variance_px2 = centre_variance_px2(faults);
  if (faults.covariance == StatedCovariance::kHonest && variance_px2 > 0.0) {
    vision::BallObservation by_pixels = moved;
    by_pixels.ball_in_camera = *after;
    moved.range_bearing.covariance += seen_through(geometry, by_pixels, std::sqrt(variance_px2)).covariance;
  }
  seen = moved;
  return CentreFate::kMoved;
}

}  // namespace stereobench::harness
