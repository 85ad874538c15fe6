/// The joint covariance of pairs, factored row by row.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "slam/association/joint_compatibility.h"
#include "slam/math/gaussian.h"

namespace stereobench::slam {

/// A Cholesky factor of the covariance of some pairs' residuals, as pairs come and go at its end.
class JointFactor {
 public:
  JointFactor(std::span<const Pairing> pairings, const Tie& tie) : pairings_(pairings), tie_(tie) {}

  std::size_t size() const { return chosen_.size(); }

  /// Squared Mahalanobis length of all residuals together.
  double squared_length() const { return chosen_.empty() ? 0.0 : chosen_.back().squared_length; }

  /// Minus twice the log density of all residuals together.
  double cost() const { return chosen_.empty() ? 0.0 : chosen_.back().cost; }

  /// @param pair index of a pairing
  void push(std::size_t pair);
  void pop() { chosen_.pop_back(); }

  /// @return the pairs in the order in which they came
  std::vector<std::size_t> pairs() const;

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

}  // namespace stereobench::slam
