#include "vision/round_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Cholesky>
#include <opencv2/imgproc.hpp>

#include "slam/elementary.h"
#include "vision/blobs.h"
#include "vision/patch_boundary.h"

namespace stereobench::vision {
namespace {

constexpr double kMinPatch = 0.3;       // of the smallest circle's area
constexpr double kMinFill = 0.4;        // of the bounding box; a disc has 0.79
constexpr double kMaxElongation = 2.5;  // of the bounding box: half of a disc has 2
constexpr int kLooks = 5;               // each around the circle of the one before
constexpr double kFirstBand = 0.4;      // of the radius: how far to either side of it the first look goes
constexpr double kLastBand = 0.15;
constexpr double kLeastBand_px = 3.0;
constexpr double kEndOfBand = 0.35;  // of half the band: where a ray's two colours are sampled
constexpr double kStep_px = 0.5;     // along a ray
constexpr double kMinContrast_levels = 25.0;
constexpr double kLeastSpread_px = 0.15;  // of edges: no thing is known to be rounder
constexpr double kTukey = 4.685;          // 95 % efficiency for Gaussian errors
constexpr std::size_t kFewestEdges = 8;
constexpr double kMinArc = 0.2;
constexpr double kReach = 0.8;  // of the radius: what shows its colour so far out is not hidden
constexpr int kSteps = 12;

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
  return static_cast<double>(blob.area_px) >= kMinFill * width * height &&
         std::max(width, height) <= kMaxElongation * std::min(width, height);
}

/// The colour at a place between pixels; empty outside of the picture.
std::optional<Eigen::Vector3d> colour_at(const cv::Mat& image, const Eigen::Vector2d& at) {
  const int x = static_cast<int>(std::floor(at.x()));
  const int y = static_cast<int>(std::floor(at.y()));
  if (x < 0 || y < 0 || x + 1 >= image.cols || y + 1 >= image.rows) return std::nullopt;
  const double right = at.x() - x;
  const double down = at.y() - y;
  const auto pixel = [&](int row, int column) {
    const cv::Vec3b& bgr = image.at<cv::Vec3b>(row, column);
    return Eigen::Vector3d(bgr[0], bgr[1], bgr[2]);
  };
  return (1.0 - down) * ((1.0 - right) * pixel(y, x) + right * pixel(y, x + 1)) +
         down * ((1.0 - right) * pixel(y + 1, x) + right * pixel(y + 1, x + 1));
}

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& colours, std::size_t from, std::size_t to) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = from; i < to; ++i) sum += colours[i];
  return sum / static_cast<double>(to - from);
}

std::uint8_t class_of(const ColourTable& table, const Eigen::Vector3d& bgr) {
  return table.classify(cv::saturate_cast<std::uint8_t>(bgr[0]), cv::saturate_cast<std::uint8_t>(bgr[1]),
                        cv::saturate_cast<std::uint8_t>(bgr[2]));
}

/// How far along a ray's samples its first colour goes, in samples; empty unless the ray begins with the
/// patch's colour and ends with another.
std::optional<double> covered(const std::vector<Eigen::Vector3d>& samples, int colour,
                              const ColourTable& table) {
  const auto end = std::max<std::size_t>(
      2, static_cast<std::size_t>(0.5 * kEndOfBand * static_cast<double>(samples.size())));
  const Eigen::Vector3d first = mean_of(samples, 0, end);
  const Eigen::Vector3d last = mean_of(samples, samples.size() - end, samples.size());
  const Eigen::Vector3d contrast = first - last;
  if (class_of(table, first) != colour || class_of(table, last) == colour) return std::nullopt;
  if (!(contrast.norm() >= kMinContrast_levels)) return std::nullopt;
  double sum = 0.0;
  for (const Eigen::Vector3d& sample : samples)
    sum += std::clamp(contrast.dot(sample - last) / contrast.squaredNorm(), -0.25, 1.25);
  return sum;
}

/// Looks for the edge along rays, from `band_px` inside of a circle to as far outside.
Edges look(const cv::Mat& image, const Circle& circle, double band_px, int colour, const ColourTable& table) {
  Edges edges;
  const int rays = static_cast<int>(std::clamp(2.0 * std::numbers::pi * circle.radius_px, 24.0, 256.0));
  const auto count = static_cast<std::size_t>(2.0 * band_px / kStep_px);
  const double begin = circle.radius_px - 0.5 * kStep_px * static_cast<double>(count - 1);
  std::vector<Eigen::Vector3d> samples;
  for (int ray = 0; ray < rays; ++ray) {
    const auto [s, c] = slam::sine_cosine(2.0 * std::numbers::pi * ray / rays);
    const Eigen::Vector2d direction(c, s);
    samples.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const auto sample =
          colour_at(image, circle.centre_px + (begin + kStep_px * static_cast<double>(i)) * direction);
      if (sample) samples.push_back(*sample);
    }
    const bool is_inside = samples.size() == count;
    ++(is_inside ? edges.rays : edges.outside);
    const auto along = is_inside ? covered(samples, colour, table) : std::nullopt;
    if (along)
      edges.points.push_back({direction, circle.centre_px + (begin + kStep_px * (*along - 0.5)) * direction});
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
  for (int step = 0; step < kSteps; ++step) {
    std::vector<double> errors, sizes;
    for (const EdgePoint& point : points) {
      errors.push_back((point.at - fit.circle.centre_px).norm() - fit.circle.radius_px);
      sizes.push_back(std::abs(errors.back()));
    }
    fit.spread_px = std::max(kLeastSpread_px, 1.4826 * median_of(sizes));
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double relative = errors[i] / (kTukey * fit.spread_px);
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

/// How much of a circle's area within the picture does not show the patch's colour as far out as it should:
/// along each ray, what lies beyond the outermost place that does. Highlights are within.
double hidden_share(const cv::Mat& image, const Circle& circle, int colour, const ColourTable& table) {
  constexpr int kSpokes = 96;
  double hidden = 0.0;
  int rays = 0;
  for (int spoke = 0; spoke < kSpokes; ++spoke) {
    const auto [s, c] = slam::sine_cosine(2.0 * std::numbers::pi * spoke / kSpokes);
    const Eigen::Vector2d direction(c, s);
    if (!colour_at(image, circle.centre_px + circle.radius_px * direction)) continue;
    double reach = circle.radius_px;
    while (reach > 0.0) {
      const auto sample = colour_at(image, circle.centre_px + reach * direction);
      if (sample && class_of(table, *sample) == colour) break;
      reach -= kStep_px;
    }
    const double share = std::max(0.0, reach) / circle.radius_px;
    ++rays;
    if (share < kReach) hidden += 1.0 - share * share;
  }
  return rays == 0 ? 1.0 : hidden / rays;
}

/// The share of a circle's area that lies beyond the picture's border.
double outside_share(const cv::Mat& image, const Circle& circle) {
  constexpr int kRings = 24;
  constexpr int kSpokes = 48;
  int outside = 0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double radius = circle.radius_px * std::sqrt((ring + 0.5) / kRings);  // rings of equal area
    for (int spoke = 0; spoke < kSpokes; ++spoke) {
      const auto [s, c] = slam::sine_cosine(2.0 * std::numbers::pi * spoke / kSpokes);
      const Eigen::Vector2d at = circle.centre_px + radius * Eigen::Vector2d(c, s);
      const bool is_inside =
          at.x() >= -0.5 && at.y() >= -0.5 && at.x() <= image.cols - 0.5 && at.y() <= image.rows - 0.5;
      outside += is_inside ? 0 : 1;
    }
  }
  return static_cast<double>(outside) / (kRings * kSpokes);
}

std::optional<MeasuredOutline> measure(const cv::Mat& image, const Blob& blob, const ColourTable& table) {
  Circle circle = first_guess(image, blob, table);
  std::optional<CircleFit> fit;
  Edges edges;
  for (int i = 0; i < kLooks; ++i) {
    const double share = kFirstBand + (kLastBand - kFirstBand) * i / (kLooks - 1);
    const double band_px =
        std::min(std::max(share * circle.radius_px, kLeastBand_px), 0.9 * circle.radius_px);
    edges = look(image, circle, band_px, blob.colour, table);
    if (edges.points.size() < kFewestEdges) return std::nullopt;
    fit = fit_circle(edges.points, circle);
    if (!fit || fit->circle.radius_px > image.cols + image.rows) return std::nullopt;
    circle = fit->circle;
  }
  double seen = 0.0;
  for (const EdgePoint& point : edges.points) seen += point.weight > 0.0 ? 1.0 : 0.0;
  const double arc_share = seen / (edges.rays + edges.outside);
  if (arc_share < kMinArc) return std::nullopt;
  MeasuredOutline outline;
  outline.colour = blob.colour;
  outline.centre_px = circle.centre_px;
  outline.radius_px = circle.radius_px;
  outline.covariance_px2 = fit->covariance;
  outline.arc_share = arc_share;
  outline.outside_fraction = outside_share(image, circle);
  outline.hidden_fraction = hidden_share(image, circle, blob.colour, table);
  outline.seen_px = blob.area_px;
  return outline;
}

}  // namespace

std::vector<MeasuredOutline> find_round_patches(const cv::Mat& image, const ColourTable& table,
                                                double min_radius_px) {
  std::vector<MeasuredOutline> outlines;
  const double smallest = kMinPatch * std::numbers::pi * min_radius_px * min_radius_px;
  for (const Blob& blob : find_blobs(image, std::lround(smallest), table)) {
    const auto outline = may_be_round(blob) ? measure(image, blob, table) : std::nullopt;
    if (outline && outline->radius_px >= min_radius_px) outlines.push_back(*outline);
  }
  std::stable_sort(outlines.begin(), outlines.end(),
                   [](const auto& a, const auto& b) { return a.seen_px > b.seen_px; });
  return outlines;
}

}  // namespace stereobench::vision
