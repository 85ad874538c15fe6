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

constexpr int kFractionBits = 7;                // shifts are fixed-point numbers, in 1/128 levels
constexpr double kLargestShift_levels = 255.0;  // clamps every pixel, as any larger shift would
constexpr double kLargestDefocus_px = 100.0;
constexpr std::size_t kLevelsAtOnce = 2048;
constexpr std::size_t kLanes = 8;  ///< levels that are shifted by one instruction

using Shifts = std::vector<std::int16_t>;

/// A shift s stands for (s + 1/2) / 128 levels: the halves keep the table antisymmetric and free of ties, so
/// that rounding has no favourite direction.
Shifts shifts_for(double sd_levels) {
  const std::vector<double>& quantiles = standard_normal_quantiles();
  Shifts shifts(kQuantiles);
  std::transform(quantiles.begin(), quantiles.end(), shifts.begin(), [&](double quantile) {
    const double levels = std::clamp(sd_levels * quantile, -kLargestShift_levels, kLargestShift_levels);
    return static_cast<std::int16_t>(std::floor(levels * (1 << kFractionBits)));
  });
  return shifts;
}

/// Adds shifts to eight levels, rounds and clamps; sums beyond 16 bits saturate, which clamps just as well.
void shift_levels(std::uint8_t* levels, const std::int16_t* shifts) {
  const cv::v_int16x8 fixed = cv::v_reinterpret_as_s16(cv::v_load_expand(levels) << kFractionBits);
  const cv::v_int16x8 half = cv::v_setall_s16(1 << (kFractionBits - 1));
  cv::v_pack_u_store(levels, (fixed + cv::v_load(shifts) + half) >> kFractionBits);
}

/// Shifts a run of levels. They are drawn, looked up and added one step after another, because the processor
/// cannot read eight numbers at once that it has just written one by one.
/// @param first how many levels of the picture come before them
void add_noise(std::span<std::uint8_t> levels, std::uint64_t first, const NoiseNumbers& noise,
               const Shifts& shifts) {
  std::array<std::uint16_t, kLevelsAtOnce> numbers;
  std::array<std::int16_t, kLevelsAtOnce> drawn{};
  noise.draw(first, std::span(numbers).first(levels.size()));
  for (std::size_t i = 0; i < levels.size(); ++i) drawn[i] = shifts[numbers[i]];
  std::size_t done = 0;
  for (; done + kLanes <= levels.size(); done += kLanes) shift_levels(&levels[done], &drawn[done]);
  std::array<std::uint8_t, kLanes> rest{};  // the last levels, filled up
  const std::span<std::uint8_t> last = levels.subspan(done);
  std::ranges::copy(last, rest.begin());
  if (!last.empty()) shift_levels(rest.data(), &drawn[done]);
  std::copy_n(rest.begin(), last.size(), last.begin());
}

cv::Mat noisy(const cv::Mat& picture, const Shifts& shifts, const NoiseNumbers& noise) {
  cv::Mat result = picture.clone();  // continuous, so that its bytes are one sequence
  const std::span<std::uint8_t> levels(result.ptr(), result.total() * result.elemSize());
  for (std::size_t first = 0; first < levels.size(); first += kLevelsAtOnce)
    add_noise(levels.subspan(first, std::min(kLevelsAtOnce, levels.size() - first)), first, noise, shifts);
  return result;
}

/// Whether nothing is asked of a camera but noise of one size: then all is done in whole numbers, in a
/// third of the time.
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
  const Shifts shifts = shifts_for(sensor.noise_sd_levels);
  const auto key = [&](std::uint64_t side) {
    return NoiseNumbers({seed, slam::Stream::kImageNoise, 2 * frame_index + side});
  };
  return {noisy(in_levels(left), shifts, key(0)), noisy(in_levels(right), shifts, key(1))};
}

}  // namespace stereobench::renderer
