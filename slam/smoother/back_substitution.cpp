#include <algorithm>
#include <functional>
#include <numeric>

#include "slam/smoother/bayes_tree.h"

namespace stereobench::slam {
namespace {

/// Least change of a variable, in its conditional standard deviations, that is followed.
constexpr double kFollowed = 1e-2;

}  // namespace

/// Solves a variable given its separator. A change that is too small to be followed is left.
void BayesTree::solve_node(int variable, Followed& followed) const {
  const auto index = static_cast<std::size_t>(variable);
  const Node& own = node(variable);
  const auto n = static_cast<Eigen::Index>(own.numbers);
  followed.solved[index] = ++followed.time;
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();
  pull.head(n) = own.density.rightCols<1>();
  Eigen::Index column = n;
  for (const int s : own.separator) {
    const auto numbers = static_cast<Eigen::Index>(node(s).numbers);
    const Eigen::Vector3d& above = followed.solution[static_cast<std::size_t>(s)];
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < numbers; ++j) pull(i) -= own.density(i, column + j) * above(j);
    }
    column += numbers;
  }
  Eigen::Vector3d solution = Eigen::Vector3d::Zero();
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    double rest = pull(i);
    for (Eigen::Index j = i + 1; j < n; ++j) rest -= own.density(i, j) * solution(j);
    solution(i) = rest / own.density(i, i);
  }
  const Eigen::Vector3d change = solution - followed.solution[index];
  if (!solution.allFinite() || !((own.density.topLeftCorner(n, n) * change.head(n)).norm() > kFollowed))
    return;
  followed.solution[index] = solution;
  followed.moved[index] = followed.time;
}

/// @return whether a variable of its separator has changed since it was solved
bool BayesTree::is_behind(int variable, const Followed& followed) const {
  const long solved = followed.solved[static_cast<std::size_t>(variable)];
  return std::ranges::any_of(node(variable).separator,
                             [&](int s) { return followed.moved[static_cast<std::size_t>(s)] > solved; });
}

/// Solves what is below variables that were solved, branch by branch.
///
/// @param most how many may be
void BayesTree::follow(std::vector<int> below, std::size_t most, std::vector<int>& solved) {
  while (!below.empty() && most > 0) {
    const int variable = below.back();
    below.pop_back();
    if (!is_behind(variable, followed_)) continue;
    --most;
    solve_node(variable, followed_);
    solved.push_back(variable);
    below.insert(below.end(), node(variable).children.begin(), node(variable).children.end());
  }
}

std::vector<int> BayesTree::catch_up(std::span<const int> variables) {
  std::vector<int> solved;
  const std::vector<int> path = ancestors_of(variables);
  for (auto it = path.rbegin(); it != path.rend(); ++it) {
    if (!is_behind(*it, followed_)) continue;
    solve_node(*it, followed_);
    solved.push_back(*it);
  }
  return solved;
}

std::vector<Eigen::Vector3d> BayesTree::settled() const {
  Followed all = followed_;
  std::vector<int> order(nodes_.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, std::greater{}, [this](int v) { return node(v).rank; });
  for (const int v : order)
    if (is_behind(v, all)) solve_node(v, all);
  return all.solution;
}

/// @return they themselves too, in the order of elimination
std::vector<int> BayesTree::ancestors_of(std::span<const int> variables) const {
  std::vector<int> all;
  std::vector<bool> met(nodes_.size(), false);
  for (const int variable : variables) {
    for (int v = variable; v != kNone && !met[static_cast<std::size_t>(v)]; v = node(v).parent) {
      met[static_cast<std::size_t>(v)] = true;
      all.push_back(v);
    }
  }
  std::ranges::sort(all, {}, [this](int v) { return node(v).rank; });
  return all;
}

/// With Y = R^-T E, where E picks the variables, R^-1 R^-T between them is Y' Y.
Eigen::MatrixXd BayesTree::covariance(std::span<const int> variables) const {
  const std::vector<int> path = ancestors_of(variables);
  std::vector<Eigen::Index> row_of(nodes_.size(), -1);
  Eigen::Index rows = 0;
  for (const int v : path) {
    row_of[static_cast<std::size_t>(v)] = rows;
    rows += node(v).numbers;
  }
  Eigen::Index columns = 0;
  for (const int v : variables) columns += node(v).numbers;
  Rows y = Rows::Zero(rows, columns);
  Eigen::Index column = 0;
  for (const int v : variables) {
    for (int i = 0; i < node(v).numbers; ++i) y(row_of[static_cast<std::size_t>(v)] + i, column++) = 1.0;
  }
  for (const int v : path) {
    const Node& own = node(v);
    const Eigen::Index at = row_of[static_cast<std::size_t>(v)];
    for (Eigen::Index i = 0; i < own.numbers; ++i) {
      for (Eigen::Index j = 0; j < i; ++j) y.row(at + i) -= own.density(j, i) * y.row(at + j);
      y.row(at + i) /= own.density(i, i);
    }
    Eigen::Index from = own.numbers;
    for (const int s : own.separator) {
      const Eigen::Index above = row_of[static_cast<std::size_t>(s)];
      for (Eigen::Index j = 0; j < node(s).numbers; ++j, ++from) {
        for (Eigen::Index i = 0; i < own.numbers; ++i)
          y.row(above + j) -= own.density(i, from) * y.row(at + i);
      }
    }
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(columns, columns);
  covariance.selfadjointView<Eigen::Lower>().rankUpdate(y.transpose());
  return covariance.selfadjointView<Eigen::Lower>();
}

}  // namespace stereobench::slam
