#include "renderer/camera/image_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/camera/philox_blocks.h"

namespace stereobench::renderer {
namespace {

constexpr std::uint64_t kCounters = std::uint64_t{1}
                                    << 32;  ///< of a block, before the next word of it counts

std::uint32_t low(std::uint64_t value) {
  return static_cast<std::uint32_t>(value);
}

std::uint32_t high(std::uint64_t value) {
  return static_cast<std::uint32_t>(value >> 32);
}

/// Blocks of a stream, by their number.
void write_numbers(const NoiseKey& key, std::uint64_t block, std::size_t count, std::uint16_t* numbers) {
  while (count > 0) {
    const std::size_t now = std::min<std::uint64_t>(count, kCounters - low(block));
    const std::uint32_t second = (static_cast<std::uint32_t>(key.stream) << 24) | high(block);
    write_blocks({.key = {{low(key.seed), high(key.seed)}},
                  .first = {{low(block), second, low(key.sequence), high(key.sequence)}},
                  .count = now},
                 numbers);
    numbers += now * kNumbersPerBlock;
    block += now;
    count -= now;
  }
}

std::vector<double> make_quantiles() {
  std::vector<double> quantiles(kQuantiles);
  double sum = 0.0;
  for (std::size_t i = 0; i < kQuantiles / 2; ++i) {
    quantiles[i] = slam::normal_quantile((static_cast<double>(i) + 0.5) / static_cast<double>(kQuantiles));
    sum += 2.0 * quantiles[i] * quantiles[i];
  }
  const double to_unit_variance = std::sqrt(static_cast<double>(kQuantiles) / sum);
  for (std::size_t i = 0; i < kQuantiles / 2; ++i) {
    quantiles[i] *= to_unit_variance;
    quantiles[kQuantiles - 1 - i] = -quantiles[i];
  }
  return quantiles;
}

}  // namespace

void NoiseNumbers::draw(std::uint64_t first, std::span<std::uint16_t> numbers) const {
  std::array<std::uint16_t, kNumbersPerBlock> part;  // of a block that lies within the numbers in part
  while (!numbers.empty()) {
    const std::uint64_t block = first / kNumbersPerBlock;
    const std::size_t skipped = first % kNumbersPerBlock, whole = numbers.size() / kNumbersPerBlock;
    std::size_t drawn = whole * kNumbersPerBlock;
    if (skipped == 0 && whole > 0) {
      write_numbers(key_, block, whole, numbers.data());
    } else {
      write_numbers(key_, block, 1, part.data());
      drawn = std::min(kNumbersPerBlock - skipped, numbers.size());
      std::copy_n(part.begin() + static_cast<std::ptrdiff_t>(skipped), drawn, numbers.begin());
    }
    numbers = numbers.subspan(drawn);
    first += drawn;
  }
}

const std::vector<double>& standard_normal_quantiles() {
  static const std::vector<double> quantiles = make_quantiles();
  return quantiles;
}

}  // namespace stereobench::renderer
