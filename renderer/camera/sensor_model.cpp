#include "renderer/camera/sensor_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
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

/// Adds weighted neighbours on both sides, the nearest ones first.
/// @param sum of `size` values @param before, after where the neighbours of the first value are
void add_neighbours(float* sum, const float* before, const float* after, float weight, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) sum[i] += weight * (before[i] + after[i]);
}

/// Copies a row of a picture, whatever its light is told in.
void take_row(const cv::Mat& light, int y, float* row) {
  const int size = 3 * light.cols;
  if (light.depth() == CV_8U)
    std::copy_n(light.ptr(y), size, row);
  else
    std::copy_n(light.ptr<std::uint16_t>(y), size, row);
}

/// The rows of a picture out of focus: blurred along rows, then along columns; beyond the border lies what is
/// at the border. OpenCV's blur of floats has other bits on other processors.
class Defocus {
 public:
  /// @param light outlives it
  Defocus(const cv::Mat& light, double sd_px)
      : light_(light),
        weights_(half_gaussian(sd_px)),
        reach_(weights_.size() - 1),
        size_(3 * static_cast<std::size_t>(light.cols)),
        wide_(size_ + 6 * reach_),
        across_(2 * reach_ + 1, Row(size_)) {}

  /// @param y each row in turn, from 0
  void take(int y, Row& row) {
    const int reach = static_cast<int>(reach_);
    for (; blurred_ < std::min(y + reach + 1, light_.rows); ++blurred_) blur_across(blurred_);
    const auto row_at = [&](int at) { return across(std::clamp(at, 0, light_.rows - 1)).data(); };
    std::transform(row_at(y), row_at(y) + size_, row.begin(),
                   [&](float light) { return weights_[0] * light; });
    for (int k = 1; k <= reach; ++k)
      add_neighbours(row.data(), row_at(y - k), row_at(y + k), weights_[static_cast<std::size_t>(k)], size_);
  }

 private:
  /// The rows around the one that is asked for are kept, blurred along themselves.
  Row& across(int y) { return across_[static_cast<std::size_t>(y) % across_.size()]; }

  void blur_across(int y) {
    float* const centre = wide_.data() + 3 * reach_;
    take_row(light_, y, centre);
    for (std::size_t i = 0; i < 3 * reach_; ++i) {
      wide_[i] = centre[i % 3];
      centre[size_ + i] = centre[size_ - 3 + i % 3];
    }
    Row& sum = across(y);
    for (std::size_t i = 0; i < size_; ++i) sum[i] = weights_[0] * centre[i];
    for (std::size_t k = 1; k <= reach_; ++k)
      add_neighbours(sum.data(), centre - 3 * k, centre + 3 * k, weights_[k], size_);
  }

  const cv::Mat& light_;
  std::vector<float> weights_;
  std::size_t reach_;
  std::size_t size_;  ///< of a row
  Row wide_;          ///< a row with its border
  std::vector<Row> across_;
  int blurred_ = 0;  ///< rows along themselves so far
};

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
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = row[i] < kFewElectrons ? poisson_by_inversion(row[i], bits_[i]) : normal_[i];
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
  develop_rows(light, sensor, seed, sequence,
               [&](const Row& row, int y) { std::ranges::transform(row, levels.ptr(y), encoder); });
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
