/// Inputs that anybody may have made up: a few hundred each of what the fuzzer (scripts/fuzz.sh) tries for
/// minutes.
#include <gtest/gtest.h>

#include "slam/random.h"
#include "tests/fuzz/entries.h"

namespace stereobench::fuzz {
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

INSTANTIATE_TEST_SUITE_P(All, FuzzEntry, testing::ValuesIn(entries().begin(), entries().end()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace stereobench::fuzz
