#include "slam/diagnosis/decided_log.h"

#include <map>
#include <utility>

namespace stereobench::slam {
namespace {

/// Names landmarks by the sighting that founded them, or found them anew.
class Names {
 public:
  /// @return kUnknown for a sighting of nothing
  int of(const Decision& decision) {
    const auto& [number, outcome, origin] = decision;
    if (outcome == Outcome::kAdd) return number;
    if (origin == kUnknown) return kUnknown;
    if (outcome == Outcome::kMove) return renamed_[origin] = number;
    return now(origin);
  }

  void merge(const Merged& merged) { kept_[now(merged.dropped)] = now(merged.kept); }

  /// @return the name of a landmark once all is known
  int at_last(int name) const {
    for (auto found = kept_.find(name); found != kept_.end(); found = kept_.find(name)) name = found->second;
    return name;
  }

 private:
  int now(int origin) const {
    const auto found = renamed_.find(origin);
    return found == renamed_.end() ? origin : found->second;
  }

  std::map<int, int> renamed_;  ///< landmarks that were found anew, by origin
  std::map<int, int> kept_;     ///< in place of names that were dropped
};

}  // namespace

DecidedLog decide(const FilterConfig& config, const Pose& start, std::span<const BatchStep> steps) {
  EkfSlam filter(config, start, Linearisation::kIterated);
  DecidedLog log;
  Names names;
  int first = 0;  // number of the step's first sighting
  for (const BatchStep& step : steps) {
    for (const Control& control : step.controls) filter.predict(control);
    filter.update(step.sightings);
    BatchStep& decided = log.steps.emplace_back();
    decided.controls = step.controls;
    std::vector<int>& landmarks = log.landmarks.emplace_back(step.sightings.size(), kUnknown);
    if (step.sightings.empty()) continue;
    const bool drifted = !filter.drift().isZero();
    for (const Decision& decision : filter.decided()) {
      const int landmark = names.of(decision);
      const auto k = static_cast<std::size_t>(decision.sighting - first);
      landmarks[k] = landmark;
      const bool refused = drifted || decision.outcome == Outcome::kRefuse;
      log.refused += refused ? 1 : 0;
      if (refused || landmark == kUnknown || decision.outcome == Outcome::kIgnore) continue;
      decided.sightings.push_back(step.sightings[k]);
      decided.sightings.back().landmark_id = landmark;
    }
    for (const Merged& merged : filter.merged()) names.merge(merged);
    first += static_cast<int>(step.sightings.size());
  }
  for (BatchStep& step : log.steps) {
    for (RangeBearing& sighting : step.sightings) sighting.landmark_id = names.at_last(sighting.landmark_id);
  }
  for (std::vector<int>& landmarks : log.landmarks) {
    for (int& landmark : landmarks) landmark = names.at_last(landmark);
  }
  return log;
}

}  // namespace stereobench::slam
