#include "worlds/yaml/advice.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace stereobench::worlds {
namespace {

/// Damerau and Levenshtein's distance: how many letters to insert, drop or change, or neighbours to swap.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({changed, cost[i - 1][j] + 1, cost[i][j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

std::optional<std::string> nearest_word(std::string_view word, std::span<const std::string_view> known) {
  const auto change = [&](std::string_view other) {
    return static_cast<double>(edit_distance(word, other)) / static_cast<double>(other.size());
  };
  const auto nearest = std::ranges::min_element(known, {}, change);
  if (nearest == known.end() || change(*nearest) > 0.5) return std::nullopt;
  return std::string(*nearest);
}

std::string advice(std::string_view word, std::span<const std::string_view> known) {
  if (const auto nearest = nearest_word(word, known)) return fmt::format("did you mean {}?", *nearest);
  return fmt::format("expected one of {}", fmt::join(known, ", "));
}

}  // namespace stereobench::worlds
