/// Inputs that anybody may have made up: a few hundred each of what the fuzzer (scripts/fuzz.sh) tries for
/// minutes.
#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "tests/fuzz/entries.h"

namespace stereobench::fuzz {

static void PrintTo(const Entry& entry, std::ostream* out) {
  *out << entry.name;
}

namespace {

/// A seed with some of its bytes changed, taken out or doubled.
std::string mutated(std::string bytes, slam::RandomStream& random) {
  const auto below = [&](std::size_t count) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
  };
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes && !bytes.empty(); ++i) {
    const std::size_t at = below(bytes.size());
    switch (below(5)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.erase(at, 1 + below(8));
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, 1 + below(16)));
        break;
      case 3:
        bytes.resize(at);
        break;
      default:
        bytes[at] = "0123456789-.eE[]{},:\"nN\n"[below(24)];
        break;
    }
  }
  return bytes;
}

/// A seed that was grown to a megabyte at most: brackets within brackets that are closed again, or a part of
/// it over and over.
std::string grown(const std::string& seed, int way, slam::RandomStream& random) {
  constexpr std::size_t kMost = 1 << 20;
  const auto below = [&](std::size_t count) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
  };
  const std::size_t at = below(seed.size() + 1);
  std::string part = seed.substr(at, 1 + below(40));
  std::string inserted;
  if (way == 0) inserted = std::string(80'000, '[') + std::string(80'000, ']');
  if (way == 1)
    for (int i = 0; i < 100'000; ++i) inserted += "{a: ";
  if (way == 2)
    for (int i = 0; i < 40'000; ++i) inserted += "- ";
  if (way >= 3)
    while (!part.empty() && inserted.size() + part.size() + seed.size() < kMost) inserted += part;
  return seed.substr(0, at) + inserted + seed.substr(at);
}

Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

class FuzzEntry : public testing::TestWithParam<Entry> {};

TEST_P(FuzzEntry, SurvivesItsSeedsAndTheirMutations) {
  constexpr int kMutations = 150;
  GetParam().check({});
  std::uint64_t number = 0;
  for (const std::string& seed : GetParam().seeds()) {
    GetParam().check(bytes_of(seed));
    slam::RandomStream random(number++, slam::Stream::kWorld);
    for (int i = 0; i < kMutations; ++i) GetParam().check(bytes_of(mutated(seed, random)));
  }
}

// Mutation: no limit of nesting in parse_line or parse_yaml.
TEST_P(FuzzEntry, SurvivesAMegabyte) {
  const auto seeds = GetParam().seeds();
  slam::RandomStream random(5, slam::Stream::kWorld);
  for (int way = 0; way < 6; ++way)
    GetParam().check(bytes_of(grown(seeds[static_cast<std::size_t>(way) % seeds.size()], way, random)));
}

INSTANTIATE_TEST_SUITE_P(All, FuzzEntry, testing::ValuesIn(entries().begin(), entries().end()));

}  // namespace
}  // namespace stereobench::fuzz
