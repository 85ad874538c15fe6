/// Random numbers for pictures: a function of seed, frame, camera and position, and of nothing else.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam/math/random.h"

namespace stereobench::renderer {

inline constexpr std::size_t kQuantiles = 65536;  ///< one for each value of 16 random bits

/// Which numbers: those of slam::RandomStream(seed, stream, sequence).
struct NoiseKey {
  std::uint64_t seed = 0;
  slam::Stream stream = slam::Stream::kImageNoise;
  std::uint64_t sequence = 0;  ///< 2 * frame + camera
};

/// The numbers of a random stream, 16 bits each, many at a time: of each of its words the low half comes
/// first.
class NoiseNumbers {
 public:
  explicit NoiseNumbers(const NoiseKey& key) : key_(key) {}

  /// @param first how many numbers of the stream come before them
  /// @param numbers to be filled
  void draw(std::uint64_t first, std::span<std::uint16_t> numbers) const;

 private:
  NoiseKey key_;
};

/// The normal distribution in 65536 equally likely pieces, antisymmetric and of variance 1 exactly.
const std::vector<double>& standard_normal_quantiles();

}  // namespace stereobench::renderer
