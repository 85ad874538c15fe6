#include <utility>

#include "renderer/surfaces/edge_smoother.h"

namespace stereobench::renderer {
namespace {

using Change = std::pair<cv::Point, cv::Vec3f>;

/// Adds what a pair's pixels change by.
template <class Pixel>
void add_changes(const EdgeMix& mix, const BallVeil& veil, const cv::Mat& colour,
                 std::vector<Change>& changes) {
  const auto level = [&](const cv::Point& pixel) { return cv::Vec3f(colour.at<Pixel>(pixel)); };
  const float lower = veil.light_left(mix.lower, mix.inverse_depth);
  const float higher = veil.light_left(mix.higher, mix.inverse_depth);
  const bool is_clear = lower == 1.0F && higher == 1.0F;
  const cv::Vec3f step = is_clear ? level(mix.higher) - level(mix.lower) : mix.step;
  changes.emplace_back(mix.lower, step * (lower * mix.higher_in_lower));
  changes.emplace_back(mix.higher, step * (-higher * mix.lower_in_higher));
}

template <class Pixel>
void mix_pixels(const std::vector<EdgeMix>& mixes, const BallVeil& veil, cv::Mat& picture) {
  std::vector<Change> changes;
  changes.reserve(2 * mixes.size());
  for (const bool is_upright : {false, true}) {  // at a corner the shares of two edges multiply
    changes.clear();
    for (const EdgeMix& mix : mixes)
      if ((mix.lower.x == mix.higher.x) == is_upright) add_changes<Pixel>(mix, veil, picture, changes);
    for (const auto& [pixel, by] : changes) {
      auto& colour = picture.at<Pixel>(pixel);
      for (int i = 0; i < 3; ++i)
        colour[i] = cv::saturate_cast<typename Pixel::value_type>(static_cast<float>(colour[i]) + by[i]);
    }
  }
}

}  // namespace

void mix_edges(const std::vector<EdgeMix>& mixes, const BallVeil& veil, RenderedImage& frame) {
  if (frame.colour.depth() == CV_16U)
    mix_pixels<cv::Vec3w>(mixes, veil, frame.colour);
  else
    mix_pixels<cv::Vec3b>(mixes, veil, frame.colour);
}

}  // namespace stereobench::renderer
