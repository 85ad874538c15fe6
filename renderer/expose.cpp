#include "renderer/expose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <Random123/philox.h>
#include <opencv2/core/hal/intrin.hpp>

#include "slam/random.h"

namespace stereobench::renderer {
namespace {

constexpr std::size_t kQuantiles = 65536;       // one for each value of 16 random bits
constexpr int kFractionBits = 7;                // shifts are fixed-point numbers, in 1/128 levels
constexpr double kLargestShift_levels = 255.0;  // clamps every pixel, as any larger shift would
constexpr std::size_t kShiftsPerBlock = 8;
constexpr std::size_t kBlocksAtOnce = 256;

using Shifts = std::vector<std::int16_t>;
using Counter = r123::Philox4x32::ctr_type;
using Key = r123::Philox4x32::key_type;

/// The normal distribution in equally likely pieces: antisymmetric and of variance 1 exactly.
std::vector<double> standard_normal_quantiles() {
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

/// A shift s stands for (s + 1/2) / 128 levels: the halves keep the table antisymmetric and free of ties, so
/// that rounding has no favourite direction.
Shifts shifts_for(double sd_levels) {
  static const std::vector<double> quantiles = standard_normal_quantiles();
  Shifts shifts(kQuantiles);
  std::transform(quantiles.begin(), quantiles.end(), shifts.begin(), [&](double quantile) {
    const double levels = std::clamp(sd_levels * quantile, -kLargestShift_levels, kLargestShift_levels);
    return static_cast<std::int16_t>(std::floor(levels * (1 << kFractionBits)));
  });
  return shifts;
}

std::uint32_t low(std::uint64_t value) {
  return static_cast<std::uint32_t>(value);
}
std::uint32_t high(std::uint64_t value) {
  return static_cast<std::uint32_t>(value >> 32);
}

/// The blocks of slam::RandomStream(seed, kImageNoise, index), whole and without a call for each number.
struct NoiseBlocks {
  Key key;
  std::uint32_t stream_word;
  std::uint64_t index;

  NoiseBlocks(std::uint64_t seed, std::uint64_t sequence)
      : key{{low(seed), high(seed)}},
        stream_word(static_cast<std::uint32_t>(slam::Stream::kImageNoise) << 24),
        index(sequence) {}

  Counter block(std::uint64_t number) const {
    const Counter counter = {{low(number), stream_word | high(number), low(index), high(index)}};
    return r123::Philox4x32{}(counter, key);
  }
};

/// The shifts of one block of random numbers, the low half of each word first.
void look_up(const Counter& words, const Shifts& shifts, std::int16_t* looked_up) {
  for (std::size_t i = 0; i < 4; ++i) {
    looked_up[2 * i] = shifts[words[i] & 0xffffU];
    looked_up[2 * i + 1] = shifts[words[i] >> 16];
  }
}

/// Adds shifts to eight levels, rounds and clamps; sums beyond 16 bits saturate, which clamps just as well.
void shift_levels(std::uint8_t* levels, const std::int16_t* shifts) {
  const cv::v_int16x8 fixed = cv::v_reinterpret_as_s16(cv::v_load_expand(levels) << kFractionBits);
  const cv::v_int16x8 half = cv::v_setall_s16(1 << (kFractionBits - 1));
  cv::v_pack_u_store(levels, (fixed + cv::v_load(shifts) + half) >> kFractionBits);
}

/// Shifts a whole number of blocks. Numbers are drawn for many blocks before they are added, because the
/// processor cannot read eight numbers at once that it has just written one by one.
void add_noise(std::uint8_t* levels, std::uint64_t first_block, std::size_t blocks, const NoiseBlocks& noise,
               const Shifts& shifts) {
  std::array<std::int16_t, kBlocksAtOnce * kShiftsPerBlock> drawn;
  for (std::size_t i = 0; i < blocks; ++i) {
    look_up(noise.block(first_block + i), shifts, &drawn[i * kShiftsPerBlock]);
  }
  for (std::size_t i = 0; i < blocks; ++i) {
    shift_levels(levels + i * kShiftsPerBlock, &drawn[i * kShiftsPerBlock]);
  }
}

cv::Mat noisy(const cv::Mat& picture, const Shifts& shifts, const NoiseBlocks& noise) {
  cv::Mat result = picture.clone();  // continuous, so that its bytes are one sequence
  const std::size_t size = result.total() * result.elemSize();
  const std::size_t whole = size / kShiftsPerBlock;
  for (std::size_t block = 0; block < whole; block += kBlocksAtOnce) {
    add_noise(result.ptr() + block * kShiftsPerBlock, block, std::min(kBlocksAtOnce, whole - block), noise,
              shifts);
  }
  std::array<std::uint8_t, kShiftsPerBlock> rest{};  // the last bytes, filled up to a block
  std::uint8_t* rest_of_picture = result.ptr() + whole * kShiftsPerBlock;
  std::copy_n(rest_of_picture, size % kShiftsPerBlock, rest.begin());
  add_noise(rest.data(), whole, 1, noise, shifts);
  std::copy_n(rest.begin(), size % kShiftsPerBlock, rest_of_picture);
  return result;
}

}  // namespace

vision::StereoPair expose(const StereoFrame& frame, const worlds::CameraSensor& sensor, std::uint64_t seed,
                          std::uint64_t frame_index) {
  const cv::Mat& left = frame.left.colour;
  const cv::Mat& right = frame.right.colour;
  if (left.type() != CV_8UC3 || right.type() != CV_8UC3) {
    throw std::invalid_argument("expose: pictures must have three channels of 8 bits");
  }
  if (!std::isfinite(sensor.noise_sd_levels) || sensor.noise_sd_levels < 0.0) {
    throw std::invalid_argument("expose: the noise must be finite and not negative");
  }
  if (sensor.noise_sd_levels == 0.0) return {left, right};
  const Shifts shifts = shifts_for(sensor.noise_sd_levels);
  return {noisy(left, shifts, NoiseBlocks(seed, 2 * frame_index)),
          noisy(right, shifts, NoiseBlocks(seed, 2 * frame_index + 1))};
}

}  // namespace stereobench::renderer
