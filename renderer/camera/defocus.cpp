#include "renderer/camera/defocus.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <opencv2/core/hal/intrin.hpp>

namespace stereobench::renderer {
namespace {

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

/// Where values begin, and those that lie as far before and after each of them, the nearest ones first.
struct Neighbours {
  const float* centre;
  std::vector<const float*> before, after;
};

/// Values and their neighbours, weighed and summed, the nearest ones first: eight at a time, whose sums stay
/// in registers, then the rest.
/// @param weights of the centre, then of the neighbours
void weigh(const std::vector<float>& weights, const Neighbours& values, Row& sums) {
  const std::size_t reach = weights.size() - 1;
  std::size_t at = 0;
  for (; at + 8 <= sums.size(); at += 8) {
    const auto load = [at](const float* from) {
      return std::pair(cv::v_load(from + at), cv::v_load(from + at + 4));
    };
    const auto [low, high] = load(values.centre);
    cv::v_float32x4 first = cv::v_setall_f32(weights[0]) * low, second = cv::v_setall_f32(weights[0]) * high;
    for (std::size_t k = 0; k < reach; ++k) {
      const auto [low_before, high_before] = load(values.before[k]);
      const auto [low_after, high_after] = load(values.after[k]);
      const cv::v_float32x4 weight = cv::v_setall_f32(weights[k + 1]);
      first += weight * (low_before + low_after);
      second += weight * (high_before + high_after);
    }
    cv::v_store(&sums[at], first);
    cv::v_store(&sums[at + 4], second);
  }
  for (; at < sums.size(); ++at) {
    sums[at] = weights[0] * values.centre[at];
    for (std::size_t k = 0; k < reach; ++k)
      sums[at] += weights[k + 1] * (values.before[k][at] + values.after[k][at]);
  }
}

}  // namespace

void take_row(const cv::Mat& light, int y, float* row) {
  const int size = 3 * light.cols;
  if (light.depth() == CV_8U)
    std::copy_n(light.ptr(y), size, row);
  else
    std::copy_n(light.ptr<std::uint16_t>(y), size, row);
}

Defocus::Defocus(const cv::Mat& light, double sd_px)
    : light_(light),
      weights_(half_gaussian(sd_px)),
      reach_(weights_.size() - 1),
      size_(3 * static_cast<std::size_t>(light.cols)),
      wide_(size_ + 6 * reach_),
      across_(2 * reach_ + 1, Row(size_)) {}

void Defocus::take(int y, Row& row) {
  const int reach = static_cast<int>(reach_);
  for (; blurred_ < std::min(y + reach + 1, light_.rows); ++blurred_) blur_across(blurred_);
  const auto row_at = [&](int at) { return across(std::clamp(at, 0, light_.rows - 1)).data(); };
  Neighbours rows{row_at(y), {}, {}};
  for (int k = 1; k <= reach; ++k) {
    rows.before.push_back(row_at(y - k));
    rows.after.push_back(row_at(y + k));
  }
  weigh(weights_, rows, row);
}

void Defocus::blur_across(int y) {
  float* const centre = wide_.data() + 3 * reach_;
  take_row(light_, y, centre);
  for (std::size_t i = 0; i < 3 * reach_; ++i) {
    wide_[i] = centre[i % 3];
    centre[size_ + i] = centre[size_ - 3 + i % 3];
  }
  Neighbours columns{centre, {}, {}};
  for (std::size_t k = 1; k <= reach_; ++k) {
    columns.before.push_back(centre - 3 * k);
    columns.after.push_back(centre + 3 * k);
  }
  weigh(weights_, columns, across(y));
}

}  // namespace stereobench::renderer
