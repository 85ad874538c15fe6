#include "harness/rig_calibration/residual_facts.h"

#include <algorithm>
#include <cmath>

namespace stereobench::harness {
namespace {

constexpr long kPlanes = 4;  // two cameras, two axes

/// Adds up squared sums along lines of corners, and how many corners they have.
struct LineSums {
  double squares = 0.0;
  double corners = 0.0;

  /// @param first corner of the line @param step to the next one
  void add(const Eigen::VectorXd& residuals, long first, long step, int count) {
    for (long plane = 0; plane < kPlanes; ++plane) {
      double sum = 0.0;
      for (int i = 0; i < count; ++i) sum += residuals[kPlanes * (first + step * i) + plane];
      squares += sum * sum;
      corners += count;
    }
  }
};

}  // namespace

double neighbour_sd(const Eigen::VectorXd& residuals, int columns) {
  constexpr double kOfSecond = 6.0;  // 1 + 4 + 1: the variance of a - 2 b + c
  double squares = 0.0;
  double count = 0.0;
  for (long corner = 1; corner + 1 < residuals.size() / kPlanes; ++corner) {
    if (corner % columns == 0 || corner % columns == columns - 1) continue;
    for (long i = kPlanes * corner; i < kPlanes * (corner + 1); ++i) {
      const double bend = residuals[i - kPlanes] - 2.0 * residuals[i] + residuals[i + kPlanes];
      squares += bend * bend;
      count += kOfSecond;
    }
  }
  return std::sqrt(squares / count);
}

double clustering(const Eigen::VectorXd& residuals, int columns, int rows) {
  const long corners = static_cast<long>(columns) * rows;
  LineSums sums;
  for (long view = 0; view < residuals.size() / kPlanes; view += corners) {
    for (int row = 0; row < rows; ++row)
      sums.add(residuals, view + static_cast<long>(row) * columns, 1, columns);
    for (int column = 0; column < columns; ++column) sums.add(residuals, view + column, columns, rows);
  }
  const double mean_square = residuals.squaredNorm() / static_cast<double>(residuals.size());
  return std::max(1.0, sums.squares / sums.corners / std::max(mean_square, 1e-300));
}

}  // namespace stereobench::harness
