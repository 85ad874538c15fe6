#include "harness/regression/slice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <boost/math/distributions/hypergeometric.hpp>
#include <boost/math/special_functions/binomial.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "slam/math/elementary.h"

namespace stereobench::harness {
namespace {

constexpr double kShareOfMarked = 0.9;
constexpr double kLargestPart = 2.0 / 3.0;
constexpr double kChance = 0.01;
constexpr std::size_t kMostConditions = 3;
constexpr std::size_t kBins = 8;

constexpr std::size_t kMostCategories = 4;
constexpr double kTold = 9.2;  ///< twice the logarithm of 100: so much likelier is what is told apart

using Indices = std::vector<std::size_t>;

/// A condition that could be taken: values from low to high, both included, or some categories.
struct Candidate {
  const Property* property = nullptr;
  double low = 0.0;
  double high = 0.0;
  std::vector<double> categories;  ///< in ascending order; empty for an interval
  double choices = 1.0;            ///< how many others of its kind there are
  std::size_t things = 0;
  std::size_t marked = 0;
  double preference = 0.0;  ///< preference_for
};

bool holds(const Candidate& candidate, std::size_t thing) {
  const double value = candidate.property->values[thing];
  if (!candidate.categories.empty()) return std::ranges::binary_search(candidate.categories, value);
  return value >= candidate.low && value <= candidate.high;
}

/// The intervals of a property that are looked at: of its octiles some that lie side by side, each from its
/// lowest to its highest value.
std::vector<Candidate> intervals_of(const Property& property, const Indices& things) {
  std::vector<double> values;
  for (const std::size_t thing : things) values.push_back(property.values[thing]);
  std::ranges::sort(values);
  std::vector<double> lowest;
  for (std::size_t bin = 0; bin < kBins; ++bin) lowest.push_back(values[bin * values.size() / kBins]);
  lowest.erase(std::unique(lowest.begin(), lowest.end()), lowest.end());
  std::vector<double> highest;
  for (std::size_t bin = 1; bin < lowest.size(); ++bin)
    highest.push_back(*std::prev(std::ranges::lower_bound(values, lowest[bin])));
  highest.push_back(values.back());
  std::vector<Candidate> candidates;
  for (std::size_t begin = 0; begin < lowest.size(); ++begin)
    for (std::size_t end = begin; end < lowest.size(); ++end)
      if (end - begin + 1 < lowest.size())
        candidates.push_back({.property = &property, .low = lowest[begin], .high = highest[end]});
  for (Candidate& candidate : candidates) candidate.choices = static_cast<double>(candidates.size());
  return candidates;
}

/// The sets of a property's categories that are looked at: those of which the largest shares are marked.
std::vector<Candidate> sets_of(const Property& property, const Indices& things,
                               const std::vector<bool>& marked) {
  struct Category {
    double value = 0.0;
    double things = 0.0;
    double marked = 0.0;
  };
  std::map<double, Category> counted;
  for (const std::size_t thing : things) {
    Category& category = counted[property.values[thing]];
    category.value = property.values[thing];
    category.things += 1.0;
    category.marked += marked[thing] ? 1.0 : 0.0;
  }
  std::vector<Category> categories;
  for (const auto& [value, category] : counted) categories.push_back(category);
  std::ranges::stable_sort(categories, std::greater{},
                           [](const Category& category) { return category.marked / category.things; });
  std::vector<Candidate> candidates;
  const std::size_t most = std::min(kMostCategories, categories.size() - 1);
  Candidate set{.property = &property};
  for (std::size_t size = 1; size <= most; ++size) {
    set.categories.push_back(categories[size - 1].value);
    std::ranges::sort(set.categories);
    const auto all = static_cast<unsigned>(categories.size());
    set.choices = static_cast<double>(most) *
                  boost::math::binomial_coefficient<double>(all, static_cast<unsigned>(size));
    candidates.push_back(set);
  }
  return candidates;
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

/// How far a part is from one that marked things do not prefer: the likelihood ratio statistic of the four
/// counts inside and outside, marked and not, 2 sum O log(O / E).
double preference_for(const Candidate& part, std::size_t things, std::size_t marked) {
  const auto term = [](std::size_t count) {
    const auto number = static_cast<double>(count);
    return count == 0 ? 0.0 : number * slam::logarithm(number);
  };
  const std::size_t unmarked = things - marked;
  const std::size_t inside_unmarked = part.things - part.marked;
  const double cells = term(part.marked) + term(inside_unmarked) + term(marked - part.marked) +
                       term(unmarked - inside_unmarked);
  const double sums =
      term(part.things) + term(things - part.things) + term(marked) + term(unmarked) - term(things);
  return 2.0 * (cells - sums);
}

/// Of each property the part that marked things prefer most of those that hold enough of them and are small
/// and unlikely enough. Properties without one are left out.
std::vector<Candidate> best_parts(std::span<const Property> properties, const Indices& things,
                                  const std::vector<bool>& marked, double least_marked) {
  const std::size_t all_marked = count_marked(things, marked);
  const double largest = kLargestPart * static_cast<double>(things.size());
  std::vector<Candidate> parts;
  for (const Property& property : properties) {
    Candidate best;
    for (Candidate& candidate :
         property.is_category ? sets_of(property, things, marked) : intervals_of(property, things)) {
      for (const std::size_t thing : things) {
        if (!holds(candidate, thing)) continue;
        ++candidate.things;
        candidate.marked += marked[thing] ? 1U : 0U;
      }
      if (static_cast<double>(candidate.marked) < least_marked) continue;
      if (static_cast<double>(candidate.things) > largest) continue;
      candidate.preference = preference_for(candidate, things.size(), all_marked);
      const double choices = candidate.choices * static_cast<double>(properties.size());
      if (candidate.preference <= best.preference) continue;
      if (chance_of(candidate, things.size(), all_marked) * choices < kChance) best = candidate;
    }
    if (best.property != nullptr) parts.push_back(best);
  }
  return parts;
}

/// Whether two parts are of the same things.
bool are_alike(const Candidate& one, const Candidate& other, const Indices& things) {
  return std::ranges::all_of(things,
                             [&](std::size_t thing) { return holds(one, thing) == holds(other, thing); });
}

/// Whole numbers, which may count things, to the last digit.
std::string number_text(double value) {
  return std::trunc(value) == value ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string text_of(const Candidate& candidate) {
  const std::string& name = candidate.property->name;
  const std::string& unit = candidate.property->unit;
  if (!candidate.categories.empty()) {
    std::vector<std::string> names;
    for (const double category : candidate.categories) names.push_back(number_text(category));
    return fmt::format("{} {}", name, fmt::join(names, " or "));
  }
  const std::string behind = unit.empty() ? "" : " " + unit;
  const std::string low = number_text(candidate.low);
  if (candidate.low == candidate.high) return fmt::format("{} {}{}", name, low, behind);
  return fmt::format("{} {} to {}{}", name, low, number_text(candidate.high), behind);
}

/// The parts of other properties that speak of what is marked nearly as well. Another name of the same
/// things is none: a ball that alone has its colour.
std::vector<std::string> rivals_of(const Candidate& best, const std::vector<Candidate>& parts,
                                   const Indices& things) {
  std::vector<Candidate> told = {best};
  std::vector<std::string> rivals;
  for (const Candidate& part : parts) {
    const auto is_another_name = [&](const Candidate& one) {
      return part.property->is_category && one.property->is_category && are_alike(part, one, things);
    };
    if (part.property == best.property || part.preference < best.preference - kTold) continue;
    if (std::ranges::any_of(told, is_another_name)) continue;
    told.push_back(part);
    rivals.push_back(text_of(part));
  }
  return rivals;
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
    const std::vector<Candidate> parts = best_parts(properties, things, marked, least_marked);
    const auto part = std::ranges::max_element(parts, {}, &Candidate::preference);
    if (part == parts.end()) break;
    if (conditions.empty()) slice.rivals = rivals_of(*part, parts, things);
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
