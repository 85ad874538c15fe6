#include "harness/dataset/pictures/area_mean.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stereobench::harness {
namespace {

/// A mean of whole numbers, rounded; halves to the even number.
std::uint64_t rounded_mean(std::uint64_t sum, std::uint64_t count) {
  const std::uint64_t whole = sum / count, twice_rest = 2 * (sum % count);
  const bool is_up = twice_rest > count || (twice_rest == count && whole % 2 == 1);
  return is_up ? whole + 1 : whole;
}

template <class Level>
cv::Mat means_of(const cv::Mat& picture, int divide) {
  const int channels = picture.channels();
  cv::Mat small(picture.rows / divide, picture.cols / divide, picture.type());
  std::vector<std::uint64_t> sums(static_cast<std::size_t>(small.cols * channels));
  const auto count = static_cast<std::uint64_t>(divide) * static_cast<std::uint64_t>(divide);
  for (int row = 0; row < small.rows; ++row) {
    std::ranges::fill(sums, 0);
    for (int k = 0; k < divide; ++k) {
      const auto* levels = picture.ptr<Level>(row * divide + k);
      for (int column = 0; column < picture.cols; ++column)
        for (int channel = 0; channel < channels; ++channel)
          sums[static_cast<std::size_t>(column / divide * channels + channel)] += *levels++;
    }
    auto* means = small.ptr<Level>(row);
    for (const std::uint64_t sum : sums) *means++ = static_cast<Level>(rounded_mean(sum, count));
  }
  return small;
}

}  // namespace

cv::Mat area_mean(const cv::Mat& picture, int divide) {
  if (divide == 1) return picture;
  return picture.depth() == CV_8U ? means_of<std::uint8_t>(picture, divide)
                                  : means_of<std::uint16_t>(picture, divide);
}

}  // namespace stereobench::harness
