#include "harness/detector_faults/faulty_detector.h"

#include <utility>

#include "harness/detector_faults/false_detections.h"
#include "harness/detector_faults/misses.h"
#include "harness/detector_faults/names.h"

namespace stereobench::harness {
namespace {

std::vector<std::int64_t> stamps_of(const worlds::GroundTruth& path) {
  std::vector<std::int64_t> stamps_ns;
  for (const worlds::PathStep& step : path) stamps_ns.push_back(step.stamp_ns);
  return stamps_ns;
}

std::vector<int> colours_of(const worlds::World& world) {
  std::vector<int> colours;
  for (const worlds::Ball& ball : world.balls) colours.push_back(ball.colour);
  return colours;
}

std::optional<BallGeometry> geometry_of(const worlds::Scenario& scenario) {
  if (scenario.sensor == worlds::SensorKind::kOracle) return {};
  return BallGeometry{scenario.believed_rig, scenario.world.ball_radius_m()};
}

long size_of(const std::vector<TracedDetection>& detections) {
  return static_cast<long>(detections.size());
}

}  // namespace

FaultyDetector::FaultyDetector(const DetectorFaults& faults, const worlds::Scenario& scenario,
                               const worlds::World& world, std::uint64_t seed)
    : faults_(faults),
      seed_(seed),
      identity_(scenario.identity),
      oracle_(scenario.oracle),
      geometry_(geometry_of(scenario)),
      colours_(colours_of(world)),
      noise_(faults, seed, stamps_of(scenario.path)) {}

std::vector<TracedDetection> FaultyDetector::worsen(std::size_t frame,
                                                    std::vector<TracedDetection> detections) {
  const std::vector<bool> renamed = give_wrong_names(faults_, seed_, frame, detections);
  std::vector<TracedDetection> left;
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (!is_still_seen(frame, detections[i])) {
      ++counts_.lost;
      continue;
    }
    if (renamed[i]) ++counts_.renamed;
    left.push_back(detections[i]);
  }
  add_false(frame, left);
  if (faults_.covariance_scale != 1.0)
    for (TracedDetection& detection : left)
      detection.seen.range_bearing.covariance *= faults_.covariance_scale;
  return left;
}

bool FaultyDetector::is_still_seen(std::size_t frame, TracedDetection& detection) {
  const double probability =
      loss_probability(faults_, detection.seen.range_bearing.range_m, detection.visible_fraction);
  if (probability > 0.0 && is_lost(faults_, seed_, frame, detection.key, probability)) return false;
  return move(frame, detection);
}

bool FaultyDetector::move(std::size_t frame, TracedDetection& detection) {
  CentreFate fate = CentreFate::kLeft;
  if (geometry_ && moves_centres(faults_))
    fate = move_centres(faults_, *geometry_, noise_.at(frame, detection.key), detection.seen);
  if (fate == CentreFate::kLost) return false;
  detection.seen.range_bearing.range_m *= faults_.range_scale;
  if (fate == CentreFate::kMoved || faults_.range_scale != 1.0) ++counts_.moved;
  return true;
}

void FaultyDetector::add_false(std::size_t frame, std::vector<TracedDetection>& detections) {
  const int count = faults_.false_per_frame > 0.0 ? false_count(faults_.false_per_frame, seed_, frame) : 0;
  for (int i = 0; i < count; ++i) {
    if (!geometry_) {
      detections.push_back(false_in_sector(oracle_, identity_, colours_, seed_, frame, i));
    } else {
      auto imagined = false_in_pictures(faults_.false_within_m, *geometry_, colours_, seed_, frame, i);
      if (!imagined) continue;
      detections.push_back(*imagined);
    }
    ++counts_.added;
  }
}

std::vector<TracedDetection> FaultyDetector::delay(std::size_t frame,
                                                   std::vector<TracedDetection> detections) {
  const std::size_t latency = latency_frames();
  if (latency == 0) return detections;
  on_their_way_[frame] = std::move(detections);
  std::vector<TracedDetection> arrived;
  while (on_their_way_.begin()->first + latency <= frame) {
    const auto look = on_their_way_.extract(on_their_way_.begin());
    if (look.key() + latency == frame) {
      arrived = look.mapped();
      counts_.delayed += size_of(arrived);
    } else {
      counts_.undelivered += size_of(look.mapped());
    }
  }
  return arrived;
}

FaultCounts FaultyDetector::counts() const {
  FaultCounts counts = counts_;
  for (const auto& [frame, detections] : on_their_way_) counts.undelivered += size_of(detections);
  return counts;
}

}  // namespace stereobench::harness
