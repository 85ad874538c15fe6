#include "slam/association/association.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace stereobench::slam {

void assign(std::vector<Candidate>& candidates, bool near_excludes, std::span<Target> targets) {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.gated, a.cost, a.sighting, a.landmark) <
           std::tie(b.gated, b.cost, b.sighting, b.landmark);
  });
  std::vector<int> taken;
  for (const Candidate& pair : candidates) {
    Target& target = targets[static_cast<std::size_t>(pair.sighting)];
    if (target.outcome == Outcome::kUse) continue;
    if (std::find(taken.begin(), taken.end(), pair.landmark) == taken.end()) {
      target = {Outcome::kUse, pair.landmark};
      taken.push_back(pair.landmark);
    } else if (near_excludes) {
      target.outcome = Outcome::kIgnore;  // until a free candidate turns up further down
    }
  }
}

void order_by_age(std::span<const Target> targets, std::vector<std::size_t>& order) {
  order.clear();
  for (std::size_t k = 0; k < targets.size(); ++k) {
    if (targets[k].outcome == Outcome::kUse) order.push_back(k);
  }
  std::ranges::sort(order, {}, [&](std::size_t k) { return std::pair(targets[k].landmark, k); });
}

}  // namespace stereobench::slam
