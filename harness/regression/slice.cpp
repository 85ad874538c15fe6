#include "harness/regression/slice.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <boost/math/distributions/hypergeometric.hpp>
#include <fmt/format.h>

namespace stereobench::harness {
namespace {

constexpr double kShareOfMarked = 0.9;
constexpr double kLargestPart = 2.0 / 3.0;
constexpr double kChance = 0.01;
constexpr std::size_t kMostConditions = 3;
constexpr std::size_t kBins = 8;

using Indices = std::vector<std::size_t>;

/// A condition that was tried: values from low to high, both included.
struct Candidate {
  const Property* property = nullptr;
  double low = 0.0;
  double high = 0.0;
  std::size_t things = 0;
  std::size_t marked = 0;
};

/// The intervals of a property that are looked at: of its octiles some that lie side by side, each from its
/// lowest to its highest value.
std::vector<Candidate> candidates_of(const Property& property, const Indices& things) {
  std::vector<double> values;
  for (const std::size_t thing : things) values.push_back(property.values[thing]);
  std::ranges::sort(values);
  std::vector<double> lowest;
  for (std::size_t bin = 0; bin < kBins; ++bin) lowest.push_back(values[bin * values.size() / kBins]);
  lowest.erase(std::ranges::unique(lowest).begin(), lowest.end());
  std::vector<double> highest;
  for (std::size_t bin = 1; bin < lowest.size(); ++bin)
    highest.push_back(*std::prev(std::ranges::lower_bound(values, lowest[bin])));
  highest.push_back(values.back());
  std::vector<Candidate> candidates;
  for (std::size_t begin = 0; begin < lowest.size(); ++begin)
    for (std::size_t end = begin; end < lowest.size(); ++end)
      if (end - begin + 1 < lowest.size()) candidates.push_back({&property, lowest[begin], highest[end]});
  return candidates;
}

bool holds(const Candidate& candidate, std::size_t thing) {
  const double value = candidate.property->values[thing];
  return value >= candidate.low && value <= candidate.high;
}

/// The probability that a part of so many things has at least so many marked ones by chance.
double chance_of(const Candidate& part, std::size_t things, std::size_t marked) {
  const boost::math::hypergeometric drawn(static_cast<unsigned>(marked), static_cast<unsigned>(part.things),
                                          static_cast<unsigned>(things));
  return boost::math::cdf(boost::math::complement(drawn, static_cast<unsigned>(part.marked - 1)));
}

std::size_t count_marked(const Indices& things, const std::vector<bool>& marked) {
  return static_cast<std::size_t>(
      std::ranges::count_if(things, [&](std::size_t thing) { return marked[thing]; }));
}

/// The smallest part that holds enough of the marked things; empty where none is small and unlikely enough.
std::optional<Candidate> best_part(std::span<const Property> properties, const Indices& things,
                                   const std::vector<bool>& marked, double least_marked) {
  std::optional<Candidate> best;
  std::size_t tried = 0;
  for (const Property& property : properties)
    for (Candidate candidate : candidates_of(property, things)) {
      ++tried;
      for (const std::size_t thing : things) {
        if (!holds(candidate, thing)) continue;
        ++candidate.things;
        candidate.marked += marked[thing] ? 1U : 0U;
      }
      if (static_cast<double>(candidate.marked) < least_marked) continue;
      if (!best || candidate.things < best->things) best = candidate;
    }
  if (!best || static_cast<double>(best->things) > kLargestPart * static_cast<double>(things.size()))
    return {};
  const double chance = chance_of(*best, things.size(), count_marked(things, marked));
  return chance * static_cast<double>(tried) < kChance ? best : std::nullopt;
}

/// Whole numbers, which may count things, to the last digit.
std::string number_text(double value) {
  return std::trunc(value) == value ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string text_of(const Candidate& candidate) {
  const auto& [name, unit, values] = *candidate.property;
  const std::string behind = unit.empty() ? "" : " " + unit;
  const std::string low = number_text(candidate.low);
  if (candidate.low == candidate.high) return fmt::format("{} {}{}", name, low, behind);
  return fmt::format("{} {} to {}{}", name, low, number_text(candidate.high), behind);
}

}  // namespace

Slice find_slice(std::span<const Property> properties, const std::vector<bool>& marked) {
  for (const Property& property : properties)
    if (property.values.size() != marked.size())
      throw std::invalid_argument("find_slice: expected one value a thing");
  Indices things(marked.size());
  std::iota(things.begin(), things.end(), std::size_t{0});
  Slice slice{.all_things = things.size(), .all_marked = count_marked(things, marked)};
  const double least_marked = kShareOfMarked * static_cast<double>(slice.all_marked);
  std::vector<Candidate> conditions;
  while (least_marked > 0.0) {
    const auto part = best_part(properties, things, marked, least_marked);
    if (!part) break;
    const auto same = std::ranges::find(conditions, part->property, &Candidate::property);
    if (same == conditions.end() && conditions.size() == kMostConditions) break;
    if (same == conditions.end())
      conditions.push_back(*part);
    else
      *same = *part;  // narrower
    std::erase_if(things, [&](std::size_t thing) { return !holds(*part, thing); });
  }
  for (const Candidate& condition : conditions) slice.conditions.push_back(text_of(condition));
  slice.things = things.size();
  slice.marked = count_marked(things, marked);
  return slice;
}

}  // namespace stereobench::harness
