#include "slam/smoother/elimination_order.h"

#include <algorithm>
#include <array>
#include <numeric>

#include <suitesparse/ccolamd.h>

namespace stereobench::slam {

std::vector<int> elimination_order(std::span<const std::vector<int>> ties, std::span<const int> is_late) {
  std::vector<std::vector<int>> ties_of(is_late.size());
  for (std::size_t tie = 0; tie < ties.size(); ++tie)
    for (const int variable : ties[tie])
      ties_of[static_cast<std::size_t>(variable)].push_back(static_cast<int>(tie));
  std::vector<int> starts{0};
  std::vector<int> entries;
  for (const std::vector<int>& of_one : ties_of) {
    entries.insert(entries.end(), of_one.begin(), of_one.end());
    starts.push_back(static_cast<int>(entries.size()));
  }
  const auto rows = static_cast<int>(ties.size());
  const auto columns = static_cast<int>(is_late.size());
  entries.resize(ccolamd_recommended(static_cast<int>(entries.size()), rows, columns));
  std::vector<int> late(is_late.begin(), is_late.end());
  // Where all come last none does: CCOLAMD wants its sets numbered below the number of columns.
  if (std::ranges::find(late, 0) == late.end()) std::ranges::fill(late, 0);
  std::array<int, CCOLAMD_STATS> stats{};
  const int found = ccolamd(rows, columns, static_cast<int>(entries.size()), entries.data(), starts.data(),
                            nullptr, stats.data(), late.data());
  starts.pop_back();
  if (found == 0) std::iota(starts.begin(), starts.end(), 0);  // any order is right
  return starts;
}

}  // namespace stereobench::slam
