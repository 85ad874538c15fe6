#include "harness/detector_faults/detection.h"

#include <algorithm>
#include <map>

#include "harness/detector_faults/fault_draws.h"

namespace stereobench::harness {
namespace {

/// Numbers the detections of a frame.
void give_keys(std::vector<TracedDetection>& detections) {
  std::map<int, int> repeats;
  for (TracedDetection& detection : detections)
    detection.key = detection_key(detection.ball, repeats[detection.ball]++);
}

}  // namespace

std::vector<TracedDetection> traced(std::span<const vision::BallObservation> observations,
                                    const FrameMatch& match) {
  std::vector<TracedDetection> detections;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    TracedDetection& detection = detections.emplace_back();
    detection.seen = observations[i];
    if (const auto outline = match.observations[i].outline) {
      const BallInPair& ball = match.outlines[*outline];
      detection.ball = ball.ball;
      detection.visible_fraction = std::min(ball.left_fraction, ball.right_fraction);
    }
  }
  give_keys(detections);
  return detections;
}

std::vector<TracedDetection> traced(const worlds::Sightings& sensed) {
  std::vector<TracedDetection> detections;
  for (std::size_t i = 0; i < sensed.measurements.size(); ++i) {
    TracedDetection& detection = detections.emplace_back();
    detection.seen.has_pixels = detection.seen.has_radii = false;
    detection.seen.range_bearing = sensed.measurements[i];
    detection.seen.colour = sensed.measurements[i].colour_class;
    detection.ball = sensed.balls[i];
  }
  give_keys(detections);
  return detections;
}

std::vector<vision::BallObservation> observations_of(std::span<const TracedDetection> detections) {
  std::vector<vision::BallObservation> observations;
  for (const TracedDetection& detection : detections) observations.push_back(detection.seen);
  return observations;
}

std::vector<int> balls_of(std::span<const TracedDetection> detections) {
  std::vector<int> balls;
  for (const TracedDetection& detection : detections) balls.push_back(detection.ball);
  return balls;
}

worlds::Sightings oracle_sightings(std::span<const TracedDetection> detections) {
  worlds::Sightings sensed{{}, balls_of(detections)};
  for (const TracedDetection& detection : detections)
    sensed.measurements.push_back(detection.seen.range_bearing);
  return sensed;
}

}  // namespace stereobench::harness
