#include "slam/ekf/map_merging.h"

#include <algorithm>

#include "slam/association/frame_association.h"
#include "slam/association/joint_compatibility.h"
#include "slam/math/gaussian.h"

namespace stereobench::slam {
namespace {

/// Landmarks that may be one, as candidates: the recent one in the sighting's place.
struct Doubles {
  std::vector<int> recent;
  std::vector<Candidate> candidates;
  std::vector<Pairing> pairings;
};

/// Two that the same frame showed last are two.
bool may_be_same(const LandmarkSeen& late, const LandmarkSeen& old) {
  return may_be_double(old.slot, old.status) && old.status.colour_class == late.status.colour_class &&
         old.first_ago > late.first_ago && old.last_ago != late.last_ago;
}

/// A pair that competes with another is loose, however near it is.
Doubles possible_doubles(const AssociationPolicy& policy, const JointBelief& belief,
                         std::span<const LandmarkSeen> seen, int recent, double as_other) {
  Doubles found;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (may_be_double(seen[i].slot, seen[i].status) && seen[i].last_ago <= recent)
      found.recent.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < found.recent.size(); ++i) {
    const LandmarkSeen& late = seen[static_cast<std::size_t>(found.recent[i])];
    for (std::size_t j = 0; j < seen.size(); ++j) {
      if (!may_be_same(late, seen[j])) continue;
      const int old = static_cast<int>(j);
      const Pairing off = apart(belief, found.recent[i], old);
      long repaired = 0;  // for a comparison only
      const Factor2 factor(off.covariance, repaired);
      const double squared_length = factor.squared_length(off.residual);
      if (!(squared_length <= policy.gate)) continue;
      const bool loose = factor.log_det_2_pi() > as_other - kLoose;
      found.candidates.push_back(
          {static_cast<int>(i), old, squared_length + factor.log_det_2_pi(), false, loose});
      found.pairings.push_back(off);
    }
  }
  const std::vector<Candidate> all = found.candidates;
  for (Candidate& one : found.candidates)
    one.loose |= std::ranges::any_of(all, [&](const Candidate& other) { return compete(one, other); });
  return found;
}

}  // namespace

std::vector<std::pair<int, int>> find_doubles(const AssociationPolicy& policy, const JointBelief& belief,
                                              std::span<const LandmarkSeen> seen, int recent,
                                              std::size_t shown, long& cut) {
  const double cost_of_other = policy.existence.cost_of_place(shown);
  Doubles doubles = possible_doubles(policy, belief, seen, recent, cost_of_other);
  if (doubles.candidates.empty()) return {};
  const std::vector<double> as_other(doubles.recent.size(), cost_of_other);
  const std::vector<Candidate> all = doubles.candidates;
  const auto shared = [&](int one, int other) -> Eigen::Matrix2d {
    return belief.covariance.between(one, other).bottomRightCorner<2, 2>();
  };
  const Tie tie = [&](std::size_t a, std::size_t b) -> Eigen::Matrix2d {
    const int one = doubles.recent[static_cast<std::size_t>(all[a].sighting)];
    const int other = doubles.recent[static_cast<std::size_t>(all[b].sighting)];
    return shared(one, other) - shared(one, all[b].landmark) - shared(all[a].landmark, other) +
           shared(all[a].landmark, all[b].landmark);
  };
  const std::vector<int> unsure =
      keep_joint(doubles.candidates, doubles.pairings, tie, as_other, policy.gate_probability, cut);
  std::vector<std::pair<int, int>> merged;
  for (const Candidate& pair : doubles.candidates) {
    if (!std::ranges::binary_search(unsure, pair.sighting))
      merged.emplace_back(pair.landmark, doubles.recent[static_cast<std::size_t>(pair.sighting)]);
  }
  return merged;
}

}  // namespace stereobench::slam
