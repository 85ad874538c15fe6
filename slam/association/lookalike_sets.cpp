#include "slam/association/lookalike_sets.h"

#include <algorithm>

#include "slam/association/joint_factor.h"
#include "slam/math/gaussian.h"

namespace stereobench::slam {
namespace {

using Indices = std::vector<std::size_t>;

constexpr int kMostTried = 20'000;  ///< pairs that are tried

/// Builds a rival of a set around one pair, sighting by sighting.
class Rival {
 public:
  /// @param certain pairs that both sets have
  Rival(std::span<const Candidate> candidates, const JointFactor& certain, double probability)
      : candidates_(candidates), factor_(certain), probability_(probability), taken_(certain.pairs()) {}

  /// @return whether the pair is compatible with those that it has
  bool add(std::size_t pair) {
    factor_.push(pair);
    const double degrees = 2.0 * static_cast<double>(factor_.size());
    if (factor_.squared_length() <= approximate_chi_square_quantile(probability_, degrees)) {
      taken_.push_back(pair);
      return true;
    }
    factor_.pop();
    return false;
  }

  /// Adds the nearest compatible of some pairs, where there is one.
  /// @return whether there is
  bool add_nearest(const Indices& pairs) {
    double least = 0.0;
    const std::size_t* nearest = nullptr;
    for (const std::size_t& pair : pairs) {
      if (!is_free(pair)) continue;
      factor_.push(pair);
      ++steps_;
      const double length = factor_.squared_length();
      factor_.pop();
      if (nearest && length >= least) continue;
      least = length;
      nearest = &pair;
    }
    return nearest && add(*nearest);
  }

  double cost() const { return factor_.cost(); }
  int steps() const { return steps_; }

 private:
  bool is_free(std::size_t pair) const {
    return std::ranges::none_of(
        taken_, [&](std::size_t other) { return candidates_[other].landmark == candidates_[pair].landmark; });
  }

  std::span<const Candidate> candidates_;
  JointFactor factor_;
  double probability_;
  Indices taken_;  ///< all its pairs
  int steps_ = 0;
};

}  // namespace

bool fits_elsewhere(std::span<const Candidate> candidates, std::span<const Pairing> pairings, const Tie& tie,
                    const std::vector<std::size_t>& set, double probability, double unlikely) {
  JointFactor certain(pairings, tie);
  Indices loose;
  for (const std::size_t pair : set) {
    if (candidates[pair].loose)
      loose.push_back(pair);
    else
      certain.push(pair);
  }
  std::vector<Indices> others(loose.size());  // pairs that the set does not have, by sighting
  for (std::size_t i = 0; i < loose.size(); ++i) {
    for (std::size_t other = 0; other < candidates.size(); ++other) {
      const Candidate& one = candidates[other];
      if (!one.gated && other != loose[i] && one.sighting == candidates[loose[i]].sighting)
        others[i].push_back(other);
    }
  }
  int steps = 0;
  for (std::size_t i = 0; i < loose.size(); ++i) {
    for (const std::size_t first : others[i]) {
      Rival rival(candidates, certain, probability);
      if (!rival.add(first)) continue;
      JointFactor same = certain;  // sightings, by the set's own pairs
      same.push(loose[i]);
      std::size_t explained = 1;
      for (std::size_t k = 0; k < loose.size(); ++k) {
        if (k == i || !rival.add_nearest(others[k])) continue;
        same.push(loose[k]);
        ++explained;
      }
      steps += rival.steps();
      if (steps > kMostTried) return true;
      if (2 * explained + 1 >= loose.size() && rival.cost() < same.cost() + unlikely) return true;
    }
  }
  return false;
}

}  // namespace stereobench::slam
