/// Random numbers for pictures: a function of seed, frame, camera and position, and of nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Random123/philox.h>

#include "slam/math/random.h"

namespace stereobench::renderer {

inline constexpr std::size_t kQuantiles = 65536;    ///< one for each value of 16 random bits
inline constexpr std::size_t kNumbersPerBlock = 8;  ///< of 16 bits each

/// Which numbers: those of slam::RandomStream(seed, stream, sequence).
struct NoiseKey {
  std::uint64_t seed = 0;
  slam::Stream stream = slam::Stream::kImageNoise;
  std::uint64_t sequence = 0;  ///< 2 * frame + camera
};

/// The blocks of a random stream, whole and without a call for each number.
class NoiseBlocks {
 public:
  explicit NoiseBlocks(const NoiseKey& key)
      : key_{{low(key.seed), high(key.seed)}},
        stream_word_(static_cast<std::uint32_t>(key.stream) << 24),
        sequence_(key.sequence) {}

  /// @return eight numbers of 16 bits, the low half of each word first
  std::array<std::uint16_t, kNumbersPerBlock> operator()(std::uint64_t number) const {
    const r123::Philox4x32::ctr_type counter = {
        {low(number), stream_word_ | high(number), low(sequence_), high(sequence_)}};
    const r123::Philox4x32::ctr_type words = r123::Philox4x32{}(counter, key_);
    std::array<std::uint16_t, kNumbersPerBlock> numbers;
    for (std::size_t i = 0; i < 4; ++i) {
      numbers[2 * i] = static_cast<std::uint16_t>(words[i] & 0xffffU);
      numbers[2 * i + 1] = static_cast<std::uint16_t>(words[i] >> 16);
    }
    return numbers;
  }

 private:
  static std::uint32_t low(std::uint64_t value) { return static_cast<std::uint32_t>(value); }
  static std::uint32_t high(std::uint64_t value) { return static_cast<std::uint32_t>(value >> 32); }

  r123::Philox4x32::key_type key_;
  std::uint32_t stream_word_;
  std::uint64_t sequence_;
};

/// The normal distribution in 65536 equally likely pieces, antisymmetric and of variance 1 exactly.
const std::vector<double>& standard_normal_quantiles();

}  // namespace stereobench::renderer
