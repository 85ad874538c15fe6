/// The numbers of a random stream, many at a time.
///
/// Mutations seen red here: the key's second word not raised from round to round, two of four blocks in
/// the place of the others, the counter's second word left as it is beyond 2^32 blocks, a part of a block
/// begun at its front.

#include "renderer/camera/image_noise.h"

#include <gtest/gtest.h>

#include "renderer/camera/philox_blocks.h"

namespace stereobench::renderer {
namespace {

constexpr NoiseKey kKey = {0x123456789abcULL, slam::Stream::kShotNoise, 0x500000021ULL};

/// Number after number, as RandomStream has them.
std::vector<std::uint16_t> one_by_one(std::size_t count) {
  slam::RandomStream words(kKey.seed, kKey.stream, kKey.sequence);
  std::vector<std::uint16_t> numbers;
  while (numbers.size() < count) {
    const std::uint32_t word = words.bits();
    numbers.push_back(static_cast<std::uint16_t>(word & 0xffffU));
    numbers.push_back(static_cast<std::uint16_t>(word >> 16));
  }
  numbers.resize(count);
  return numbers;
}

std::vector<std::uint16_t> drawn(std::uint64_t first, std::size_t count) {
  std::vector<std::uint16_t> numbers(count);
  NoiseNumbers(kKey).draw(first, numbers);
  return numbers;
}

TEST(NoiseNumbers, AreThoseOfTheStreamFromAnyPlaceOn) {
  const std::vector<std::uint16_t> all = one_by_one(200);
  for (std::size_t first = 0; first < 20; ++first)
    for (const std::size_t count : {0U, 1U, 7U, 8U, 9U, 31U, 32U, 33U, 100U}) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
      EXPECT_EQ(drawn(first, count),
                std::vector<std::uint16_t>(begin, begin + static_cast<std::ptrdiff_t>(count)))
          << first << " " << count;
    }
}

/// There a word of the counter begins again, and the next one counts.
TEST(NoiseNumbers, GoOnBeyondFourThousandMillionBlocks) {
  const std::uint64_t last_blocks = (std::uint64_t{1} << 32) - 3;
  const std::vector<std::uint16_t> across = drawn(8 * last_blocks, 8 * 6);
  for (std::uint64_t i = 0; i < 6; ++i) {
    const std::uint64_t number = last_blocks + i;
    const auto low = static_cast<std::uint32_t>(number);
    const std::uint32_t stream = static_cast<std::uint32_t>(kKey.stream) << 24;
    const r123::Philox4x32::ctr_type words = r123::Philox4x32{}(
        {{low, stream | static_cast<std::uint32_t>(number >> 32), 0x21, 0x5}}, {{0x56789abc, 0x1234}});
    for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(across[8 * i + 2 * j], words[j] & 0xffffU) << number;
  }
}

PhiloxBlocks some_blocks(std::size_t count, slam::RandomStream& random) {
  return {.key = {{random.bits(), random.bits()}},
          .first = {{random.bits() / 2, random.bits(), random.bits(), random.bits()}},
          .count = count};
}

TEST(PhiloxBlocks, AreTheSameInWideRegisters) {
  slam::RandomStream random(1, slam::Stream::kOracle);
  for (std::size_t count = 0; count < 40; ++count) {
    const PhiloxBlocks blocks = some_blocks(count, random);
    std::vector<std::uint16_t> wide(8 * count), narrow(8 * count);
    write_blocks(blocks, wide.data());
    write_blocks_one_by_one(blocks, narrow.data());
    EXPECT_EQ(wide, narrow) << count;
  }
}

/// In every second case the counter of the last block is 2^32 - 1.
TEST(PhiloxBlocks, AreTheSameInRegistersOfEachWidth) {
  slam::RandomStream random(2, slam::Stream::kOracle);
  for (const WriteManyBlocks write_many : wide_writers())
    for (std::size_t count = 0; count < 40; ++count) {
      PhiloxBlocks blocks = some_blocks(count, random);
      if (count % 2 == 1) blocks.first[0] = static_cast<std::uint32_t>((std::uint64_t{1} << 32) - count);
      std::vector<std::uint16_t> wide(8 * count), narrow(8 * count);
      const std::size_t done = write_many(blocks, wide.data());
      EXPECT_LT(count - done, 8U);
      write_blocks_one_by_one(blocks, narrow.data());
      narrow.resize(8 * done), wide.resize(8 * done);
      EXPECT_EQ(wide, narrow) << count;
    }
}

}  // namespace
}  // namespace stereobench::renderer
