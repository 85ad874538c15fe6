#include "harness/drive/detection_stage.h"

#include <utility>

#include "harness/drive/perfect_detections.h"
#include "harness/vision_scoring/rig_check.h"

namespace stereobench::harness {

DetectionStage::DetectionStage(const Experiment& experiment, const worlds::World& world, std::uint64_t seed)
    : scenario_(experiment.scenario), world_(world), perfect_(experiment.perfect_detections) {
  if (const auto& faults = experiment.detector_noise)
    faults_.emplace(without_perfect(perfect_, *faults), scenario_, world, seed);
}

FrameMatch DetectionStage::match(std::vector<BallInPair> outlines,
                                 std::span<const vision::BallObservation> observations) const {
  return match_observations(world_, scenario_.rig, std::move(outlines), observations);
}

ArrivedDetections DetectionStage::arriving(std::size_t frame, std::vector<BallInPair> outlines,
                                           std::vector<vision::BallObservation> observations) {
  FrameMatch found = match(std::move(outlines), observations);
  if (perfect_.names) {
    give_true_names(world_, found, observations);
    found = match(std::move(found.outlines), observations);
  }
  std::vector<int> balls = balls_observed(found);
  if (!faults_ && !perfect_.places) return {std::move(observations), std::move(found), std::move(balls)};
  std::vector<TracedDetection> detections = traced(observations, found);
  if (faults_) detections = faults_->worsen(frame, std::move(detections));
  if (perfect_.places) detections = at_true_places(scenario_, world_, found.outlines, detections);
  if (faults_) detections = faults_->delay(frame, std::move(detections));
  observations = observations_of(detections);
  found = match(std::move(found.outlines), observations);
  return {std::move(observations), std::move(found), balls_of(detections)};
}

Sightings DetectionStage::take(const ArrivedDetections& arrived) {
  const worlds::World& meant = scenario_.world;
  score_ += score_match(arrived.match);
  score_.rig += check_rig(scenario_.believed_rig, {meant.ball_radius_m(), meant.ball_radius_sd_m},
                          arrived.observations);
  Sightings sightings = sightings_of(arrived.observations, arrived.balls, world_.balls, scenario_.identity);
  if (perfect_.names) tell_names(sightings);
  return sightings;
}

std::optional<FaultCounts> DetectionStage::fault_counts() const {
  return faults_ ? std::optional(faults_->counts()) : std::nullopt;
}

}  // namespace stereobench::harness
