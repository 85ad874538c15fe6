#include "slam/association/joint_compatibility.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "slam/math/gaussian.h"

namespace stereobench::slam {
namespace {

constexpr int kMostSteps = 500;

using Indices = std::vector<std::size_t>;

/// The joint covariance of pairs, factored row by row as pairs come and go at its end.
class JointFactor {
 public:
  JointFactor(std::span<const Pairing> pairings, const Tie& tie) : pairings_(pairings), tie_(tie) {}

  std::size_t size() const { return chosen_.size(); }
  double squared_length() const { return chosen_.empty() ? 0.0 : chosen_.back().squared_length; }
  double cost() const { return chosen_.empty() ? 0.0 : chosen_.back().cost; }

  void push(std::size_t pair) {
    std::vector<Eigen::Matrix2d> row;
    Eigen::Matrix2d rest = pairings_[pair].covariance;
    Eigen::Vector2d residual = pairings_[pair].residual;
    for (const Row& before : chosen_) {
      Eigen::Matrix2d block = tie_(pair, before.pair);
      for (std::size_t i = 0; i < row.size(); ++i) block -= row[i] * before.blocks[i].transpose();
      row.push_back(before.factor.whiten<2>(block));
      rest -= row.back() * row.back().transpose();
      residual -= row.back() * before.white;
    }
    long repaired = 0;  // of a search, not of a belief
    const Factor2 factor(rest, repaired);
    const Eigen::Vector2d white = factor.whiten<1>(residual.transpose()).transpose();
    const double length = white.squaredNorm();
    chosen_.push_back({pair, std::move(row), factor, white, squared_length() + length,
                       cost() + length + factor.log_det_2_pi()});
  }
  void pop() { chosen_.pop_back(); }

  Indices pairs() const {
    Indices list;
    for (const Row& row : chosen_) list.push_back(row.pair);
    return list;
  }

 private:
  struct Row {
    std::size_t pair;
    std::vector<Eigen::Matrix2d> blocks;  ///< of the factor, left of the diagonal
    Factor2 factor;                       ///< its block on the diagonal
    Eigen::Vector2d white;                ///< the residual, whitened
    double squared_length, cost;          ///< of all pairs up to here
  };
  std::span<const Pairing> pairings_;
  const Tie& tie_;
  std::vector<Row> chosen_;
};

/// Depth first over the sightings that have a choice, with the best set so far as the bound.
class SetSearch {
 public:
  SetSearch(std::span<const Candidate> candidates, JointFactor& factor, double probability)
      : candidates_(candidates), factor_(factor), probability_(probability) {}

  /// @param choices the candidates of each sighting, likeliest first
  /// @return whether the search came to its end
  bool run(const std::vector<Indices>& choices) {
    best_ = factor_.pairs();
    best_cost_ = factor_.cost();
    descend(choices);
    return steps_ <= kMostSteps;
  }

  const Indices& best() const { return best_; }

 private:
  bool is_free(int landmark) const {
    return std::ranges::none_of(taken_,
                                [&](std::size_t pair) { return candidates_[pair].landmark == landmark; });
  }

  void descend(std::span<const Indices> choices) {
    if (++steps_ > kMostSteps || factor_.size() + choices.size() < best_.size()) return;
    if (choices.empty()) {
      if (std::pair(factor_.size(), -factor_.cost()) > std::pair(best_.size(), -best_cost_)) {
        best_ = factor_.pairs();
        best_cost_ = factor_.cost();
      }
      return;
    }
    for (const std::size_t pair : choices.front()) {
      if (!is_free(candidates_[pair].landmark)) continue;
      factor_.push(pair);
      taken_.push_back(pair);
      const double degrees = 2.0 * static_cast<double>(factor_.size());
      if (factor_.squared_length() <= approximate_chi_square_quantile(probability_, degrees))
        descend(choices.subspan(1));
      taken_.pop_back();
      factor_.pop();
    }
    descend(choices.subspan(1));  // without this sighting
  }

  std::span<const Candidate> candidates_;
  JointFactor& factor_;
  double probability_;
  Indices taken_;
  Indices best_;
  double best_cost_ = 0.0;
  int steps_ = 0;
};

bool competes(const Candidate& one, std::span<const Candidate> candidates) {
  return !one.gated && std::ranges::any_of(candidates, [&](const Candidate& other) {
    return !other.gated && (one.sighting == other.sighting) != (one.landmark == other.landmark);
  });
}

/// The candidates that compete, by sighting: those with the fewest choices first. The order does not depend
/// on that of the sightings.
std::vector<Indices> choices_of(std::span<const Candidate> candidates, const Indices& competing) {
  Indices order = competing;
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

}  // namespace

bool compete(std::span<const Candidate> candidates) {
  return std::ranges::any_of(candidates, [&](const Candidate& one) { return competes(one, candidates); });
}

void keep_joint(std::vector<Candidate>& candidates, std::span<const Pairing> pairings, const Tie& tie,
                double probability, long& cut) {
  JointFactor factor(pairings, tie);
  Indices competing;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].gated) continue;
    if (competes(candidates[i], candidates)) {
      competing.push_back(i);
    } else {
      factor.push(i);
    }
  }
  const double degrees = 2.0 * static_cast<double>(factor.size());
  if (factor.size() > 0 && factor.squared_length() > approximate_chi_square_quantile(probability, degrees))
    return;
  SetSearch search(candidates, factor, probability);
  if (!search.run(choices_of(candidates, competing))) {
    ++cut;
    return;
  }
  std::vector<Candidate> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].gated || std::ranges::count(search.best(), i) > 0) kept.push_back(candidates[i]);
  }
  candidates = std::move(kept);
}

}  // namespace stereobench::slam
