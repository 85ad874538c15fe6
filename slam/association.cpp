#include "slam/association.h"

#include <algorithm>
#include <tuple>

namespace stereobench::slam {

void assign(std::vector<Candidate>& candidates, bool near_excludes, int* targets) {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.gated, a.cost, a.sighting, a.landmark) < std::tie(b.gated, b.cost, b.sighting, b.landmark);
  });
  std::vector<int> taken;
  for (const Candidate& pair : candidates) {
    if (targets[pair.sighting] >= 0) continue;
    if (std::find(taken.begin(), taken.end(), pair.landmark) == taken.end()) {
      targets[pair.sighting] = pair.landmark;
      taken.push_back(pair.landmark);
    } else if (near_excludes) {
      targets[pair.sighting] = kNoLandmark;  // until a free candidate turns up further down
    }
  }
}

}  // namespace stereobench::slam
