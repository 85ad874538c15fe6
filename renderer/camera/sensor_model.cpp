#include "renderer/camera/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "renderer/camera/defocus.h"
#include "renderer/camera/image_noise.h"
#include "renderer/types.h"
#include "slam/math/elementary.h"

namespace stereobench::renderer {
namespace {

constexpr float kWhite = 255.0F;
constexpr float kFewElectrons = 16.0F;  // up to here their number is drawn by inversion
constexpr int kStepsPerLevel = 64;      // of the encoder's table: finer than the steepest part of sRGB

/// Keeps of each pixel's light what the vignette leaves.
void darken_corners(Row& row, int y, const cv::Size& size, double vignette) {
  const double middle_x = 0.5 * (size.width - 1);
  const double middle_y = 0.5 * (size.height - 1);
  const double corner2 = middle_x * middle_x + middle_y * middle_y;
  for (int x = 0; x < size.width; ++x) {
    const double radius2 = (x - middle_x) * (x - middle_x) + (y - middle_y) * (y - middle_y);
    const auto kept = static_cast<float>(1.0 - vignette * radius2 / corner2);
    for (std::size_t channel = 0; channel < 3; ++channel)
      row[3 * static_cast<std::size_t>(x) + channel] *= kept;
  }
}

/// @return the smallest count whose cumulative Poisson probability exceeds the number's
float poisson_by_inversion(float expected, std::uint16_t bits) {
  const double uniform = (static_cast<double>(bits) + 0.5) / static_cast<double>(kQuantiles);
  double term = slam::exponential(-static_cast<double>(expected));
  double cumulative = term;
  int count = 0;
  while (cumulative < uniform && term > 0.0) {
    ++count;
    term *= static_cast<double>(expected) / count;
    cumulative += term;
  }
  return static_cast<float>(count);
}

const std::vector<float>& float_quantiles() {
  static const std::vector<float> quantiles(standard_normal_quantiles().begin(),
                                            standard_normal_quantiles().end());
  return quantiles;
}

/// What the pixels of a camera do, row by row, each stage for a whole row.
class Chip {
 public:
  Chip(const worlds::CameraSensor& sensor, std::uint64_t seed, std::uint64_t sequence, std::size_t row_size)
      : grains_(sensor.full_well_electrons > 0.0),
        // Without a well to fill, electrons are levels.
        electrons_per_level_(grains_ ? static_cast<float>(sensor.full_well_electrons) / kWhite : 1.0F),
        exposure_(static_cast<float>(sensor.exposure)),
        read_noise_(grains_ ? static_cast<float>(sensor.read_noise_electrons) : 0.0F),
        added_noise_(static_cast<float>(sensor.noise_sd_levels)),
        shot_({seed, slam::Stream::kShotNoise, sequence}),
        read_({seed, slam::Stream::kReadNoise, sequence}),
        added_({seed, slam::Stream::kImageNoise, sequence}),
        gains_(row_size),
        bits_(row_size),
        normal_(row_size) {
    for (std::size_t i = 0; i < row_size; ++i)
      gains_[i] = static_cast<float>(sensor.gain * sensor.white_balance_rgb[2 - static_cast<int>(i % 3)]);
  }

  /// Makes levels, not yet encoded, of a row of light in levels.
  void develop(Row& row, int y) {
    for (float& light : row) light = light * exposure_ * electrons_per_level_;
    if (grains_) {
      draw(shot_, y);
      add_shot_noise(row);
    }
    if (read_noise_ > 0.0F) {
      draw(read_, y);
      add_normal(row, read_noise_);
    }
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = gains_[i] * row[i] / electrons_per_level_;
    if (added_noise_ > 0.0F) {
      draw(added_, y);
      add_normal(row, added_noise_);
    }
  }

 private:
  /// Random numbers for a row: 16 bits of a stream for each of its values, and the normal number they stand
  /// for.
  void draw(const NoiseNumbers& stream, int y) {
    stream.draw(static_cast<std::uint64_t>(y) * bits_.size(), bits_);
    for (std::size_t i = 0; i < bits_.size(); ++i) normal_[i] = quantiles_[bits_[i]];
  }

  void add_normal(Row& row, float sd) const {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] += sd * normal_[i];
  }

  void add_shot_noise(Row& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const float expected = row[i], z = normal_[i];
      // Of few electrons, the root is that of a number below 0, perhaps; they are counted below.
      normal_[i] = expected + std::sqrt(expected - 1.0F / 18.0F) * z + (z * z - 1.0F) / 6.0F;
    }
    int few = 0;
    for (const float expected : row) few += expected < kFewElectrons ? 1 : 0;
    for (std::size_t i = 0; few > 0 && i < row.size(); ++i) {
      if (!(row[i] < kFewElectrons)) continue;
      normal_[i] = poisson_by_inversion(row[i], bits_[i]);
      --few;
    }
    std::swap(row, normal_);
  }

  bool grains_;
  float electrons_per_level_;
  float exposure_;
  float read_noise_;
  float added_noise_;
  NoiseNumbers shot_;
  NoiseNumbers read_;
  NoiseNumbers added_;
  Row gains_;  ///< of each value of a row
  std::vector<std::uint16_t> bits_;
  Row normal_;
  const std::vector<float>& quantiles_ = float_quantiles();
};

double encode(double light, const worlds::CameraSensor& sensor) {
  if (sensor.encoding == worlds::Encoding::kGamma) return slam::power(light, 1.0 / sensor.gamma);
  if (sensor.encoding == worlds::Encoding::kLinear) return light;
  return light <= 0.0031308 ? 12.92 * light : 1.055 * slam::power(light, 1.0 / 2.4) - 0.055;
}

double decode(double stored, const worlds::CameraSensor& sensor) {
  if (sensor.encoding == worlds::Encoding::kGamma) return slam::power(stored, sensor.gamma);
  return stored <= 0.04045 ? stored / 12.92 : slam::power((stored + 0.055) / 1.055, 2.4);
}

/// The stored bytes of levels, by table.
class Encoder {
 public:
  explicit Encoder(const worlds::CameraSensor& sensor)
      : steps_per_level_(sensor.encoding == worlds::Encoding::kLinear ? 1 : kStepsPerLevel),
        codes_(255 * static_cast<std::size_t>(steps_per_level_) + 1) {
    fill(sensor, 0, codes_.size() - 1);
  }

  /// @param places as many as there are levels, which it overwrites
  void encode_row(const Row& levels, std::vector<int>& places, std::uint8_t* stored) const {
    const auto steps = static_cast<float>(steps_per_level_);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const float clamped = std::clamp(levels[i], 0.0F, kWhite);  // NaN cannot be: all that goes in is finite
      places[i] = static_cast<int>(clamped * steps + 0.5F);
    }
    const std::uint8_t* const codes = codes_.data();  // local: a byte that is stored may alias members
    const int* const at = places.data();
    for (std::size_t i = 0, size = levels.size(); i < size; ++i) stored[i] = codes[at[i]];
  }

 private:
  std::uint8_t code(const worlds::CameraSensor& sensor, std::size_t step) const {
    const double light = static_cast<double>(step) / static_cast<double>(codes_.size() - 1);
    return static_cast<std::uint8_t>(std::lround(255.0 * encode(std::min(light, 1.0), sensor)));
  }

  /// Fills what lies from one step to another: codes never fall, so what lies between two that are the same
  /// is known.
  void fill(const worlds::CameraSensor& sensor, std::size_t first, std::size_t last) {
    codes_[first] = code(sensor, first);
    codes_[last] = code(sensor, last);
    if (codes_[first] == codes_[last]) {
      std::fill(codes_.begin() + static_cast<std::ptrdiff_t>(first),
                codes_.begin() + static_cast<std::ptrdiff_t>(last), codes_[first]);
    } else if (last - first > 1) {
      const std::size_t middle = (first + last) / 2;
      fill(sensor, first, middle);
      fill(sensor, middle, last);
    }
  }

  int steps_per_level_;
  std::vector<std::uint8_t> codes_;  ///< by step of light
};

/// Hands on the levels of each row, not yet encoded.
template <class TakeRow>
void develop_rows(const cv::Mat& light, const worlds::CameraSensor& sensor, std::uint64_t seed,
                  std::uint64_t sequence, const TakeRow& take) {
  std::optional<Defocus> defocus;
  if (sensor.defocus_sd_px > 0.0) defocus.emplace(light, sensor.defocus_sd_px);
  const float per_level = light.depth() == CV_16U ? float{kStepsOfALevel} : 1.0F;
  Row row(3 * static_cast<std::size_t>(light.cols));
  Chip chip(sensor, seed, sequence, row.size());
  for (int y = 0; y < light.rows; ++y) {
    if (defocus)
      defocus->take(y, row);
    else
      take_row(light, y, row.data());
    if (per_level != 1.0F)
      for (float& level : row) level /= per_level;
    if (sensor.vignette > 0.0) darken_corners(row, y, light.size(), sensor.vignette);
    chip.develop(row, y);
    take(row, y);
  }
}

}  // namespace

cv::Mat develop(const cv::Mat& light, const worlds::CameraSensor& sensor, std::uint64_t seed,
                std::uint64_t sequence) {
  const Encoder encoder(sensor);
  cv::Mat levels(light.size(), CV_8UC3);
  std::vector<int> places(3 * static_cast<std::size_t>(light.cols));
  develop_rows(light, sensor, seed, sequence,
               [&](const Row& row, int y) { encoder.encode_row(row, places, levels.ptr(y)); });
  return levels;
}

cv::Mat develop_linear16(const cv::Mat& light, const worlds::CameraSensor& sensor, std::uint64_t seed,
                         std::uint64_t sequence) {
  cv::Mat steps(light.size(), CV_16UC3);
  develop_rows(light, sensor, seed, sequence, [&](const Row& row, int y) {
    std::ranges::transform(row, steps.ptr<std::uint16_t>(y), [](float level) {
      return static_cast<std::uint16_t>(std::clamp(level, 0.0F, kWhite) * float{kStepsOfALevel} + 0.5F);
    });
  });
  return steps;
}

cv::Mat in_levels(const cv::Mat& light) {
  if (light.depth() == CV_8U) return light;
  cv::Mat levels;
  light.convertTo(levels, CV_8U, 1.0 / kStepsOfALevel);
  return levels;
}

cv::Mat decode(const cv::Mat& levels, const worlds::CameraSensor& sensor) {
  if (sensor.encoding == worlds::Encoding::kLinear) return levels;
  cv::Mat table(1, 256, CV_8U);
  for (int i = 0; i < 256; ++i)
    table.at<std::uint8_t>(i) = static_cast<std::uint8_t>(std::lround(255.0 * decode(i / 255.0, sensor)));
  cv::Mat light;
  cv::LUT(levels, table, light);
  return light;
}

double noise_sd_levels(const worlds::CameraSensor& sensor, double level) {
  double variance = sensor.noise_sd_levels * sensor.noise_sd_levels;
  if (sensor.full_well_electrons > 0.0) {
    const double electrons = level / 255.0 * sensor.exposure * sensor.full_well_electrons;
    const double levels_per_electron = sensor.gain * 255.0 / sensor.full_well_electrons;
    variance += levels_per_electron * levels_per_electron *
                (electrons + sensor.read_noise_electrons * sensor.read_noise_electrons);
  }
  return std::sqrt(variance);
}

}  // namespace stereobench::renderer
