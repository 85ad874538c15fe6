#include "harness/experiment/seeds.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostSeeds = 10000;

[[noreturn]] void refuse() {
  throw std::invalid_argument(
      "expected seeds such as 0..9, 3 or 0,4,7: whole numbers, each once, at most 10000");
}

std::uint64_t parse_seed(std::string_view text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error != std::errc() || end != text.data() + text.size()) refuse();
  return seed;
}

}  // namespace

std::vector<std::uint64_t> parse_seeds(std::string_view text) {
  std::vector<std::uint64_t> seeds;
  if (const std::size_t dots = text.find(".."); dots != std::string_view::npos) {
    const std::uint64_t first = parse_seed(text.substr(0, dots));
    const std::uint64_t last = parse_seed(text.substr(dots + 2));
    if (last < first || last - first >= kMostSeeds) refuse();
    for (std::uint64_t seed = first; seeds.size() <= last - first; ++seed) seeds.push_back(seed);
    return seeds;
  }
  while (true) {
    const std::size_t comma = text.find(',');
    const std::uint64_t seed = parse_seed(text.substr(0, comma));
    if (seeds.size() == kMostSeeds || std::ranges::find(seeds, seed) != seeds.end()) refuse();
    seeds.push_back(seed);
    if (comma == std::string_view::npos) return seeds;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace stereobench::harness
