#include "vision/outline/round_patch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <Eigen/Cholesky>
#include <opencv2/imgproc.hpp>

#include "slam/math/angles.h"
#include "slam/math/elementary.h"
#include "vision/colour/blobs.h"
#include "vision/colour/circle_cover.h"
#include "vision/colour/patch_boundary.h"
#include "vision/tuning/round_patch.h"

namespace stereobench::vision {
namespace {

/// Where a ray from the centre leaves the patch.
struct EdgePoint {
  Eigen::Vector2d direction;
  Eigen::Vector2d at;
  double weight = 1.0;
};

/// What the rays of one look say.
struct Edges {
  std::vector<EdgePoint> points;
  int rays = 0;     ///< within the picture
  int outside = 0;  ///< others
};

bool may_be_round(const Blob& blob) {
  const double width = blob.max_x - blob.min_x + 1;
  const double height = blob.max_y - blob.min_y + 1;
  return static_cast<double>(blob.area_px) >= kRoundPatch.min_fill * width * height &&
         std::max(width, height) <= kRoundPatch.max_elongation * std::min(width, height);
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& colours, std::size_t from, std::size_t to) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = from; i < to; ++i) sum += colours[i];
  return sum / static_cast<double>(to - from);
}

/// How far along a ray's samples its first colour goes, in samples; empty unless the ray begins with the
/// patch's colour and ends with another.
std::optional<double> covered(const std::vector<Eigen::Vector3d>& samples, int colour,
                              const ColourTable& table) {
  const auto end = std::max<std::size_t>(
      2, static_cast<std::size_t>(0.5 * kRoundPatch.end_of_band * static_cast<double>(samples.size())));
  const Eigen::Vector3d first = mean_of(samples, 0, end);
  const Eigen::Vector3d last = mean_of(samples, samples.size() - end, samples.size());
  const Eigen::Vector3d contrast = first - last;
  if (class_of(table, first) != colour || class_of(table, last) == colour) return std::nullopt;
  if (!(contrast.norm() >= kRoundPatch.min_contrast_levels)) return std::nullopt;
  double sum = 0.0;
  for (const Eigen::Vector3d& sample : samples)
    sum += std::clamp(contrast.dot(sample - last) / contrast.squaredNorm(), -0.25, 1.25);
  return sum;
}

/// Looks for the edge along rays, from `band_px` inside of a circle to as far outside.
Edges look(const cv::Mat& image, const Circle& circle, double band_px, int colour, const ColourTable& table) {
  Edges edges;
  const int rays = static_cast<int>(std::clamp(2.0 * slam::kPi * circle.radius_px, 24.0, 256.0));
  const auto count = static_cast<std::size_t>(2.0 * band_px / kRoundPatch.step_px);
  const double begin = circle.radius_px - 0.5 * kRoundPatch.step_px * static_cast<double>(count - 1);
  std::vector<Eigen::Vector3d> samples;
  for (int ray = 0; ray < rays; ++ray) {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * ray / rays);
    const Eigen::Vector2d direction(c, s);
    samples.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const auto sample = colour_at(
          image, circle.centre_px + (begin + kRoundPatch.step_px * static_cast<double>(i)) * direction);
      if (sample) samples.push_back(*sample);
    }
    const bool is_inside = samples.size() == count;
    ++(is_inside ? edges.rays : edges.outside);
    const auto along = is_inside ? covered(samples, colour, table) : std::nullopt;
    if (along)
      edges.points.push_back(
          {direction, circle.centre_px + (begin + kRoundPatch.step_px * (*along - 0.5)) * direction});
  }
  return edges;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A circle through edge points, and what it is worth.
struct CircleFit {
  Circle circle;
  Eigen::Matrix3d covariance;  ///< of centre and radius
  double spread_px = 0.0;      ///< of edges about it
};

/// Gauss-Newton on distances from the circle, with Tukey's weights, whose scale is the median's.
std::optional<CircleFit> fit_circle(std::vector<EdgePoint>& points, Circle circle) {
  CircleFit fit{circle, Eigen::Matrix3d::Zero(), 0.0};
  for (int step = 0; step < kRoundPatch.steps; ++step) {
    std::vector<double> errors, sizes;
    for (const EdgePoint& point : points) {
      errors.push_back((point.at - fit.circle.centre_px).norm() - fit.circle.radius_px);
      sizes.push_back(std::abs(errors.back()));
    }
    fit.spread_px = std::max(kRoundPatch.least_spread_px, 1.4826 * median_of(sizes));
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double relative = errors[i] / (kRoundPatch.tukey * fit.spread_px);
      points[i].weight =
          std::abs(relative) < 1.0 ? (1.0 - relative * relative) * (1.0 - relative * relative) : 0.0;
      const Eigen::Vector2d outwards = (points[i].at - fit.circle.centre_px).normalized();
      const Eigen::Vector3d slope(outwards.x(), outwards.y(), 1.0);
      information += points[i].weight * slope * slope.transpose();
      sum += points[i].weight * errors[i] * slope;
    }
    const Eigen::LLT<Eigen::Matrix3d> solver(information);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-4)) return std::nullopt;
    const Eigen::Vector3d change = solver.solve(sum);
    fit.circle.centre_px += change.head<2>();
    fit.circle.radius_px += change.z();
    fit.covariance = fit.spread_px * fit.spread_px * solver.solve(Eigen::Matrix3d::Identity());
    if (!fit.covariance.allFinite() || !(fit.circle.radius_px > 0.0)) return std::nullopt;
  }
  return fit;
}

/// The circle through a patch's boundary; that of its box where it makes none.
Circle first_guess(const cv::Mat& image, const Blob& blob, const ColourTable& table) {
  const double width = blob.max_x - blob.min_x + 1;
  const double height = blob.max_y - blob.min_y + 1;
  const Circle box = {{0.5 * (blob.min_x + blob.max_x), 0.5 * (blob.min_y + blob.max_y)},
                      0.5 * std::max(width, height)};
  std::vector<EdgePoint> points;
  for (const Eigen::Vector2d& at : patch_boundary(image, blob, table))
    points.push_back({Eigen::Vector2d::Zero(), at});
  const auto fit = points.size() >= 6 ? fit_circle(points, box) : std::nullopt;
  const bool is_near = fit && fit->circle.radius_px < 2.0 * box.radius_px &&
                       fit->circle.radius_px > 0.5 * box.radius_px &&
                       (fit->circle.centre_px - box.centre_px).norm() < 2.0 * box.radius_px;
  return is_near ? fit->circle : box;
}

/// Whether along a ray the patch goes on across a circle: a place beyond has its colour still, and is more
/// like what is inside than like what is farther out.
bool goes_on(const cv::Mat& image, const Circle& circle, const Eigen::Vector2d& direction, int colour,
             const ColourTable& table) {
  const double beyond_px = std::max(kRoundPatch.beyond_px, kRoundPatch.beyond * circle.radius_px);
  const auto at = [&](double from_circle_px) {
    return colour_at(image, circle.centre_px + (circle.radius_px + from_circle_px) * direction);
  };
  const auto inside = at(-2.0 * beyond_px), beyond = at(beyond_px), outside = at(3.0 * beyond_px);
  return inside && beyond && outside && class_of(table, *inside) == colour &&
         class_of(table, *beyond) == colour && (*beyond - *inside).norm() <= (*beyond - *outside).norm();
}

/// Of rays, along how many the patch's colour goes on across a circle: what hides a thing takes of its patch,
/// and adds nothing.
double share_beyond(const cv::Mat& image, const Circle& circle, int colour, const ColourTable& table) {
  constexpr int kRays = 72;
  int beyond = 0;
  for (int ray = 0; ray < kRays; ++ray) {
    const auto [s, c] = slam::sine_cosine(2.0 * slam::kPi * ray / kRays);
    beyond += goes_on(image, circle, Eigen::Vector2d(c, s), colour, table) ? 1 : 0;
  }
  return static_cast<double>(beyond) / kRays;
}

std::optional<MeasuredOutline> measure(const cv::Mat& image, const Blob& blob, const ColourTable& table) {
  Circle circle = first_guess(image, blob, table);
  std::optional<CircleFit> fit;
  Edges edges;
  for (int i = 0; i < kRoundPatch.looks; ++i) {
    const double share = kRoundPatch.first_band +
                         (kRoundPatch.last_band - kRoundPatch.first_band) * i / (kRoundPatch.looks - 1);
    const double band_px =
        std::min(std::max(share * circle.radius_px, kRoundPatch.least_band_px), 0.9 * circle.radius_px);
    edges = look(image, circle, band_px, blob.colour, table);
    if (edges.points.size() < kRoundPatch.fewest_edges) return std::nullopt;
    fit = fit_circle(edges.points, circle);
    if (!fit || fit->circle.radius_px > image.cols + image.rows) return std::nullopt;
    circle = fit->circle;
  }
  double seen = 0.0;
  for (const EdgePoint& point : edges.points) seen += point.weight > 0.0 ? 1.0 : 0.0;
  const double inlier_ratio = seen / (edges.rays + edges.outside);
  const double rough = fit->spread_px / (kRoundPatch.rough_px + kRoundPatch.rough * circle.radius_px);
  if (inlier_ratio < kRoundPatch.min_arc || rough > kRoundPatch.roughest ||
      share_beyond(image, circle, blob.colour, table) > kRoundPatch.most_beyond)
    return std::nullopt;
  MeasuredOutline outline;
  outline.colour = blob.colour;
  outline.centre_px = circle.centre_px;
  outline.radius_px = circle.radius_px;
  outline.covariance_px2 = fit->covariance;
  outline.inlier_ratio = inlier_ratio;
  outline.outside_fraction = outside_share(image, circle);
  outline.hidden_fraction = std::max({hidden_share(image, circle, blob.colour, table),
                                      kRoundPatch.known_arc - inlier_ratio, std::min(rough - 1.0, 1.0)});
  outline.seen_px = blob.area_px;
  return outline;
}

/// A patch and the pieces beside it of the same colour, which seams and prints have cut off; the box of all.
Blob with_pieces(const Blob& patch, const ScratchVector<Blob>& blobs) {
  Blob all = patch;
  const int gap = static_cast<int>(
      std::ceil(kRoundPatch.gap * std::max(patch.max_x - patch.min_x + 1, patch.max_y - patch.min_y + 1)));
  for (const Blob& other : blobs) {
    const bool is_beside = other.colour == patch.colour && other.min_x <= patch.max_x + gap &&
                           other.max_x >= patch.min_x - gap && other.min_y <= patch.max_y + gap &&
                           other.max_y >= patch.min_y - gap;
    if (!is_beside || &other == &patch ||
        static_cast<double>(other.area_px) < kRoundPatch.least_piece * static_cast<double>(patch.area_px))
      continue;
    all.area_px += other.area_px;
    all.min_x = std::min(all.min_x, other.min_x);
    all.max_x = std::max(all.max_x, other.max_x);
    all.min_y = std::min(all.min_y, other.min_y);
    all.max_y = std::max(all.max_y, other.max_y);
  }
  return all;
}

/// Of two outlines around one patch, the one that more of its arc speaks for, in px.
bool is_better(const MeasuredOutline& a, const MeasuredOutline& b) {
  return a.inlier_ratio * a.radius_px > b.inlier_ratio * b.radius_px;
}

/// Whether a patch may be the inside of an outline: about it, and no larger.
bool holds(const MeasuredOutline& outline, const Blob& patch) {
  const Eigen::Vector2d middle(0.5 * (patch.min_x + patch.max_x), 0.5 * (patch.min_y + patch.max_y));
  const double area_px = slam::kPi * outline.radius_px * outline.radius_px;
  return (outline.centre_px - middle).norm() < outline.radius_px &&
         static_cast<double>(patch.area_px) <= kRoundPatch.largest_patch * area_px;
}

/// The better outline of a patch, alone and with its pieces.
std::optional<MeasuredOutline> best_outline(const cv::Mat& image, const Blob& alone, const Blob& with_pieces,
                                            const ColourTable& table, double min_radius_px) {
  std::optional<MeasuredOutline> best;
  for (const Blob& blob : {alone, with_pieces}) {
    const auto outline = may_be_round(blob) ? measure(image, blob, table) : std::nullopt;
    if (outline && outline->radius_px >= min_radius_px && holds(*outline, alone) &&
        (!best || is_better(*outline, *best)))
      best = outline;
    if (with_pieces.area_px == alone.area_px) break;
  }
  return best;
}

/// Pieces of a thing that was found whole are within it.
bool is_within(const MeasuredOutline& piece, const MeasuredOutline& whole) {
  return piece.colour == whole.colour && piece.radius_px < whole.radius_px &&
         (piece.centre_px - whole.centre_px).norm() + 0.5 * piece.radius_px < whole.radius_px;
}

}  // namespace

std::vector<MeasuredOutline> find_round_patches(const cv::Mat& image, const ColourTable& table,
                                                double min_radius_px) {
  std::vector<MeasuredOutline> outlines;
  const double smallest = kRoundPatch.min_patch * slam::kPi * min_radius_px * min_radius_px;
  ScratchVector<Blob> blobs = find_blobs(image, std::lround(kRoundPatch.least_piece * smallest) + 1, table);
  std::ranges::stable_sort(blobs, std::greater{}, &Blob::area_px);
  const std::size_t most = std::min(blobs.size(), kRoundPatch.most_patches);
  for (std::size_t i = 0; i < most && static_cast<double>(blobs[i].area_px) >= smallest; ++i) {
    const auto best = best_outline(image, blobs[i], with_pieces(blobs[i], blobs), table, min_radius_px);
    if (best) outlines.push_back(*best);
  }
  std::vector<MeasuredOutline> whole;
  for (const MeasuredOutline& outline : outlines) {
    const auto holds = [&](const MeasuredOutline& other) { return is_within(outline, other); };
    if (std::ranges::none_of(outlines, holds)) whole.push_back(outline);
  }
  std::ranges::stable_sort(whole, std::greater{}, &MeasuredOutline::seen_px);
  return whole;
}

}  // namespace stereobench::vision
