#include "renderer/pictures/fast_deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <zlib.h>

namespace stereobench::renderer {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What zlib makes of it again; nothing where it refuses.
Bytes inflated(const Bytes& packed, std::size_t expected) {
  Bytes bytes(expected + 1);
  uLongf size = bytes.size();
  if (::uncompress(bytes.data(), &size, packed.data(), packed.size()) != Z_OK) return {};
  bytes.resize(size);
  return bytes;
}

Bytes random_bytes(std::mt19937& chance, std::size_t size, unsigned kinds) {
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(chance() % kinds);
  return bytes;
}

// Mutations: the sum over what was packed; the end of the block left out.
TEST(FastDeflate, IsReadByZlib) {
  std::mt19937 chance(3);
  for (const unsigned kinds : {1U, 2U, 3U, 17U, 256U})
    for (const std::size_t size : {0U, 1U, 2U, 3U, 4U, 5U, 100U, 30011U}) {
      const Bytes bytes = random_bytes(chance, size, kinds);
      EXPECT_EQ(inflated(deflate_fast(bytes), size), bytes) << size << " of " << kinds;
    }
}

// Each length of a run, behind and before something else. Mutations: one extra bit more for each length; the
// lowest extra bit turned.
TEST(FastDeflate, HasRunsOfAllLengths) {
  Bytes bytes;
  for (std::size_t length = 1; length <= 600; ++length) {
    bytes.push_back(static_cast<std::uint8_t>(length));
    bytes.insert(bytes.end(), length, static_cast<std::uint8_t>(length + 1));
  }
  const Bytes packed = deflate_fast(bytes);
  EXPECT_EQ(inflated(packed, bytes.size()), bytes);
  EXPECT_LT(packed.size(), bytes.size() / 40);
}

// Codes as long as they get: each byte is as frequent as the two rarer ones together. Mutations: depths that
// are not cut; codes that take more room than there is; room that is left over.
TEST(FastDeflate, CutsItsLongestCodes) {
  std::mt19937 chance(4);
  for (int kinds = 12; kinds < 28; ++kinds) {
    Bytes bytes;
    std::size_t rarer = 1, count = 1;
    for (int kind = 0; kind < kinds; ++kind) {
      bytes.insert(bytes.end(), rarer, static_cast<std::uint8_t>(kind));
      rarer = std::exchange(count, rarer + count);
    }
    std::shuffle(bytes.begin(), bytes.end(), chance);
    EXPECT_EQ(inflated(deflate_fast(bytes), bytes.size()), bytes) << kinds;
  }
}

// Law: no prefix code is shorter than the entropy; Huffman's is at most a bit a symbol longer, here a
// twentieth. Mutation: code lengths by the order of bytes.
TEST(FastDeflate, IsNearlyAsShortAsItCanBe) {
  std::mt19937 chance(5);
  Bytes bytes(200000);
  std::array<double, 256> counts{};
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(std::popcount(chance()) + 100);  // binomial
    counts[byte] += 1.0;
  }
  double bits = 0.0;
  for (const double count : counts)
    if (count > 0.0) bits -= count * std::log2(count / static_cast<double>(bytes.size()));
  EXPECT_GT(static_cast<double>(deflate_fast(bytes).size()), bits / 8.0 * 0.98);  // runs by chance
  EXPECT_LT(static_cast<double>(deflate_fast(bytes).size()), bits / 8.0 * 1.05);
}

// The bytes of data sets are what their manifests say, also of those that were begun by an older program:
// this sum is of the first packer, which looked at one byte after the other. Mutations: the search for runs
// goes on six places at once; a run that ends eight bytes early; the last byte of four left out of the
// counts.
TEST(FastDeflate, KeepsItsBytes) {
  constexpr std::array kTurns = {0x80, 0x01, 0x81, 0x00};  // words without carries are searched for runs
  std::mt19937 chance(6);
  Bytes bytes(100000);
  for (std::size_t i = 1; i < bytes.size(); ++i)
    bytes[i] =
        chance() % 3 == 0 ? static_cast<std::uint8_t>(bytes[i - 1] ^ kTurns[chance() % 4]) : bytes[i - 1];
  const Bytes packed = deflate_fast(bytes);
  EXPECT_EQ(::crc32(0, packed.data(), static_cast<uInt>(packed.size())), 0x1C2BE4DEU);
}

}  // namespace
}  // namespace stereobench::renderer
