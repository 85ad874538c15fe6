#include "slam/association/decisions.h"

namespace stereobench::slam {

std::vector<Decision> after_merging(std::span<const Decision> decisions, std::span<const Merged> merged) {
  std::vector<Decision> after(decisions.begin(), decisions.end());
  for (auto& [sighting, outcome, origin] : after) {
    for (const auto& [kept, dropped] : merged) {
      const bool found_it = outcome == Outcome::kAdd && sighting == dropped;
      if (!found_it && origin != dropped) continue;
      if (found_it) outcome = Outcome::kUse;
      origin = kept;
    }
  }
  return after;
}

}  // namespace stereobench::slam
