#include "renderer/camera/remap.h"

#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>

namespace stereobench::renderer {
namespace {

constexpr int kWays = cv::INTER_TAB_SIZE;  ///< places from one pixel to the next

/// Weights of two neighbours for each place between them, ready to be multiplied with.
struct Weights {
  Weights() {
    for (short way = 0; way < kWays; ++way) {
      const auto rest = static_cast<short>(kWays - way);
      std::fill_n(first[way], 8, rest);
      std::fill_n(second[way], 8, way);
      for (int i = 0; i < 8; ++i) in_turns[way][i] = i % 2 == 0 ? rest : way;
    }
  }
  alignas(16) short first[kWays][8];
  alignas(16) short second[kWays][8];
  alignas(16) short in_turns[kWays][8];
};

/// Blue, green and red between four pixels, rounded as cv::remap does; the fourth number is anything.
/// @param pixel the first of the four; two bytes beyond the second are looked at
cv::v_int32x4 light_between(const Weights& weights, const std::uint8_t* pixel, std::size_t step,
                            unsigned fraction) {
  const unsigned right = fraction % kWays, down = fraction / kWays;
  const cv::v_int16x8 above = cv::v_reinterpret_as_s16(cv::v_load_expand(pixel));
  const cv::v_int16x8 below = cv::v_reinterpret_as_s16(cv::v_load_expand(pixel + step));
  const cv::v_int16x8 between = cv::v_mul_wrap(above, cv::v_load_aligned(weights.first[down])) +
                                cv::v_mul_wrap(below, cv::v_load_aligned(weights.second[down]));
  cv::v_int16x8 neighbours, rest;
  cv::v_zip(between, cv::v_rotate_right<3>(between), neighbours, rest);
  const cv::v_int32x4 light = cv::v_dotprod(neighbours, cv::v_load_aligned(weights.in_turns[right]));
  static_assert(kWays * kWays == 1 << 10);
  return (light + cv::v_setall_s32(kWays * kWays / 2)) >> 10;
}

constexpr int kMiddleStep = 1 << 15;  // light of 16 bits is told from the middle: products are signed

/// Blue, green and red between two neighbours of one row, from the middle, times the weights of both.
cv::v_int32x4 weighed(const std::uint16_t* pixel, const cv::v_int16x8& in_turns) {
  const cv::v_int16x8 from_middle =
      cv::v_reinterpret_as_s16(cv::v_load(pixel) ^ cv::v_setall_u16(kMiddleStep));
  cv::v_int16x8 neighbours, rest;
  cv::v_zip(from_middle, cv::v_rotate_right<3>(from_middle), neighbours, rest);
  return cv::v_dotprod(neighbours, in_turns);
}

/// The same between four pixels, not rounded: 1024 times the light; the fourth number is anything.
cv::v_int32x4 light_between(const Weights& weights, const std::uint16_t* pixel, std::size_t step,
                            unsigned fraction) {
  const unsigned right = fraction % kWays, down = fraction / kWays;
  const cv::v_int16x8 in_turns = cv::v_load_aligned(weights.in_turns[right]);
  return weighed(pixel, cv::v_mul_wrap(in_turns, cv::v_load_aligned(weights.first[down]))) +
         weighed(pixel + step, cv::v_mul_wrap(in_turns, cv::v_load_aligned(weights.second[down])));
}

/// How the mean of four lights is taken of their sum: by how many bits the sum is larger, and what it is told
/// from.
template <class Level>
struct Mean;
template <>
struct Mean<std::uint8_t> {
  static constexpr int kBits = 2;
  static constexpr int kMiddle = 0;
};
template <>
struct Mean<std::uint16_t> {
  static constexpr int kBits = 12;
  static constexpr int kMiddle = kMiddleStep << kBits;
};

}  // namespace

template <class Level>
void gather_light(const LightPlaces (&places)[2], const UndistortedRows& undistorted, Level* distorted,
                  int width) {
  static const Weights weights;
  constexpr int kBits = Mean<Level>::kBits;
  const std::size_t step = undistorted.pixels.step1();
  const auto* origin =
      undistorted.pixels.ptr<Level>() - static_cast<std::ptrdiff_t>(step) * undistorted.first_row;
  const auto at = [&](const cv::Vec2s& place) {
    return origin + step * static_cast<std::size_t>(place[1]) + 3 * place[0];
  };
  for (int u = 0; u < width; ++u) {
    const Level* soon = at(places[1].pixels[std::min(2 * u + kPlacesAhead, 2 * width - 1)]);
    __builtin_prefetch(soon);
    __builtin_prefetch(soon + step);
    cv::v_int32x4 sum = cv::v_setall_s32(Mean<Level>::kMiddle + (1 << (kBits - 1)));
    for (const LightPlaces& row : places)
      for (int k = 2 * u; k < 2 * u + 2; ++k)
        sum += light_between(weights, at(row.pixels[k]), step, row.fractions[k]);
    int levels[4];
    cv::v_store(levels, sum >> kBits);
    for (int c = 0; c < 3; ++c) *distorted++ = static_cast<Level>(levels[c]);
  }
}

template void gather_light(const LightPlaces (&)[2], const UndistortedRows&, std::uint8_t*, int);
template void gather_light(const LightPlaces (&)[2], const UndistortedRows&, std::uint16_t*, int);

}  // namespace stereobench::renderer
