#include "vision/outline_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "vision/arc_fit.h"
#include "vision/palette.h"
#include "vision/rim.h"

namespace stereobench::vision {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFinestRamp_px = 1.5;
constexpr double kGap_px = 0.9;  // between a sharp edge and the colours beside it
constexpr double kReachBeyondRamp_px = 2.8;
constexpr int kSharpSteps = 4;
constexpr double kConverged_px = 1e-3;
constexpr double kMinFill = 0.25;  // of the bounding box; a disc has 0.79
constexpr double kMaxElongation = 3.0;
constexpr double kMaxRadius_px = 2000.0;

Eigen::Vector3d palette_bgr(int colour) {
  const PaletteColour& c = kPalette[static_cast<std::size_t>(colour)];
  return {static_cast<double>(c.b), static_cast<double>(c.g), static_cast<double>(c.r)};
}

struct Fit {
  OutlineModel outline;
  Rim rim;
  std::vector<ArcColours> colours;
  std::vector<ArcOffset> arcs;
  Eigen::Matrix3d covariance_px2 = Eigen::Matrix3d::Zero();
};

bool may_be_ball(const Blob& blob) {
  const double width = blob.max_x - blob.min_x + 1;
  const double height = blob.max_y - blob.min_y + 1;
  return static_cast<double>(blob.area_px) >= kMinFill * width * height &&
         std::max(width, height) <= kMaxElongation * std::min(width, height);
}

// Patches lack their rims and, in noise, some of their pixels: the box remembers the size, the moments the
// centre.
OutlineModel first_guess(const Blob& blob, const Intrinsics& camera) {
  const double area = static_cast<double>(blob.area_px);
  const Eigen::Vector2d moments(blob.sum_x / area, blob.sum_y / area);
  const Eigen::Vector2d box(0.5 * (blob.min_x + blob.max_x), 0.5 * (blob.min_y + blob.max_y));
  const double box_radius = 0.25 * (blob.max_x - blob.min_x + blob.max_y - blob.min_y + 2);
  return {camera, 0.5 * (moments + box), std::max(std::sqrt(area / kPi), box_radius)};
}

double gap_for(double ramp_px) {
  return ramp_px > 0.0 ? std::max(kGap_px, ramp_px) : kGap_px;
}

// One step of the fit; the change's size, or empty when the arcs no longer make an outline.
std::optional<double> improve(Fit& fit, int colour, const FitSettings& settings, double ramp_px) {
  const UnmixSettings unmix{palette_bgr(colour), settings.noise_sd_levels, gap_for(ramp_px)};
  fit.colours = arc_colours(fit.rim, fit.outline, unmix);
  fit.arcs = arc_offsets(fit.rim, fit.colours, fit.outline, ramp_px);
  const auto step = solve_arcs(fit.arcs, ramp_px > 0.0 ? 0.5 * ramp_px : 0.05);
  if (!step) return std::nullopt;
  const double limit = std::max(ramp_px, 0.5);
  const Eigen::Vector3d change = step->change_px.cwiseMax(-limit).cwiseMin(limit);
  const double radius = fit.outline.radius_px() + change.z();
  if (!(radius >= 0.5 * settings.min_radius_px) || radius > kMaxRadius_px) return std::nullopt;
  fit.outline = OutlineModel(settings.camera, fit.outline.centre_px() + change.head<2>(), radius);
  fit.covariance_px2 = step->covariance_px2;
  return change.cwiseAbs().maxCoeff();
}

std::optional<Fit> converge(const cv::Mat& image, const Blob& blob, const FitSettings& settings) {
  Fit fit{first_guess(blob, settings.camera), {}, {}, {}};
  double ramp = std::max(kFinestRamp_px, 0.08 * fit.outline.radius_px());
  for (; ramp >= kFinestRamp_px; ramp *= 0.5) {
    fit.rim = collect_rim(image, fit.outline, ramp + kReachBeyondRamp_px);
    for (int i = 0; i < 2; ++i) {
      if (!improve(fit, blob.colour, settings, ramp)) return std::nullopt;
    }
  }
  fit.rim = collect_rim(image, fit.outline, kGap_px + kReachBeyondRamp_px);
  for (int i = 0; i < kSharpSteps; ++i) {
    const auto change = improve(fit, blob.colour, settings, 0.0);
    if (!change) return std::nullopt;
    if (*change < kConverged_px) break;
  }
  return fit;
}

// How much of a rim pixel something else covers, of the part that the ball should.
double hidden_part(const Fit& fit, const RimPixel& pixel, double covered, const UnmixSettings& unmix) {
  const ArcColours& colours = fit.colours[pixel.sector];
  if (!colours.usable) return is_shade_of(pixel.bgr, unmix.ball_bgr, unmix.noise_sd_levels) ? 0.0 : covered;
  if (fit.arcs[pixel.sector].weight > 0.0) return 0.0;
  const double alpha = colours.unmix.dot(pixel.bgr - colours.background);
  return std::clamp(covered - alpha, 0.0, covered);
}

// Sums over the outline's pixels; the rim's were collected, the inside is looked at here.
void measure_visibility(const cv::Mat& image, const Fit& fit, const UnmixSettings& unmix,
                        MeasuredOutline& result) {
  double total = 0.0;
  double outside = 0.0;
  double hidden = 0.0;
  const double rim_width = 1.2;
  for (const RimPixel& pixel : fit.rim.pixels) {
    const RimPoint point = fit.outline.rim_point(pixel.position_px);
    if (std::abs(point.distance_px) > rim_width) continue;
    const double covered = edge_coverage(point).fraction;
    if (covered > 0.0) hidden += hidden_part(fit, pixel, covered, unmix);
  }
  const Eigen::Vector2d centre = fit.outline.centre_px();
  const double extent = fit.outline.semi_major_px() + 1.0;
  const int last_y = static_cast<int>(std::floor(centre.y() + extent));
  const int last_x = static_cast<int>(std::floor(centre.x() + extent));
  for (int y = static_cast<int>(std::ceil(centre.y() - extent)); y <= last_y; ++y) {
    for (int x = static_cast<int>(std::ceil(centre.x() - extent)); x <= last_x; ++x) {
      const RimPoint point = fit.outline.rim_point(Eigen::Vector2d(x, y));
      const double covered = edge_coverage(point).fraction;
      total += covered;
      if (x < 0 || y < 0 || x >= image.cols || y >= image.rows) {
        outside += covered;
      } else if (point.distance_px < -rim_width) {
        const std::uint8_t* bgr = image.ptr<std::uint8_t>(y) + 3 * x;
        hidden += is_shade_of(Eigen::Vector3d(bgr[0], bgr[1], bgr[2]), unmix.ball_bgr, unmix.noise_sd_levels)
                      ? 0.0
                      : 1.0;
      }
    }
  }
  result.hidden_fraction = hidden / total;
  result.outside_fraction = outside / total;
}

}  // namespace

std::optional<MeasuredOutline> fit_outline(const cv::Mat& image, const Blob& blob,
                                           const FitSettings& settings) {
  if (!may_be_ball(blob)) return std::nullopt;
  const std::optional<Fit> fit = converge(image, blob, settings);
  if (!fit || fit->outline.radius_px() < settings.min_radius_px) return std::nullopt;
  MeasuredOutline result;
  result.colour = blob.colour;
  result.centre_px = fit->outline.centre_px();
  result.covariance_px2 = fit->covariance_px2.topLeftCorner<2, 2>();
  result.radius_px = fit->outline.radius_px();
  result.radius_sd_px = std::sqrt(fit->covariance_px2(2, 2));
  result.seen_px = blob.area_px;
  measure_visibility(image, *fit, {palette_bgr(blob.colour), settings.noise_sd_levels, kGap_px}, result);
  return result;
}

}  // namespace stereobench::vision
