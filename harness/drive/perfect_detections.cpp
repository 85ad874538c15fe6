#include "harness/drive/perfect_detections.h"

#include <algorithm>
#include <optional>
#include <set>

#include "harness/detector/ball_geometry.h"
#include "harness/detector/detection_lines.h"
#include "slam/models/measurement.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using vision::BallObservation;

/// A ball where its outlines' true centres put it.
/// @param colour that it is called
/// @return empty where the rig as it is believed to be has no place for these centres
std::optional<BallObservation> at_true_centres(const worlds::Scenario& scenario, const BallInPair& ball,
                                               int colour) {
  const vision::StereoRig& rig = scenario.rig;
  const BallGeometry believed = {scenario.believed_rig, scenario.world.ball_radius_m()};
  const auto taken_px = [&](const vision::OutlineEllipse& outline) -> Eigen::Vector2d {
    return vision::image_point(rig, vision::pixel_ray(rig.intrinsics, outline.centre_px));
  };
  BallObservation seen;
  seen.colour = colour;
  seen.left_px = taken_px(ball.left);
  seen.right_px = taken_px(ball.right);
  seen.left_radius_px = ball.left.radius_px();
  seen.right_radius_px = ball.right.radius_px();
  const auto place = place_of(believed, rectified_centres(believed, seen));
  if (!place) return {};
  seen.ball_in_camera = *place;
  seen.range_bearing = seen_through(believed, seen, kUnstatedSd_px);
  seen.range_bearing.colour_class = colour;
  return seen;
}

int colour_of(const worlds::World& world, int ball) {
  return world.balls[static_cast<std::size_t>(ball)].colour;
}

}  // namespace

void give_true_names(const worlds::World& world, const FrameMatch& match,
                     std::vector<BallObservation>& observations) {
  for (std::size_t i = 0; i < observations.size(); ++i)
    if (const auto outline = match.observations[i].outline)
      observations[i].colour = observations[i].range_bearing.colour_class =
          colour_of(world, match.outlines[*outline].ball);
}

std::vector<TracedDetection> at_true_places(const worlds::Scenario& scenario, const worlds::World& world,
                                            std::span<const BallInPair> outlines,
                                            std::span<const TracedDetection> detections) {
  std::vector<TracedDetection> perfect;
  std::set<int> found;
  for (const TracedDetection& detection : detections) {
    const auto ball = std::ranges::find(outlines, detection.ball, &BallInPair::ball);
    if (ball == outlines.end() || !found.insert(detection.ball).second) continue;
    const auto seen = at_true_centres(scenario, *ball, detection.seen.colour);
    if (!seen) continue;
    perfect.push_back(detection);
    perfect.back().seen = *seen;
    perfect.back().seen.range_bearing.covariance = detection.seen.range_bearing.covariance;
  }
  for (const BallInPair& ball : outlines) {
    if (!is_whole(ball) || !found.insert(ball.ball).second) continue;
    if (const auto seen = at_true_centres(scenario, ball, colour_of(world, ball.ball)))
      perfect.push_back({.seen = *seen, .ball = ball.ball});
  }
  return perfect;
}

void put_at_true_places(const worlds::World& world, const slam::Pose& world_from_robot,
                        std::vector<TracedDetection>& detections) {
  for (TracedDetection& detection : detections) {
    if (detection.ball == slam::kUnknown) continue;
    const Eigen::Vector3d& centre_m = world.balls[static_cast<std::size_t>(detection.ball)].centre_m;
    const Eigen::Vector2d truth = slam::predict_sighting(world_from_robot, centre_m.head<2>());
    detection.seen.range_bearing.range_m = truth.x();
    detection.seen.range_bearing.bearing_rad = truth.y();
  }
}

DetectorFaults without_perfect(const PerfectDetections& perfect, const DetectorFaults& faults) {
  DetectorFaults left = faults;
  if (perfect.places) {
    left.miss_probability = left.false_per_frame = 0.0;
    left.miss_by_visible.clear();
    left.miss_by_range.clear();
  }
  if (perfect.names) {
    left.identity_swap_probability = 0.0;
    left.confusion.clear();
  }
  return left;
}

}  // namespace stereobench::harness
