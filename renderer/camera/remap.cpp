#include "renderer/camera/remap.h"

#include <array>
#include <cmath>
#include <vector>

#include <opencv2/core/hal/intrin.hpp>

namespace stereobench::renderer {
namespace {

constexpr double kSpreadStep = (kMostSpread - kLeastSpread) / (kSpreads - 1);
constexpr int kWeightBits = 7;
constexpr int kWhole = 1 << kWeightBits;  ///< sum of the weights of three pixels

/// Weights of the pixel before a place, of the nearest one and of the one after.
using Weights = std::array<std::int16_t, 3>;

/// Weights around a place `phase` after its nearest pixel. The mean is exact: the last weight less the first
/// is the phase. The variance is as near to the spread as whole weights allow.
Weights weights_of(int phase, double spread) {
  static_assert(kPhases == kWhole);
  const double after = static_cast<double>(phase) / kWhole;
  int outer = static_cast<int>(std::floor(kWhole * (spread + after * after)));  // sum of first and last
  if ((outer - phase) % 2 != 0) ++outer;
  return {static_cast<std::int16_t>((outer - phase) / 2), static_cast<std::int16_t>(kWhole - outer),
          static_cast<std::int16_t>((outer + phase) / 2)};
}

/// Weights of a phase and a spread, ready to be multiplied with.
struct ReadyWeights {
  alignas(16) std::int16_t of_row[3][8];
  alignas(16) std::int16_t first_two[8];  ///< in turns
  alignas(16) std::int16_t last[8];       ///< in turns with 0
};

class WeightTable {
 public:
  WeightTable() : ready_(kSpreads * kPhases) {
    for (int spread = 0; spread < kSpreads; ++spread)
      for (int phase = -kPhases / 2; phase < kPhases / 2; ++phase)
        fill(ready_[index(phase, spread)], weights_of(phase, kLeastSpread + spread * kSpreadStep));
  }

  const ReadyWeights& across(const PinholePlace& place) const {
    return ready_[index(place.right_of, place.across)];
  }
  const ReadyWeights& down(const PinholePlace& place) const { return ready_[index(place.below, place.down)]; }

 private:
  static std::size_t index(int phase, int spread) {
    return static_cast<std::size_t>(spread * kPhases + phase + kPhases / 2);
  }

  static void fill(ReadyWeights& ready, const Weights& weights) {
    for (std::size_t k = 0; k < 3; ++k) std::fill_n(ready.of_row[k], 8, weights[k]);
    for (std::size_t i = 0; i < 8; ++i) {
      ready.first_two[i] = weights[i % 2];
      ready.last[i] = i % 2 == 0 ? weights[2] : std::int16_t{0};
    }
  }

  std::vector<ReadyWeights> ready_;
};

/// Blue, green and red of three neighbours of a row, weighed; the fourth number is anything.
/// @param pixels blue, green, red of the first two; @param later of the last two
cv::v_int32x4 weighed(const cv::v_int16x8& pixels, const cv::v_int16x8& later, const cv::v_int16x8& first_two,
                      const cv::v_int16x8& last) {
  cv::v_int16x8 pairs, single, rest;
  cv::v_zip(pixels, later, pairs, rest);
  cv::v_zip(cv::v_rotate_right<3>(later), cv::v_setzero_s16(), single, rest);
  return cv::v_dotprod(pairs, first_two) + cv::v_dotprod(single, last);
}

/// Light of 8 bits around a place, times kWhole^2: columns first, whose sums fit 16 bits.
/// @param pixel the first of nine
cv::v_int32x4 light_around(const ReadyWeights& across, const ReadyWeights& down, const std::uint8_t* pixel,
                           std::size_t step) {
  cv::v_int16x8 pixels = cv::v_setzero_s16(), later = cv::v_setzero_s16();
  for (std::size_t k = 0; k < 3; ++k, pixel += step) {
    const cv::v_int16x8 weight = cv::v_load_aligned(down.of_row[k]);
    pixels += cv::v_mul_wrap(cv::v_reinterpret_as_s16(cv::v_load_expand(pixel)), weight);
    later += cv::v_mul_wrap(cv::v_reinterpret_as_s16(cv::v_load_expand(pixel + 3)), weight);
  }
  return weighed(pixels, later, cv::v_load_aligned(across.first_two), cv::v_load_aligned(across.last));
}

constexpr int kMiddle = 1 << 15;  // light of 16 bits is told from the middle: products are signed

/// The same of 16 bits, from the middle.
cv::v_int32x4 light_around(const ReadyWeights& across, const ReadyWeights& down, const std::uint16_t* pixel,
                           std::size_t step) {
  const cv::v_int16x8 first_two = cv::v_load_aligned(across.first_two);
  const cv::v_int16x8 last = cv::v_load_aligned(across.last);
  const auto from_middle = [](const std::uint16_t* light) {
    return cv::v_reinterpret_as_s16(cv::v_load(light) ^ cv::v_setall_u16(kMiddle));
  };
  cv::v_int32x4 sum = cv::v_setzero_s32();
  for (std::size_t k = 0; k < 3; ++k, pixel += step) {
    const cv::v_int16x8 weight = cv::v_load_aligned(down.of_row[k]);
    sum += weighed(from_middle(pixel), from_middle(pixel + 3), cv::v_mul_wrap(first_two, weight),
                   cv::v_mul_wrap(last, weight));
  }
  return sum;
}

/// What light_around is told from, times kWhole^2.
template <class Level>
constexpr int kOrigin = 0;
template <>
constexpr int kOrigin<std::uint16_t> = kMiddle << (2 * kWeightBits);

}  // namespace

PinholePlace place_at(const Eigen::Vector2d& column_row, const Eigen::Vector2d& spread) {
  const long right = std::lround(column_row.x() * kPhases), down = std::lround(column_row.y() * kPhases);
  const auto nearest = [](long phases) {
    return static_cast<std::int16_t>((phases + kPhases / 2) >> kWeightBits);
  };
  const auto number = [](double variance) {
    return static_cast<std::uint8_t>(
        std::lround((std::clamp(variance, kLeastSpread, kMostSpread) - kLeastSpread) / kSpreadStep));
  };
  PinholePlace place{nearest(right), nearest(down), 0, 0, number(spread.x()), number(spread.y())};
  place.right_of = static_cast<std::int8_t>(right - kPhases * place.column);
  place.below = static_cast<std::int8_t>(down - kPhases * place.row);
  return place;
}

template <class Level>
void gather_light(const PinholePlace* places, const UndistortedRows& undistorted, Level* distorted,
                  int width) {
  static const WeightTable table;
  constexpr int kBits = 2 * kWeightBits;
  const std::size_t step = undistorted.pixels.step1();
  const auto* origin =
      undistorted.pixels.ptr<Level>() - static_cast<std::ptrdiff_t>(step) * undistorted.first_row;
  const auto first_of_nine = [&](const PinholePlace& place) {
    return origin + static_cast<std::ptrdiff_t>(step) * (place.row - 1) + 3 * (place.column - 1);
  };
  for (int u = 0; u < width; ++u) {
    __builtin_prefetch(first_of_nine(places[std::min(u + kPlacesAhead, width - 1)]) + 2 * step);
    const PinholePlace& place = places[u];
    const cv::v_int32x4 sum =
        light_around(table.across(place), table.down(place), first_of_nine(place), step) +
        cv::v_setall_s32(kOrigin<Level> + (1 << (kBits - 1)));
    int levels[4];
    cv::v_store(levels, sum >> kBits);
    for (int c = 0; c < 3; ++c) *distorted++ = static_cast<Level>(levels[c]);
  }
}

template void gather_light(const PinholePlace*, const UndistortedRows&, std::uint8_t*, int);
template void gather_light(const PinholePlace*, const UndistortedRows&, std::uint16_t*, int);

}  // namespace stereobench::renderer
