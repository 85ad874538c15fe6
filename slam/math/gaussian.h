/// Small Gaussians whose covariance may be singular: square roots, log densities, and their repairs.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "slam/math/elementary.h"
#include "slam/math/random.h"

namespace stereobench::slam {

/// A square root L of a semidefinite matrix, P = L L'. Row pivots[c] is zero behind column c.
template <int kSize>
struct PivotedRoot {
  Eigen::Matrix<double, kSize, kSize> lower = Eigen::Matrix<double, kSize, kSize>::Zero();
  std::array<int, static_cast<std::size_t>(kSize)> pivots{};
  int rank = 0;

  /// @return A with A L = b, where columns of A that nothing depends on are zero
  template <int kRows>
  Eigen::Matrix<double, kRows, kSize> divide(const Eigen::Matrix<double, kRows, kSize>& b) const {
    Eigen::Matrix<double, kRows, kSize> quotient = Eigen::Matrix<double, kRows, kSize>::Zero();
    for (int column = rank - 1; column >= 0; --column) {
      Eigen::Matrix<double, kRows, 1> rest = b.col(column);
      for (int later = column + 1; later < rank; ++later)
        rest -= quotient.col(pivot(later)) * lower(pivot(later), column);
      quotient.col(pivot(column)) = rest / lower(pivot(column), column);
    }
    return quotient;
  }

 private:
  int pivot(int column) const { return pivots[static_cast<std::size_t>(column)]; }
};

/// A Cholesky factorisation that takes the direction with the largest relative uncertainty first and stops
/// where nothing is left. Motion noise has rank 2 and a drawn pose has P = 0, so this is normal life. Without
/// the choice of pivots a pivot that is rounding error would be divided by. L is triangular up to the order
/// of its rows.
///
/// @param covariance symmetric
/// @param variances what each coordinate's variance is relative to: its own, or that of which the covariance
/// is what is left
/// @param repairs incremented when the matrix was not semidefinite beyond rounding: what is negative becomes
/// zero
template <int kSize>
PivotedRoot<kSize> pivoted_root(const Eigen::Matrix<double, kSize, kSize>& covariance,
                                const Eigen::Matrix<double, kSize, 1>& variances, long& repairs) {
  constexpr double kVanishing = 1e-14;
  constexpr double kIndefinite = -1e-7;
  PivotedRoot<kSize> root;
  Eigen::Matrix<double, kSize, kSize> rest = covariance;
  for (int column = 0; column < kSize; ++column) {
    int pivot = -1;
    double largest = kVanishing;
    for (int j = 0; j < kSize; ++j) {
      if (rest(j, j) > largest * variances(j) && rest(j, j) > 0.0) {
        pivot = j;
        largest = rest(j, j) / variances(j);
      }
    }
    if (pivot < 0) break;
    root.pivots[static_cast<std::size_t>(column)] = pivot;
    root.rank = column + 1;
    root.lower.col(column) = rest.col(pivot) / std::sqrt(rest(pivot, pivot));
    if (root.rank == kSize) return root;  // nothing is left
    for (int j = 0; j < kSize; ++j) rest.col(j) -= root.lower.col(column) * root.lower(j, column);
    rest.row(pivot).setZero();  // exactly, so that the row is not chosen again
    rest.col(pivot).setZero();
  }
  for (int j = 0; j < kSize; ++j) {
    if (rest(j, j) < kIndefinite * std::abs(variances(j))) {
      ++repairs;
      break;
    }
  }
  return root;
}

/// The root alone, where variances are relative to themselves.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> semidefinite_root(const Eigen::Matrix<double, kSize, kSize>& covariance,
                                                      long& repairs) {
  return pivoted_root<kSize>(covariance, covariance.diagonal(), repairs).lower;
}

/// Makes a covariance semidefinite that lost more than rounding: a difference of matrices that are sixteen
/// digits apart has directions with less than no variance. One that is semidefinite up to rounding stays as
/// it is, to the last bit.
///
/// @param repairs incremented when something was repaired
template <int kSize>
void project_to_psd(Eigen::Matrix<double, kSize, kSize>& covariance, long& repairs) {
  const long before = repairs;
  const Eigen::Matrix<double, kSize, kSize> root = semidefinite_root<kSize>(covariance, repairs);
  if (repairs != before) covariance = root * root.transpose();
}

/// A positive definite 2x2 covariance, factored once and used for gain, distance and density.
class Factor2 {
 public:
  /// @param covariance symmetric; one that is not positive definite is repaired and counted
  Factor2(const Eigen::Matrix2d& covariance, long& repairs) {
    constexpr double kVanishing = 1e-14;
    first_ = covariance(0, 0);
    bool repaired = !(first_ > kSmallest);
    if (repaired) first_ = kSmallest;
    slope_ = covariance(1, 0) / first_;
    second_ = covariance(1, 1) - slope_ * covariance(1, 0);
    if (!(second_ > kVanishing * covariance(1, 1)) || !(second_ > kSmallest)) {
      second_ = std::fmax(kVanishing * covariance(1, 1), kSmallest);
      repaired = true;
    }
    if (repaired) ++repairs;
  }

  /// @return v' S^-1 v, the squared Mahalanobis length
  double squared_length(const Eigen::Vector2d& v) const {
    const double rest = v.y() - slope_ * v.x();
    return v.x() * v.x() / first_ + rest * rest / second_;
  }

  /// @return log det(2 pi S)
  double log_det_2_pi() const {
    constexpr double kLogTwoPi = 1.8378770664093454836;
    return 2.0 * kLogTwoPi + logarithm(first_ * second_);
  }

  /// @return A S^-1 for a matrix A with two columns
  template <int kRows>
  Eigen::Matrix<double, kRows, 2> divide(const Eigen::Matrix<double, kRows, 2>& a) const {
    Eigen::Matrix<double, kRows, 2> quotient;
    quotient.col(1) = (a.col(1) - slope_ * a.col(0)) / second_;
    quotient.col(0) = a.col(0) / first_ - slope_ * quotient.col(1);
    return quotient;
  }

  /// @return A L^-T for a matrix A with two columns, S = L L': what it yields times its transpose is A S^-1
  /// A'
  template <int kRows>
  Eigen::Matrix<double, kRows, 2> whiten(Eigen::Matrix<double, kRows, 2> a) const {
    whiten_in_place(a);
    return a;
  }

  /// The same where a matrix may be overwritten.
  template <int kRows>
  void whiten_in_place(Eigen::Matrix<double, kRows, 2>& a) const {
    const Eigen::Array2d sd(std::sqrt(first_), std::sqrt(second_));
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      a(i, 1) = (a(i, 1) - slope_ * a(i, 0)) / sd[1];
      a(i, 0) /= sd[0];
    }
  }

 private:
  static constexpr double kSmallest = 1e-150;  ///< whose square is not lost yet
  double first_, slope_, second_;
};

/// The quantile of the chi-square distribution with two degrees of freedom, -2 log(1 - p).
inline double chi_square_2_quantile(double probability) {
  return -2.0 * logarithm_of_one_plus(-probability);
}

/// The same for any number of degrees of freedom, by Wilson and Hilferty's cube: within 5 % from two on.
inline double approximate_chi_square_quantile(double probability, double degrees_of_freedom) {
  if (!(probability < 1.0)) return std::numeric_limits<double>::infinity();
  const double spread = 2.0 / (9.0 * degrees_of_freedom);
  const double root = 1.0 - spread + normal_quantile(probability) * std::sqrt(spread);
  return degrees_of_freedom * root * root * root;
}

}  // namespace stereobench::slam
