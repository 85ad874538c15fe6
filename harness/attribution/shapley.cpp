#include "harness/attribution/shapley.h"

#include <bit>
#include <stdexcept>

namespace stereobench::harness {
namespace {

/// |S|! (n - |S| - 1)! / n! by |S|.
std::vector<double> weights_of(std::size_t parts) {
  std::vector<double> weights(parts, 1.0 / static_cast<double>(parts));
  for (std::size_t size = 1; size < parts; ++size)
    weights[size] = weights[size - 1] * static_cast<double>(size) / static_cast<double>(parts - size);
  return weights;
}

void check(std::span<const std::vector<double>> errors) {
  if (errors.size() < 2 || !std::has_single_bit(errors.size()))
    throw std::invalid_argument("attribute: expected errors of 2^n coalitions, n >= 1");
  for (const std::vector<double>& of_coalition : errors)
    if (of_coalition.size() != errors.front().size())
      throw std::invalid_argument("attribute: expected errors of the same seeds in all coalitions");
}

PartWorth worth_of(std::span<const std::vector<double>> errors, std::size_t part,
                   const std::vector<double>& weights) {
  const std::size_t seeds = errors.front().size();
  const Coalition bit = Coalition{1} << part;
  const Coalition others = errors.size() - 1 - bit;
  PartWorth worth{.share = std::vector<double>(seeds, 0.0), .only_perfect = {}, .only_real = {}};
  for (std::size_t seed = 0; seed < seeds; ++seed) {
    const auto taken_away = [&](Coalition without) {
      return errors[without][seed] - errors[without | bit][seed];
    };
    for (Coalition without = 0; without < errors.size(); ++without)
      if ((without & bit) == 0)
        worth.share[seed] += weights[static_cast<std::size_t>(std::popcount(without))] * taken_away(without);
    worth.only_perfect.push_back(taken_away(0));
    worth.only_real.push_back(taken_away(others));
  }
  return worth;
}

}  // namespace

std::vector<PartWorth> attribute(std::span<const std::vector<double>> errors) {
  check(errors);
  const auto parts = static_cast<std::size_t>(std::countr_zero(errors.size()));
  const std::vector<double> weights = weights_of(parts);
  std::vector<PartWorth> worths;
  for (std::size_t part = 0; part < parts; ++part) worths.push_back(worth_of(errors, part, weights));
  return worths;
}

}  // namespace stereobench::harness
