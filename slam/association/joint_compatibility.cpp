#include "slam/association/joint_compatibility.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "slam/association/joint_factor.h"
#include "slam/association/lookalike_sets.h"
#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"

namespace stereobench::slam {
namespace {

constexpr int kMostSteps = 2000;

/// Least probability of the contrary that makes a decision unsure.
constexpr double kDoubt = 1e-3;

/// By how much the cost of what need not be looked at is higher: -2 log(kDoubt).
constexpr double kUnlikely = 14.0;

/// What stands for a cost that has no number.
constexpr double kLeastCost = -1e3;

using Indices = std::vector<std::size_t>;

/// Depth first over the sightings that have a choice; what is far less likely than the best so far is left.
class SetSearch {
 public:
  /// @param as_other by sighting
  SetSearch(std::span<const Candidate> candidates, std::span<const double> as_other, JointFactor& factor,
            double probability)
      : candidates_(candidates), as_other_(as_other), factor_(factor), probability_(probability) {}

  /// @param choices the candidates of each sighting, likeliest first
  /// @param least what a choice costs at least, by choice
  /// @return whether the search came to its end
  bool run(const std::vector<Indices>& choices, std::span<const double> least) {
    descend(choices, least, 0.0);
    return steps_ <= kMostSteps;
  }

  /// @return the pairs of the likeliest set
  const Indices& best() const { return best_; }

  /// @return the probability of what the likeliest set says of a sighting, among all sets that were met
  double probability_of(int sighting) const {
    const std::size_t pair = pair_of(sighting, best_);
    double all = 0.0;
    double same = 0.0;
    for (const Set& set : sets_) {
      const double weight = exponential(0.5 * (best_cost_ - set.cost));
      all += weight;
      if (pair_of(sighting, set.pairs) == pair) same += weight;
    }
    return all > 0.0 ? same / all : 0.0;
  }

 private:
  struct Set {
    double cost;
    Indices pairs;
  };

  bool is_free(int landmark) const {
    return std::ranges::none_of(taken_,
                                [&](std::size_t pair) { return candidates_[pair].landmark == landmark; });
  }

  /// @return the pair that a sighting has in a set; the number of candidates where it has none
  std::size_t pair_of(int sighting, const Indices& pairs) const {
    const auto found =
        std::ranges::find_if(pairs, [&](std::size_t pair) { return candidates_[pair].sighting == sighting; });
    return found == pairs.end() ? candidates_.size() : *found;
  }

  /// @param of_others what the sightings cost that were left without a landmark
  void descend(std::span<const Indices> choices, std::span<const double> least, double of_others) {
    const double cost = factor_.cost() + of_others;
    if (++steps_ > kMostSteps || std::accumulate(least.begin(), least.end(), cost) > best_cost_ + kUnlikely)
      return;
    if (choices.empty()) {
      sets_.push_back({cost, factor_.pairs()});
      if (cost < best_cost_) {
        best_ = sets_.back().pairs;
        best_cost_ = cost;
      }
      return;
    }
    for (const std::size_t pair : choices.front()) {
      if (!is_free(candidates_[pair].landmark)) continue;
      factor_.push(pair);
      taken_.push_back(pair);
      const double degrees = 2.0 * static_cast<double>(factor_.size());
      if (factor_.squared_length() <= approximate_chi_square_quantile(probability_, degrees))
        descend(choices.subspan(1), least.subspan(1), of_others);
      taken_.pop_back();
      factor_.pop();
    }
    const auto sighting = static_cast<std::size_t>(candidates_[choices.front().front()].sighting);
    descend(choices.subspan(1), least.subspan(1), of_others + as_other_[sighting]);
  }

  std::span<const Candidate> candidates_;
  std::span<const double> as_other_;
  JointFactor& factor_;
  double probability_;
  Indices taken_;
  std::vector<Set> sets_;
  Indices best_;
  double best_cost_ = std::numeric_limits<double>::infinity();
  int steps_ = 0;
};

bool has_rival(const Candidate& one, std::span<const Candidate> candidates) {
  if (one.gated || one.loose) return !one.gated;
  return std::ranges::any_of(candidates,
                             [&](const Candidate& other) { return !other.gated && compete(one, other); });
}

/// @return the sightings that have one which is loose, in their order
std::vector<int> loose_sightings(std::span<const Candidate> candidates) {
  std::set<int> sightings;
  for (const Candidate& one : candidates) {
    if (one.loose && !one.gated) sightings.insert(one.sighting);
  }
  return {sightings.begin(), sightings.end()};
}

/// The candidates that have a rival, by sighting: those with the fewest choices first. The order does not
/// depend on that of the sightings.
std::vector<Indices> choices_of(std::span<const Candidate> candidates, const Indices& open) {
  Indices order = open;
  const auto by_cost = [&](std::size_t a, std::size_t b) { return candidates[a].cost < candidates[b].cost; };
  std::ranges::sort(order, by_cost);
  std::vector<Indices> choices;
  for (const std::size_t pair : order) {
    const auto same = std::ranges::find_if(choices, [&](const Indices& those) {
      return candidates[those.front()].sighting == candidates[pair].sighting;
    });
    if (same == choices.end()) {
      choices.push_back({pair});
    } else {
      same->push_back(pair);
    }
  }
  std::ranges::stable_sort(choices, {}, [](const Indices& those) { return those.size(); });
  return choices;
}

/// What each choice costs where all other pairs are known, or something else does: hardly a set has it for
/// less.
///
/// @param ground pairs that are taken as they are
std::vector<double> least_costs(std::span<const Candidate> candidates, std::span<const Pairing> pairings,
                                const Tie& tie, const Indices& ground, const std::vector<Indices>& choices,
                                std::span<const double> as_other) {
  constexpr double kSlack = 3.0;
  Indices pairs = ground;
  for (const Indices& choice : choices) pairs.push_back(choice.front());
  const auto size = static_cast<Eigen::Index>(2 * pairs.size());
  Eigen::MatrixXd joint(size, size);
  for (std::size_t a = 0; a < pairs.size(); ++a) {
    const auto row = static_cast<Eigen::Index>(2 * a);
    joint.block<2, 2>(row, row) = pairings[pairs[a]].covariance;
    for (std::size_t b = 0; b < a; ++b) {
      const auto column = static_cast<Eigen::Index>(2 * b);
      joint.block<2, 2>(row, column) = tie(pairs[a], pairs[b]);
      joint.block<2, 2>(column, row) = joint.block<2, 2>(row, column).transpose();
    }
  }
  const Eigen::MatrixXd information = joint.ldlt().solve(Eigen::MatrixXd::Identity(size, size));
  std::vector<double> least;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * (ground.size() + i));
    const double cost =
        -logarithm(information.block<2, 2>(row, row).determinant()) + 2.0 * logarithm(2.0 * kPi);
    const double other = as_other[static_cast<std::size_t>(candidates[choices[i].front()].sighting)];
    least.push_back(std::isfinite(cost) ? std::min(cost - kSlack, other) : kLeastCost);
  }
  return least;
}

}  // namespace

bool compete(const Candidate& one, const Candidate& other) {
  return (one.sighting == other.sighting) != (one.landmark == other.landmark);
}

bool is_open(std::span<const Candidate> candidates) {
  return std::ranges::any_of(candidates, [&](const Candidate& one) { return has_rival(one, candidates); });
}

std::vector<int> keep_joint(std::vector<Candidate>& candidates, std::span<const Pairing> pairings,
                            const Tie& tie, std::span<const double> as_other, double probability, long& cut) {
  JointFactor factor(pairings, tie);
  Indices open;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].gated) continue;
    if (has_rival(candidates[i], candidates)) {
      open.push_back(i);
    } else {
      factor.push(i);
    }
  }
  const double degrees = 2.0 * static_cast<double>(factor.size());
  if (factor.size() > 0 && factor.squared_length() > approximate_chi_square_quantile(probability, degrees))
    return loose_sightings(candidates);
  SetSearch search(candidates, as_other, factor, probability);
  const std::vector<Indices> choices = choices_of(candidates, open);
  const bool ended =
      search.run(choices, least_costs(candidates, pairings, tie, factor.pairs(), choices, as_other));
  const bool elsewhere =
      ended && fits_elsewhere(candidates, pairings, tie, search.best(), probability, kUnlikely);
  std::vector<int> unsure;
  for (const Indices& choice : choices) {
    const auto& [sighting, landmark, cost, gated, loose] = candidates[choice.front()];
    if (!loose) continue;
    if (!ended || elsewhere || search.probability_of(sighting) < 1.0 - kDoubt) unsure.push_back(sighting);
  }
  std::ranges::sort(unsure);
  if (!ended) {
    ++cut;
    return unsure;
  }
  std::vector<Candidate> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].gated || std::ranges::count(search.best(), i) > 0) kept.push_back(candidates[i]);
  }
  candidates = std::move(kept);
  return unsure;
}

}  // namespace stereobench::slam
