/// Scores of many runs at once.
#pragma once

#include <span>

#include "harness/scoring/score.h"

namespace stereobench::harness {

inline FilterSummary summarise(std::span<const FilterScore> scores, int particles,
                               Seeds seeds = Seeds::kWorlds) {
  FilterTally tally;
  for (const FilterScore& score : scores) tally.add(score);
  return tally.summary(particles, seeds);
}

}  // namespace stereobench::harness
