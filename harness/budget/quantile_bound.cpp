#include "harness/budget/quantile_bound.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>

#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

void check_share(const WorldShare& wanted) {
  const auto is_share = [](double value) { return value > 0.0 && value < 1.0; };
  if (!is_share(wanted.share) || !is_share(wanted.confidence))
    throw std::invalid_argument(fmt::format("a share and a confidence are above 0 and below 1, not {} and {}",
                                            wanted.share, wanted.confidence));
}

/// The probability that at least so many of some worlds, from 1 on, are among those that bear less.
double chance_of_at_least(long count, long worlds, double share) {
  const boost::math::binomial below(static_cast<double>(worlds), 1.0 - share);
  return boost::math::cdf(boost::math::complement(below, static_cast<double>(count - 1)));
}

}  // namespace

long order_of_bound(long worlds, const WorldShare& wanted) {
  check_share(wanted);
  long order = 0;
  while (order < worlds && chance_of_at_least(order + 1, worlds, wanted.share) >= wanted.confidence) ++order;
  return order;
}

long fewest_worlds(const WorldShare& wanted) {
  check_share(wanted);
  const double all_bear =  // share^n = 1 - confidence, rounded with care below
      slam::logarithm_of_one_plus(-wanted.confidence) / slam::logarithm(wanted.share);
  long worlds = std::max(1L, std::lround(std::floor(all_bear)) - 1);
  while (chance_of_at_least(1, worlds, wanted.share) < wanted.confidence) ++worlds;
  return worlds;
}

long order_of_seeds(long seeds, const WorldShare& wanted) {
  const long order = order_of_bound(seeds, wanted);
  if (order == 0)
    throw std::runtime_error(fmt::format("--seeds: a statement on {} needs {} seeds or more, got {}",
                                         in_words(wanted), fewest_worlds(wanted), seeds));
  return order;
}

std::string in_words(const WorldShare& wanted) {
  return fmt::format("at least {:.10g} % of worlds, with {:.10g} % confidence", 100.0 * wanted.share,
                     100.0 * wanted.confidence);
}

}  // namespace stereobench::harness
