#include "harness/scoring/association_score.h"

#include <algorithm>
#include <map>

namespace stereobench::harness {
namespace {

using slam::Decision;
using slam::kUnknown;
using slam::Outcome;

int true_landmark(int sighting, std::span<const int> truth) {
  return sighting == kUnknown ? kUnknown : truth[static_cast<std::size_t>(sighting)];
}

/// Whether a landmark was in the map before the frame whose first sighting is given.
bool was_mapped(int landmark, std::span<const int> mapped, int first_sighting, std::span<const int> truth) {
  return std::ranges::any_of(mapped, [&](int origin) {
    return origin < first_sighting && true_landmark(origin, truth) == landmark;
  });
}

}  // namespace

std::vector<int> true_landmarks(const MeasurementLog& log) {
  std::vector<int> truth;
  for (const LogStep& step : log.steps) {
    if (step.true_landmarks.size() != step.measurements.size()) return {};
    truth.insert(truth.end(), step.true_landmarks.begin(), step.true_landmarks.end());
  }
  return truth;
}

bool knows_identities(const MeasurementLog& log) {
  return std::ranges::all_of(log.steps, [](const LogStep& step) {
    return std::ranges::none_of(step.measurements, [](const slam::RangeBearing& sighting) {
      return sighting.landmark_id == kUnknown;
    });
  });
}

void judge(const slam::Decisions& decisions, std::span<const int> truth, AssociationScore& score) {
  if (decisions.sightings.empty()) return;
  const int first = decisions.sightings.front().sighting;
  for (const Decision& decision : decisions.sightings) {
    const int seen = true_landmark(decision.sighting, truth);
    const bool matched = decision.outcome == Outcome::kUse || decision.outcome == Outcome::kConfirm ||
                         decision.outcome == Outcome::kMove;
    if (matched) {
      const bool same = seen != kUnknown && true_landmark(decision.origin, truth) == seen;
      ++(same ? score.correct : score.wrong);
    } else if (seen == kUnknown) {
      ++(decision.outcome == Outcome::kAdd ? score.imagined : score.correct);
    } else {
      ++(was_mapped(seen, decisions.mapped, first, truth) ? score.missed : score.correct);
    }
  }
}

void judge_map(std::span<const slam::LandmarkEstimate> map, std::span<const int> truth,
               AssociationScore& score) {
  std::map<int, long> times;
  for (const slam::LandmarkEstimate& landmark : map) ++times[true_landmark(landmark.origin, truth)];
  for (const auto& [landmark, count] : times) {
    if (landmark == kUnknown) score.spurious += count;
    if (landmark != kUnknown) score.duplicated += count - 1;
  }
}

AssociationScore operator+(const AssociationScore& a, const AssociationScore& b) {
  return {a.correct + b.correct,   a.wrong + b.wrong,           a.missed + b.missed,
          a.imagined + b.imagined, a.duplicated + b.duplicated, a.spurious + b.spurious};
}

}  // namespace stereobench::harness
