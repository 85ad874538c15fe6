#include "harness/sensitivity/pick_freeze.h"

#include <boost/random/sobol.hpp>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

/// One number in [0, 1) for each column of a row.
using Shares = std::vector<double>;

/// Sobol' points whose bits are turned over at random, alike in all points of a column (a digital shift):
/// each point is then uniform, and together they lie as evenly as before.
std::vector<Shares> sobol_points(std::size_t rows, std::size_t columns, std::uint64_t seed) {
  std::vector<Shares> points(rows, Shares(columns));
  if (columns == 0) return points;
  slam::RandomStream random(seed, slam::Stream::kResample);
  std::vector<std::uint64_t> shifts(columns);
  for (std::uint64_t& shift : shifts) {
    const std::uint64_t upper = random.bits();
    shift = (upper << 32U) | random.bits();
  }
  boost::random::sobol sequence(columns);  // begins behind the first point, which is 0
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t c = 0; c < columns; ++c) {
      const std::uint64_t bits = (j == 0 ? 0 : sequence()) ^ shifts[c];
      points[j][c] = static_cast<double>(bits >> 11U) * 0x1p-53;
    }
  return points;
}

/// @param column of the point's first key
StudyPoint point_of(const Factors& factors, const Shares& shares, std::size_t column, std::uint64_t seed) {
  StudyPoint point;
  for (std::size_t i = 0; i < factors.keys.size(); ++i)
    point.values.push_back(value_at(factors.keys[i], shares[column + i]));
  point.seeds.assign(factors.streams.size(), seed);
  return point;
}

/// The point with one factor from another point.
StudyPoint with_factor_from(const StudyPoint& other, std::size_t factor, StudyPoint point) {
  const std::size_t keys = point.values.size();
  if (factor < keys)
    point.values[factor] = other.values[factor];
  else
    point.seeds[factor - keys] = other.seeds[factor - keys];
  return point;
}

}  // namespace

std::size_t count_of_points(const Factors& factors, std::size_t rows) {
  return rows * (factors.size() + 2);
}

std::vector<StudyPoint> pick_freeze_points(const Factors& factors, std::size_t rows, std::uint64_t seed) {
  check(factors);
  const std::size_t keys = factors.keys.size();
  const std::vector<Shares> shares = sobol_points(rows, 2 * keys, seed);
  const std::uint64_t first_seed = 2 * rows * seed;
  std::vector<StudyPoint> points;
  points.reserve(count_of_points(factors, rows));
  for (std::size_t j = 0; j < rows; ++j) points.push_back(point_of(factors, shares[j], 0, first_seed + j));
  for (std::size_t j = 0; j < rows; ++j)
    points.push_back(point_of(factors, shares[j], keys, first_seed + rows + j));
  for (std::size_t factor = 0; factor < factors.size(); ++factor)
    for (std::size_t j = 0; j < rows; ++j)
      points.push_back(with_factor_from(points[rows + j], factor, points[j]));
  return points;
}

}  // namespace stereobench::harness
