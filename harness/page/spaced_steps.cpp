#include "harness/page/spaced_steps.h"

#include <algorithm>

namespace stereobench::harness {

std::vector<std::size_t> spaced_steps(std::size_t steps, std::size_t most) {
  const std::size_t stride = std::max<std::size_t>(1, (steps + most - 1) / most);
  std::vector<std::size_t> spaced;
  for (std::size_t k = 0; k < steps; k += stride) spaced.push_back(k);
  return spaced;
}

}  // namespace stereobench::harness
