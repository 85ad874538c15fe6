#include "slam/smoother/bayes_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/smoother/elimination_order.h"
#include "slam/smoother/householder.h"

namespace stereobench::slam {
namespace {

/// What stands in for a direction of which nothing is known: one over its standard deviation, m or rad.
constexpr double kUnknownWeight = 1e-6;

}  // namespace

int BayesTree::add_variable(int numbers, const Eigen::Vector3d& guess) {
  Node added;
  added.numbers = numbers;
  added.held.head(numbers) = guess.head(numbers);
  followed_.solution.push_back(added.held);
  followed_.solved.push_back(0);
  followed_.moved.push_back(0);
  nodes_.push_back(std::move(added));
  column_.push_back(kNotMet);
  const int variable = static_cast<int>(nodes_.size()) - 1;
  touched_.push_back(variable);
  return variable;
}

void BayesTree::touch(const Factor& factor) {
  touched_.push_back(factor.first);
  if (factor.second != kNone) touched_.push_back(factor.second);
}

int BayesTree::add(const Factor& factor) {
  const int index = static_cast<int>(factors_.size());
  factors_.push_back(factor);
  waiting_.push_back(index);
  touch(factor);
  return index;
}

void BayesTree::replace(int index, const Factor& factor) {
  factors_[static_cast<std::size_t>(index)] = factor;
  touch(factor);
}

std::vector<int> BayesTree::solve(std::span<const int> last, std::size_t most) {
  if (touched_.empty()) return {};
  Top top = take_off_top();
  order(top, last);
  eliminate(top);
  // From the root down: what a variable depends on is solved before it.
  std::vector<int> solved(top.variables.rbegin(), top.variables.rend());
  for (const int v : solved) solve_node(v, followed_);
  follow(std::move(top.orphans), most, solved);
  return solved;
}

/// Takes apart the nodes of what was touched, and all above them.
BayesTree::Top BayesTree::take_off_top() {
  Top top;
  top.factors = std::exchange(waiting_, {});
  for (const int touched : std::exchange(touched_, {})) {
    for (int v = touched; v != kNone && column_of(v) != kTaken; v = node(v).parent) {
      column_of(v) = kTaken;
      top.variables.push_back(v);
    }
  }
  for (const int v : top.variables) {
    Node& taken = node(v);
    for (const int child : taken.children)
      if (column_of(child) != kTaken) top.orphans.push_back(child);
    top.factors.insert(top.factors.end(), taken.factors.begin(), taken.factors.end());
    taken.factors.clear();
    taken.children.clear();
    taken.parent = kNone;
  }
  for (const int v : top.variables) column_of(v) = kNotMet;
  std::ranges::sort(top.factors);  // the same sums, whichever way they came
  std::ranges::sort(top.orphans);
  return top;
}

/// @param last variables that come after all others
void BayesTree::order(Top& top, std::span<const int> last) const {
  std::ranges::sort(top.variables);
  const auto index_of = [&top](int variable) {
    return static_cast<int>(std::ranges::lower_bound(top.variables, variable) - top.variables.begin());
  };
  std::vector<std::vector<int>> ties;
  for (const int f : top.factors) {
    ties.push_back({index_of(factor(f).first)});
    if (factor(f).second != kNone) ties.back().push_back(index_of(factor(f).second));
  }
  for (const int orphan : top.orphans) {
    ties.emplace_back();
    for (const int v : node(orphan).separator) ties.back().push_back(index_of(v));
  }
  std::vector<int> is_late(top.variables.size(), 0);
  for (const int v : last)
    if (std::ranges::binary_search(top.variables, v)) is_late[static_cast<std::size_t>(index_of(v))] = 1;
  std::vector<int> ordered;
  for (const int index : elimination_order(ties, is_late))
    ordered.push_back(top.variables[static_cast<std::size_t>(index)]);
  top.variables = std::move(ordered);
}

void BayesTree::eliminate(const Top& top) {
  for (const int v : top.variables) node(v).rank = next_rank_++;
  for (const int f : top.factors) {
    const Factor& entering = factor(f);
    const bool second = entering.second != kNone && node(entering.second).rank < node(entering.first).rank;
    node(second ? entering.second : entering.first).factors.push_back(f);
  }
  const auto hang_below = [this](int parent, int v) {
    node(v).parent = parent;
    node(parent).children.push_back(v);
  };
  for (const int orphan : top.orphans) {
    const auto rank = [this](int s) { return node(s).rank; };
    hang_below(*std::ranges::min_element(node(orphan).separator, {}, rank), orphan);
  }
  for (const int v : top.variables) {
    eliminate(v, node(v).children);
    if (!node(v).separator.empty()) hang_below(node(v).separator.front(), v);
  }
}

/// Finds what a variable is tied to by the factors that enter with it and by what its children pass.
///
/// @return how many rows these have together
Eigen::Index BayesTree::find_separator(int variable, std::span<const int> children) {
  Node& own = node(variable);
  own.separator.clear();
  Eigen::Index rows = 0;
  const auto meet = [&](int other) {
    if (other == kNone || other == variable || column_of(other) >= 0) return;
    column_of(other) = 0;
    own.separator.push_back(other);
  };
  for (const int f : own.factors) {
    meet(factor(f).first);
    meet(factor(f).second);
    rows += factor(f).rows;
  }
  for (const int child : children) {
    for (const int s : node(child).separator) meet(s);
    rows += node(child).passed.rows();
  }
  std::ranges::sort(own.separator, {}, [this](int s) { return node(s).rank; });
  return rows;
}

/// Writes all that is known of a variable and of its separator into rows.
///
/// @return its columns, those of the separator in their order, and the target
BayesTree::Rows BayesTree::assemble(int variable, std::span<const int> children) {
  const Eigen::Index row_count = find_separator(variable, children);
  const Node& own = node(variable);
  Eigen::Index columns = own.numbers;
  column_of(variable) = 0;
  for (const int s : own.separator) {
    column_of(s) = columns;
    columns += node(s).numbers;
  }
  Rows rows = Rows::Zero(row_count, columns + 1);
  Eigen::Index row = 0;
  for (const int f : own.factors) {
    write(factor(f), row, rows);
    row += factor(f).rows;
  }
  for (const int child : children) {
    const Node& below = node(child);
    const Eigen::Index count = below.passed.rows();
    Eigen::Index from = 0;
    for (const int s : below.separator) {
      const int numbers = node(s).numbers;
      rows.block(row, column_of(s), count, numbers) = below.passed.middleCols(from, numbers);
      from += numbers;
    }
    rows.block(row, columns, count, 1) = below.passed.rightCols<1>();
    row += count;
  }
  column_of(variable) = kNotMet;
  for (const int s : own.separator) column_of(s) = kNotMet;
  return rows;
}

/// @param row of the first of the factor's rows
void BayesTree::write(const Factor& factor, Eigen::Index row, Rows& rows) {
  const auto put = [&](int v, const Eigen::Matrix3d& by) {
    if (v == kNone) return;
    rows.block(row, column_of(v), factor.rows, node(v).numbers) =
        by.topLeftCorner(factor.rows, node(v).numbers);
  };
  put(factor.first, factor.by_first);
  put(factor.second, factor.by_second);
  rows.rightCols<1>().segment(row, factor.rows) = factor.target.head(factor.rows);
}

void BayesTree::eliminate(int variable, std::span<const int> children) {
  Rows rows = assemble(variable, children);
  Node& own = node(variable);
  const Eigen::Index separator_columns = rows.cols() - 1 - own.numbers;
  std::vector<Eigen::Index> concerned;
  if (rows.rows() < own.numbers) rows.conservativeResizeLike(Rows::Zero(own.numbers, rows.cols()));
  for (Eigen::Index j = 0; j < own.numbers; ++j) {
    if (reflect(rows, j, j, concerned) && std::abs(rows(j, j)) > kUnknownWeight) continue;
    // Nothing is known: a row in its place holds it where it is, and what stood there goes on as it was.
    rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
    rows.bottomRows<1>() = rows.row(j);
    rows.bottomRows<1>()(j) = 0.0;
    rows.row(j).setZero();
    rows(j, j) = kUnknownWeight;
    rows(j, rows.cols() - 1) = kUnknownWeight * own.held(j);
    ++repairs_;
  }
  own.density = rows.topRows(own.numbers);
  // More rows than columns say nothing more: those beyond are the misfit.
  if (rows.rows() - own.numbers > separator_columns) {
    for (Eigen::Index j = 0; j < separator_columns; ++j) {
      const Eigen::Index at = own.numbers + j;
      reflect(rows, at, at, concerned);
    }
    own.passed = rows.block(own.numbers, own.numbers, separator_columns, separator_columns + 1);
  } else {
    own.passed = rows.bottomRightCorner(rows.rows() - own.numbers, separator_columns + 1);
  }
}

}  // namespace stereobench::slam
