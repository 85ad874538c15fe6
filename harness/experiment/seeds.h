/// Lists of seeds as people write them.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace stereobench::harness {

/// What parse_seeds reads, as a regular expression for schemas.
inline constexpr std::string_view kSeedsPattern = R"(^[0-9]+(\.\.[0-9]+|(,[0-9]+)*)$)";

/// Reads "0..9" (both ends included), "3" or "0,4,7".
///
/// @return the seeds in the order written, at least one, each once
/// @throws std::invalid_argument with what was expected when it is none of these, repeats a seed, or has more
///         than 10000 of them
std::vector<std::uint64_t> parse_seeds(std::string_view text);

}  // namespace stereobench::harness
