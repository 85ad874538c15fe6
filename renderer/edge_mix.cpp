#include <utility>

#include "renderer/edge_smoother.h"

namespace stereobench::renderer {
namespace {

using Change = std::pair<cv::Point, cv::Vec3f>;

/// Adds what a pair's pixels change by.
void add_changes(const EdgeMix& mix, const BallVeil& veil, const cv::Mat& colour,
                 std::vector<Change>& changes) {
  const auto level = [&](const cv::Point& pixel) { return cv::Vec3f(colour.at<cv::Vec3b>(pixel)); };
  const float lower = veil.light_left(mix.lower, mix.inverse_depth);
  const float higher = veil.light_left(mix.higher, mix.inverse_depth);
  const bool is_clear = lower == 1.0F && higher == 1.0F;
  const cv::Vec3f step = is_clear ? level(mix.higher) - level(mix.lower) : mix.step;
  changes.emplace_back(mix.lower, step * (lower * mix.higher_in_lower));
  changes.emplace_back(mix.higher, step * (-higher * mix.lower_in_higher));
}

}  // namespace

void mix_edges(const std::vector<EdgeMix>& mixes, const BallVeil& veil, EyeFrame& frame) {
  std::vector<Change> changes;
  changes.reserve(2 * mixes.size());
  for (const bool is_upright : {false, true}) {  // at a corner the shares of two edges multiply
    changes.clear();
    for (const EdgeMix& mix : mixes)
      if ((mix.lower.x == mix.higher.x) == is_upright) add_changes(mix, veil, frame.colour, changes);
    for (const auto& [pixel, by] : changes) {
      auto& colour = frame.colour.at<cv::Vec3b>(pixel);
      for (int i = 0; i < 3; ++i)
        colour[i] = cv::saturate_cast<std::uint8_t>(static_cast<float>(colour[i]) + by[i]);
    }
  }
}

}  // namespace stereobench::renderer
