#include "slam/association/frame_association.h"

#include <algorithm>

namespace stereobench::slam {
namespace {

/// Cost of something else where there is nothing else: more than any pair costs.
constexpr double kNever = 1e3;

}  // namespace

std::vector<double> costs_of_others(const AssociationPolicy& policy, bool merges,
                                    std::span<const Sighting> frame) {
  std::vector<double> costs;
  for (const Sighting& sighting : frame)
    costs.push_back(merges ? policy.existence.cost_of_other(sighting.observation, frame.size()) : kNever);
  return costs;
}

void drop_loose(std::vector<Candidate>& candidates) {
  const std::vector<Candidate> all = candidates;
  std::erase_if(candidates, [&](const Candidate& pair) {
    return pair.loose && std::ranges::any_of(all, [&](const Candidate& other) {
             return other.sighting == pair.sighting && !other.loose && !other.gated;
           });
  });
}

}  // namespace stereobench::slam
