#include "renderer/camera/sensor_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "renderer/camera/image_noise.h"
#include "renderer/types.h"
#include "slam/math/elementary.h"

namespace stereobench::renderer {
namespace {

constexpr float kWhite = 255.0F;
constexpr float kFewElectrons = 16.0F;  // up to here their number is drawn by inversion
constexpr int kStepsPerLevel = 64;      // of the encoder's table: finer than the steepest part of sRGB

/// A row of light, three channels a pixel.
using Row = std::vector<float>;

/// Half a Gaussian, normalised as the whole one: the weight of the centre, then of each neighbour outwards.
/// It is the Gaussian's discrete analogue, exp(-t) I_n(t) with t = sd^2 (Lindeberg 1990), whose variance is t
/// however small: samples of the Gaussian itself blur by less than half a pixel too little. The ratios of the
/// Bessel functions come from their recurrence, I_n-1 = I_n+1 + (2n / t) I_n, read downwards.
std::vector<float> half_gaussian(double sd_px) {
  const double variance = sd_px * sd_px;
  const auto reach = static_cast<std::size_t>(std::ceil(4.0 * sd_px)) + 2;
  std::vector<double> ratios(reach + 1);  // of each weight to the one before
  double ratio = 0.0;
  for (std::size_t n = 2 * reach + 30; n > 0; --n) {
    ratio = 1.0 / (2.0 * static_cast<double>(n) / variance + ratio);
    if (n <= reach) ratios[n] = ratio;
  }
  std::vector<double> weights = {1.0};
  double sum = 1.0;
  for (std::size_t n = 1; n <= reach; ++n) {
    weights.push_back(weights.back() * ratios[n]);
    sum += 2.0 * weights.back();
  }
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(static_cast<float>(weight / sum));
  return normalised;
}

/// The picture blurred along rows, then along columns; beyond the border lies what is at the border.
/// OpenCV's blur of floats has other bits on other processors.
cv::Mat blurred(const cv::Mat& light, double sd_px) {
  const std::vector<float> weights = half_gaussian(sd_px);
  const int reach = static_cast<int>(weights.size()) - 1;
  cv::Mat wide;
  cv::copyMakeBorder(light, wide, reach, reach, reach, reach, cv::BORDER_REPLICATE);
  wide.convertTo(wide, CV_32FC3);
  const int width = 3 * light.cols;
  cv::Mat across(wide.rows, light.cols, CV_32FC3);
  for (int y = 0; y < wide.rows; ++y) {
    const float* centre = wide.ptr<float>(y) + 3 * reach;
    float* sum = across.ptr<float>(y);
    for (int x = 0; x < width; ++x) sum[x] = weights[0] * centre[x];
    for (int k = 1; k <= reach; ++k) {
      const float weight = weights[static_cast<std::size_t>(k)];
      for (int x = 0; x < width; ++x) sum[x] += weight * (centre[x - 3 * k] + centre[x + 3 * k]);
    }
  }
  cv::Mat both(light.size(), CV_32FC3);
  for (int y = 0; y < light.rows; ++y) {
    float* sum = both.ptr<float>(y);
    const float* centre = across.ptr<float>(y + reach);
    for (int x = 0; x < width; ++x) sum[x] = weights[0] * centre[x];
    for (int k = 1; k <= reach; ++k) {
      const float weight = weights[static_cast<std::size_t>(k)];
      const float* above = across.ptr<float>(y + reach - k);
      const float* below = across.ptr<float>(y + reach + k);
      for (int x = 0; x < width; ++x) sum[x] += weight * (above[x] + below[x]);
    }
  }
  return both;
}

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

/// Sixteen random bits for each number of a picture, in order.
class BitStream {
 public:
  explicit BitStream(const NoiseKey& key) : blocks_(key) {}
  std::uint16_t next() {
    if (used_ == kNumbersPerBlock) {
      numbers_ = blocks_(block_++);
      used_ = 0;
    }
    return numbers_[used_++];
  }

 private:
  NoiseBlocks blocks_;
  std::uint64_t block_ = 0;
  std::array<std::uint16_t, kNumbersPerBlock> numbers_{};
  std::size_t used_ = kNumbersPerBlock;
};

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

float shot_noise(float expected, std::uint16_t bits, const std::vector<float>& normal) {
  if (expected < kFewElectrons) return poisson_by_inversion(expected, bits);
  const float z = normal[bits];
  return expected + std::sqrt(expected - 1.0F / 18.0F) * z + (z * z - 1.0F) / 6.0F;
}

const std::vector<float>& float_quantiles() {
  static const std::vector<float> quantiles(standard_normal_quantiles().begin(),
                                            standard_normal_quantiles().end());
  return quantiles;
}

/// What one pixel of a camera does, the same for all pixels.
class Chip {
 public:
  Chip(const worlds::CameraSensor& sensor, std::uint64_t seed, std::uint64_t sequence)
      : grains_(sensor.full_well_electrons > 0.0),
        // Without a well to fill, electrons are levels.
        electrons_per_level_(grains_ ? static_cast<float>(sensor.full_well_electrons) / kWhite : 1.0F),
        exposure_(static_cast<float>(sensor.exposure)),
        read_noise_(grains_ ? static_cast<float>(sensor.read_noise_electrons) : 0.0F),
        added_noise_(static_cast<float>(sensor.noise_sd_levels)),
        shot_({seed, slam::Stream::kShotNoise, sequence}),
        read_({seed, slam::Stream::kReadNoise, sequence}),
        added_({seed, slam::Stream::kImageNoise, sequence}) {
    for (int channel = 0; channel < 3; ++channel) {
      gain_bgr_[static_cast<std::size_t>(channel)] =
          static_cast<float>(sensor.gain * sensor.white_balance_rgb[2 - channel]);
    }
  }

  /// @param light in levels
  /// @return the level it becomes, before encoding
  float level(float light, std::size_t channel) {
    float electrons = light * exposure_ * electrons_per_level_;
    if (grains_) electrons = shot_noise(electrons, shot_.next(), normal_);
    if (read_noise_ > 0.0F) electrons += read_noise_ * normal_[read_.next()];
    const float clean = gain_bgr_[channel] * electrons / electrons_per_level_;
    return added_noise_ > 0.0F ? clean + added_noise_ * normal_[added_.next()] : clean;
  }

 private:
  bool grains_;
  float electrons_per_level_;
  float exposure_;
  float read_noise_;
  float added_noise_;
  std::array<float, 3> gain_bgr_{};
  BitStream shot_;
  BitStream read_;
  BitStream added_;
  const std::vector<float>& normal_ = float_quantiles();
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

/// One row of a picture in levels, whatever its light is told in.
void take_row(const cv::Mat& light, int y, float per_level, Row& row) {
  switch (light.depth()) {
    case CV_8U:
      std::copy_n(light.ptr(y), row.size(), row.begin());
      break;
    case CV_16U:
      std::copy_n(light.ptr<std::uint16_t>(y), row.size(), row.begin());
      break;
    default:
      std::copy_n(light.ptr<float>(y), row.size(), row.begin());
  }
  if (per_level == 1.0F) return;
  for (float& level : row) level /= per_level;
}

/// The stored byte of a level, by table.
class Encoder {
 public:
  explicit Encoder(const worlds::CameraSensor& sensor)
      : linear_(sensor.encoding == worlds::Encoding::kLinear) {
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      const double light = static_cast<double>(i) / (255.0 * kStepsPerLevel);
      codes_[i] = static_cast<std::uint8_t>(std::lround(255.0 * encode(std::min(light, 1.0), sensor)));
    }
  }

  std::uint8_t operator()(float level) const {
    const float clamped = std::clamp(level, 0.0F, kWhite);  // NaN cannot be: all that goes in is finite
    if (linear_) return static_cast<std::uint8_t>(clamped + 0.5F);
    return codes_[static_cast<std::size_t>(clamped * kStepsPerLevel + 0.5F)];
  }

 private:
  bool linear_;
  std::array<std::uint8_t, 255 * kStepsPerLevel + 1> codes_{};
};

}  // namespace

cv::Mat develop(const cv::Mat& light, const worlds::CameraSensor& sensor, std::uint64_t seed,
                std::uint64_t sequence) {
  const cv::Mat focused = sensor.defocus_sd_px == 0.0 ? light : blurred(light, sensor.defocus_sd_px);
  const float per_level = light.depth() == CV_16U ? float{kStepsOfALevel} : 1.0F;
  Chip chip(sensor, seed, sequence);
  const Encoder encoder(sensor);
  cv::Mat levels(light.size(), CV_8UC3);
  Row row(3 * static_cast<std::size_t>(light.cols));
  for (int y = 0; y < light.rows; ++y) {
    take_row(focused, y, per_level, row);
    if (sensor.vignette > 0.0) darken_corners(row, y, light.size(), sensor.vignette);
    std::uint8_t* stored = levels.ptr(y);
    for (std::size_t i = 0; i < row.size(); ++i) stored[i] = encoder(chip.level(row[i], i % 3));
  }
  return levels;
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
