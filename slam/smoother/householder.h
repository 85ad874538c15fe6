/// Householder reflections of rows of which many are zero.
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

namespace stereobench::slam {

/// Turns rows so that all but one of them are zero in a column; that one comes to stand at `pivot`.
///
/// @param rows of which the columns before `column` are zero from `pivot` on
/// @param pivot those above it stay as they are, and those that are zero in the column
/// @param concerned memory that many calls can share
/// @return whether any was not zero
template <class Matrix>
bool reflect(Matrix& rows, Eigen::Index pivot, Eigen::Index column, std::vector<Eigen::Index>& concerned) {
  concerned.clear();
  double square = 0.0;
  for (Eigen::Index i = pivot; i < rows.rows(); ++i) {
    const double value = rows(i, column);
    if (value == 0.0) continue;
    concerned.push_back(i);
    square += value * value;
  }
  if (concerned.empty()) return false;
  if (concerned.front() != pivot) {
    rows.row(pivot).swap(rows.row(concerned.front()));
    concerned.front() = pivot;
  }
  if (concerned.size() == 1) return true;
  // The reflection that takes the column to (-sign(head) length, 0, ...): 1 - v v' / (length |v_1|).
  const double head = rows(pivot, column);
  const double length = std::copysign(std::sqrt(square), head);
  rows(pivot, column) = head + length;
  const double scale = 1.0 / (length * (head + length));
  const Eigen::Index rest = rows.cols() - column - 1;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(rest);
  for (const Eigen::Index i : concerned) sum.noalias() += rows(i, column) * rows.row(i).tail(rest);
  sum *= scale;
  for (const Eigen::Index i : concerned) {
    rows.row(i).tail(rest).noalias() -= rows(i, column) * sum;
    rows(i, column) = 0.0;
  }
  rows(pivot, column) = -length;
  return true;
}

}  // namespace stereobench::slam
