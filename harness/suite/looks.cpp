#include "harness/suite/looks.h"

#include <algorithm>
#include <stdexcept>

namespace stereobench::harness {

std::vector<std::size_t> look_sizes(std::size_t most) {
  if (most < 1) throw std::invalid_argument("look_sizes: expected at least one seed");
  constexpr std::size_t kFirst = 10;
  std::vector<std::size_t> sizes;
  for (std::size_t size = kFirst; size < most; size *= 2) sizes.push_back(size);
  sizes.push_back(most);
  return sizes;
}

double alpha_of_look(double alpha, std::size_t looks) {
  return alpha / static_cast<double>(looks);
}

bool is_decided(const ResultComparison& comparison) {
  return comparison.has(Verdict::kRegressed) || comparison.has(Verdict::kVanished) ||
         !comparison.has(Verdict::kInconclusive);
}

}  // namespace stereobench::harness
