#include "renderer/camera/expose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <opencv2/core/hal/intrin.hpp>

#include "renderer/camera/image_noise.h"
#include "renderer/camera/sensor_model.h"

namespace stereobench::renderer {
namespace {

constexpr double kLargestShift_levels = 255.0;  // clamps every pixel, as any larger shift would
constexpr double kLargestDefocus_px = 100.0;
constexpr std::size_t kLevelsAtOnce = 2048;
constexpr std::size_t kLanes = 16;  ///< levels that are shifted by one instruction

/// By how many levels each of the equally likely numbers shifts a pixel.
using Shifts = std::vector<std::int8_t>;

/// Rounded to whole levels, as pixels are. Levels are whole numbers: a shift that is added to one and rounded
/// then is the same. A byte holds up to 127 levels. Larger shifts are split over up to three tables, which
/// are added one after another.
std::vector<Shifts> shifts_for(double sd_levels) {
  constexpr int kMost = 127;
  const std::vector<double>& quantiles = standard_normal_quantiles();
  std::vector<Shifts> tables;
  bool is_all = false;
  for (int before = 0; !is_all; before += kMost) {
    Shifts& shifts = tables.emplace_back(kQuantiles);
    is_all = true;
    for (std::size_t i = 0; i < kQuantiles; ++i) {
      const double levels = std::clamp(sd_levels * quantiles[i], -kLargestShift_levels, kLargestShift_levels);
      const int whole = static_cast<int>(std::floor(levels + 0.5));
      const int rest = whole > 0 ? std::max(whole - before, 0) : std::min(whole + before, 0);
      shifts[i] = static_cast<std::int8_t>(std::clamp(rest, -kMost, kMost));
      is_all = is_all && std::abs(rest) <= kMost;
    }
  }
  return tables;
}

/// Adds shifts to sixteen levels and clamps: sums of signed bytes saturate where levels end.
void shift_levels(std::uint8_t* levels, const std::int8_t* shifts) {
  const cv::v_uint8x16 middle = cv::v_setall_u8(128);
  const cv::v_int8x16 from_middle = cv::v_reinterpret_as_s8(cv::v_load(levels) ^ middle);
  cv::v_store(levels, cv::v_reinterpret_as_u8(from_middle + cv::v_load(shifts)) ^ middle);
}

/// Shifts a run of levels. They are drawn, looked up and added one step after another, because the processor
/// cannot read sixteen numbers at once that it has just written one by one.
/// @param first how many levels of the picture come before them
void add_noise(std::span<std::uint8_t> levels, std::uint64_t first, const NoiseNumbers& noise,
               const std::vector<Shifts>& tables) {
  std::array<std::uint16_t, kLevelsAtOnce> numbers;
  std::array<std::int8_t, kLevelsAtOnce> drawn{};
  noise.draw(first, std::span(numbers).first(levels.size()));
  for (const Shifts& shifts : tables) {
    for (std::size_t i = 0; i < levels.size(); ++i) drawn[i] = shifts[numbers[i]];
    std::size_t done = 0;
    for (; done + kLanes <= levels.size(); done += kLanes) shift_levels(&levels[done], &drawn[done]);
    std::array<std::uint8_t, kLanes> rest{};  // the last levels, filled up
    const std::span<std::uint8_t> last = levels.subspan(done);
    std::ranges::copy(last, rest.begin());
    if (!last.empty()) shift_levels(rest.data(), &drawn[done]);
    std::copy_n(rest.begin(), last.size(), last.begin());
  }
}

cv::Mat noisy(const cv::Mat& picture, const std::vector<Shifts>& tables, const NoiseNumbers& noise) {
  cv::Mat result = picture.clone();  // continuous, so that its bytes are one sequence
  const std::span<std::uint8_t> levels(result.ptr(), result.total() * result.elemSize());
  for (std::size_t first = 0; first < levels.size(); first += kLevelsAtOnce)
    add_noise(levels.subspan(first, std::min(kLevelsAtOnce, levels.size() - first)), first, noise, tables);
  return result;
}

/// Whether nothing is asked of a camera but noise of one size: then all is done in whole numbers, in a
/// fraction of the time.
bool only_adds_noise(const worlds::CameraSensor& sensor) {
  worlds::CameraSensor plain;
  plain.noise_sd_levels = sensor.noise_sd_levels;
  plain.gamma = sensor.gamma;
  return sensor == plain;
}

void check(const cv::Mat& picture) {
  if (picture.type() != CV_8UC3 && picture.type() != CV_16UC3)
    throw std::invalid_argument("expose: pictures must have three channels of 8 or 16 bits");
}

bool within(double value, double least, double most) {
  return value >= least && value <= most;
}

void check(const worlds::CameraSensor& sensor) {
  const auto refuse = [](const char* what) { throw std::invalid_argument(std::string("expose: ") + what); };
  constexpr double kMost = 1e9;
  if (!within(sensor.noise_sd_levels, 0.0, kMost) || !within(sensor.read_noise_electrons, 0.0, kMost) ||
      !within(sensor.full_well_electrons, 0.0, kMost))
    refuse("noise must be finite and not negative");
  if (!within(sensor.defocus_sd_px, 0.0, kLargestDefocus_px)) refuse("defocus_sd_px must be in [0, 100]");
  if (!within(sensor.vignette, 0.0, 1.0)) refuse("vignette must be in [0, 1]");
  if (!within(sensor.exposure, 0.0, kMost) || !within(sensor.gain, 0.0, kMost) ||
      !within(sensor.white_balance_rgb.minCoeff(), 0.0, kMost) || !sensor.white_balance_rgb.allFinite())
    refuse("exposure and gains must be finite and not negative");
  if (!within(sensor.gamma, 0.1, 10.0)) refuse("gamma must be in [0.1, 10]");
}

}  // namespace

LightDepth light_for(const worlds::CameraSensor& sensor) {
  return only_adds_noise(sensor) ? LightDepth::kEightBits : LightDepth::kSixteenBits;
}

vision::StereoPair expose(const StereoFrame& frame, const worlds::CameraSensor& sensor, std::uint64_t seed,
                          std::uint64_t frame_index) {
  const cv::Mat& left = frame.left.colour;
  const cv::Mat& right = frame.right.colour;
  check(left);
  check(right);
  check(sensor);
  if (!only_adds_noise(sensor)) {
    return {develop(left, sensor, seed, 2 * frame_index), develop(right, sensor, seed, 2 * frame_index + 1)};
  }
  if (sensor.noise_sd_levels == 0.0) return {in_levels(left), in_levels(right)};
  const std::vector<Shifts> tables = shifts_for(sensor.noise_sd_levels);
  const auto key = [&](std::uint64_t side) {
    return NoiseNumbers({seed, slam::Stream::kImageNoise, 2 * frame_index + side});
  };
  return {noisy(in_levels(left), tables, key(0)), noisy(in_levels(right), tables, key(1))};
}

}  // namespace stereobench::renderer
