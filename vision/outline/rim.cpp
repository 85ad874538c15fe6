#include "vision/outline/rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <opencv2/core/hal/intrin.hpp>

#include "slam/math/angles.h"
#include "vision/tuning/rim.h"

namespace stereobench::vision {
namespace {

// Doubles: in single precision Eigen's roots begin with the processor's own estimate, which no two makes
// share.
using Four = Eigen::Array4d;
constexpr int kAtOnce = 4;

// Angles in turns, [0, 1], to 0.003 turns, of directions that are all above or all below: arithmetic only, so
// that every machine agrees on it. A direction's x on the diamond |x| + |y| = 1 falls as it turns, from 1 to
// -1 in half a turn, a little unevenly.
Four turns(const Four& x, double y) {
  constexpr double kUnevenness = 0.363;  // 1 - 2 / pi
  const Four on_diamond = x / (x.abs() + std::abs(y)).max(std::numeric_limits<double>::min());
  const Four size = on_diamond.abs();
  const Four quarters = 1.0 - on_diamond + kUnevenness * on_diamond * (1.0 - size) * (1.0 - 2.0 * size);
  return y < 0.0 ? Four(1.0 - 0.25 * quarters) : Four(0.25 * quarters);
}

// A pixel as (B, G, R, 1), its four bytes at once.
Colour colour_of(const std::uint8_t* bgr) {
  const std::uint32_t bytes = bgr[0] | std::uint32_t{bgr[1]} << 8U | std::uint32_t{bgr[2]} << 16U | 1U << 24U;
  const auto words = cv::v_expand_low(cv::v_expand_low(cv::v_reinterpret_as_u8(cv::v_setall_u32(bytes))));
  Colour colour;
  cv::v_store(colour.data(), cv::v_cvt_f32(cv::v_reinterpret_as_s32(words)));
  return colour;
}

// Looks at an image along an outline.
class RimCollector {
 public:
  RimCollector(const cv::Mat& image, const OutlineModel& outline, double gap_px,
               const std::optional<Shading>& shading, Detail detail)
      : image_(image),
        outline_(outline),
        shading_(shading),
        is_coarse_(detail == Detail::kCoarse && outline.radius_px() > kRim.coarse_from_px),
        gap_px_(gap_px),
        near_px_(std::max(gap_px, kRim.crossed_px + outline.blur_reach_px())),
        inner_reach_px_(gap_px + kRim.ring_width_px + outline.blur_reach_px()),
        outer_reach_px_(gap_px + (shading ? kRim.wide_ring_px : kRim.ring_width_px) +
                        outline.blur_reach_px()) {
    const double arc_length_px = is_coarse_ ? kRim.coarse_arc_length_px : kRim.arc_length_px;
    const double arcs =
        std::clamp(2.0 * slam::kPi * outline.radius_px() / arc_length_px, kRim.fewest_arcs, kRim.most_arcs);
    rim_.arcs.resize(static_cast<std::size_t>(arcs));
    rim_.has_shades = shading.has_value();
    rim_.pixels.reserve(
        static_cast<std::size_t>(4.0 * slam::kPi * near_px_ * (outline.semi_major_px() + near_px_)));
  }

  Rim collect() && {
    const double outermost = 1.0 + outer_reach_px_ / outline_.semi_minor_px();
    const double innermost = 1.0 - inner_reach_px_ / outline_.semi_minor_px();
    visit_ring(outline_, innermost, outermost, image_.size(), 1,
               [this](const ColumnSpan& columns, int y) { add(columns, y); });
    return std::move(rim_);
  }

 private:
  void add(ColumnSpan columns, int y) {
    const auto* row = image_.ptr<std::uint8_t>(y);
    const double below = y - outline_.centre_px().y();
    if (passes_over(y, below)) return;
    const auto sector_count = static_cast<double>(rim_.arcs.size());
    for (int x = columns.first; x <= columns.last; x += kAtOnce) {
      const Four beside = x - outline_.centre_px().x() + Four(0.0, 1.0, 2.0, 3.0);
      const Four distances = outline_.distances_px(beside, below);
      const Four sectors = (turns(beside, below) * sector_count).min(sector_count - 0.5);
      for (int i = 0; i < std::min(kAtOnce, columns.last + 1 - x); ++i) {
        if (!(distances[i] >= -inner_reach_px_ && distances[i] <= outer_reach_px_)) continue;
        const Colour colour = colour_of(row + 3 * (x + i));
        const auto sector = static_cast<std::size_t>(static_cast<int>(sectors[i]));  // int is quicker
        if (distances[i] >= gap_px_) rim_.arcs[sector].outside.add(colour, distances[i]);
        if (distances[i] < near_px_)
          add_near({Eigen::Vector2d(x + i, y), colour, Colour::UnitW(), distances[i], sector});
      }
    }
  }

  bool passes_over(int y, double below_px) const {
    return is_coarse_ && y % 2 == 1 && std::abs(below_px) < kRim.steep * outline_.radius_px();
  }

  void add_near(RimPixel&& pixel) {
    RimArc& arc = rim_.arcs[pixel.sector];
    if (shading_) pixel.shade.head<3>() = shade_of(pixel.position_px).cast<float>();
    if (pixel.distance_px < gap_px_) (pixel.distance_px <= -gap_px_ ? arc.inside : arc.crossed).add(pixel);
    if (pixel.distance_px > -near_px_) rim_.pixels.push_back(pixel);
  }

  // What the ball shows in a pixel, or as much of it as lies there.
  Eigen::Vector3d shade_of(const Eigen::Vector2d& pixel_px) const {
    if (outline_.blur_px() <= 0.0) return shading_->at(pixel_px);
    const RimPoint rim = outline_.rim_point(pixel_px);
    const auto [near, deep] = covered_depths_px(rim.distance_px, outline_.blur_px());
    return 0.5 * (shading_->at(pixel_px - near * rim.normal) + shading_->at(pixel_px - deep * rim.normal));
  }

  const cv::Mat& image_;
  const OutlineModel& outline_;
  const std::optional<Shading>& shading_;
  bool is_coarse_;
  double gap_px_;
  double near_px_;
  double inner_reach_px_;
  double outer_reach_px_;
  Rim rim_;
};

}  // namespace

Rim collect_rim(const cv::Mat& image, const OutlineModel& outline, double gap_px,
                const std::optional<Shading>& shading, Detail detail) {
  return RimCollector(image, outline, gap_px, shading, detail).collect();
}

}  // namespace stereobench::vision
