#include "harness/detector_faults/names.h"

#include <algorithm>
#include <utility>

#include "harness/detector_faults/fault_draws.h"

namespace stereobench::harness {
namespace {

/// What a detection claims to be of.
struct Name {
  int colour = slam::kUnknown;
  int landmark_id = slam::kUnknown;

  bool operator==(const Name&) const = default;
};

Name name_of(const vision::BallObservation& seen) {
  return {seen.colour, seen.range_bearing.landmark_id};
}

void give(const Name& name, vision::BallObservation& seen) {
  seen.colour = seen.range_bearing.colour_class = name.colour;
  seen.range_bearing.landmark_id = name.landmark_id;
}

bool has_name(const TracedDetection& detection) {
  return detection.seen.trusted() && name_of(detection.seen) != Name();
}

/// Indices of detections that have a name, in random order: two and two of them are a pair.
std::vector<std::size_t> paired(std::uint64_t seed, std::size_t frame,
                                const std::vector<TracedDetection>& detections) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < detections.size(); ++i)
    if (has_name(detections[i]))
      order.emplace_back(fault_draws(seed, FaultDraw::kPairing, frame, detections[i].key).uniform(), i);
  std::ranges::sort(order);
  std::vector<std::size_t> indices;
  for (const auto& [draw, index] : order) indices.push_back(index);
  return indices;
}

void swap_names(double probability, std::uint64_t seed, std::size_t frame,
                std::vector<TracedDetection>& detections) {
  const std::vector<std::size_t> order = paired(seed, frame, detections);
  for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
    TracedDetection& one = detections[order[i]];
    TracedDetection& other = detections[order[i + 1]];
    const std::uint64_t pair = std::min(one.key, other.key);
    if (fault_draws(seed, FaultDraw::kSwap, frame, pair).uniform() >= probability) continue;
    const Name name = name_of(one.seen);
    give(name_of(other.seen), one.seen);
    give(name, other.seen);
  }
}

/// What a colour is taken for: itself for small draws, so that more confusion changes no colour back.
int confused(const std::vector<double>& row, int colour, double draw) {
  double sum = row[static_cast<std::size_t>(colour)];
  int taken_for = colour;
  for (int other = 0; draw >= sum && other < static_cast<int>(row.size()); ++other) {
    if (other == colour || row[static_cast<std::size_t>(other)] == 0.0) continue;
    taken_for = other;
    sum += row[static_cast<std::size_t>(other)];
  }
  return taken_for;
}

void confuse(const std::vector<std::vector<double>>& confusion, std::uint64_t seed, std::size_t frame,
             TracedDetection& detection) {
  const int colour = detection.seen.colour;
  if (!has_name(detection) || colour < 0 || colour >= static_cast<int>(confusion.size())) return;
  const double draw = fault_draws(seed, FaultDraw::kConfusion, frame, detection.key).uniform();
  const int taken_for = confused(confusion[static_cast<std::size_t>(colour)], colour, draw);
  if (taken_for != colour) give({taken_for, detection.seen.range_bearing.landmark_id}, detection.seen);
}

}  // namespace

std::vector<bool> give_wrong_names(const DetectorFaults& faults, std::uint64_t seed, std::size_t frame,
                                   std::vector<TracedDetection>& detections) {
  std::vector<Name> before;
  for (const TracedDetection& detection : detections) before.push_back(name_of(detection.seen));
  if (faults.identity_swap_probability > 0.0)
    swap_names(faults.identity_swap_probability, seed, frame, detections);
  for (TracedDetection& detection : detections) confuse(faults.confusion, seed, frame, detection);
  std::vector<bool> renamed;
  for (std::size_t i = 0; i < detections.size(); ++i)
    renamed.push_back(name_of(detections[i].seen) != before[i]);
  return renamed;
}

}  // namespace stereobench::harness
