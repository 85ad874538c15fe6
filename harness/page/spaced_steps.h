/// Which of many steps are drawn.
#pragma once

#include <cstddef>
#include <vector>

namespace stereobench::harness {

/// All steps, or every n-th from the first on, so that there are `most` at most.
std::vector<std::size_t> spaced_steps(std::size_t steps, std::size_t most);

}  // namespace stereobench::harness
