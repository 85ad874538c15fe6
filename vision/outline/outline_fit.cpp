#include "vision/outline/outline_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "slam/math/angles.h"
#include "vision/outline/arc_colours.h"
#include "vision/outline/arc_fit.h"
#include "vision/outline/boundary_guess.h"
#include "vision/outline/rim.h"
#include "vision/outline/shading.h"
#include "vision/palette.h"
#include "vision/pixel_noise.h"
#include "vision/tuning/outline_fit.h"

namespace stereobench::vision {
namespace {

struct Fit {
  OutlineModel outline;
  bool is_resampled = false;
  Rim rim;
  ScratchVector<ArcColours> colours;
  ScratchVector<UnmixedPixel> pixels;
  ScratchVector<ArcOffset> arcs;  // as the outline was when they were compared, moved along with it
  double moved_px = 0.0;          // since they were
  Eigen::Matrix3d covariance_px2 = Eigen::Matrix3d::Zero();
  double reduced_chi_square = 1.0;
  double inlier_ratio = 0.0;
  BallLight light;
};

bool may_be_ball(const Blob& blob) {
  const double width = blob.max_x - blob.min_x + 1;
  const double height = blob.max_y - blob.min_y + 1;
  return static_cast<double>(blob.area_px) >= kOutlineFit.min_fill * width * height &&
         std::max(width, height) <= kOutlineFit.max_elongation * std::min(width, height);
}

// Patches lack their rims and, in noise, some of their pixels: the box remembers the size, the moments the
// centre.
OutlineModel first_guess(const Blob& blob, const FitSettings& settings) {
  const double area = static_cast<double>(blob.area_px);
  const Eigen::Vector2d moments(blob.sum_x / area, blob.sum_y / area);
  const Eigen::Vector2d box(0.5 * (blob.min_x + blob.max_x), 0.5 * (blob.min_y + blob.max_y));
  const double box_radius = 0.25 * (blob.max_x - blob.min_x + blob.max_y - blob.min_y + 2);
  return {settings.camera, 0.5 * (moments + box),
          std::max(std::sqrt(area / slam::kPi), box_radius) + kOutlineFit.lost_rim_px, settings.blur_px};
}

double distance_px(const OutlineModel& a, const OutlineModel& b) {
  return (a.centre_px() - b.centre_px()).norm() + std::abs(a.radius_px() - b.radius_px());
}

// Compares what is seen with the outline as it is.
void compare(Fit& fit, double ramp_px) {
  fit.arcs = arc_offsets(fit.pixels, fit.colours, fit.outline, ramp_px, fit.is_resampled);
  fit.moved_px = 0.0;
}

// One step of the fit; the change's size, or empty when the arcs no longer make an outline. Arcs may be at
// odds by half of what the outline may still be off, since then all are.
std::optional<double> improve(Fit& fit, const FitSettings& settings, double ramp_px, double off_px) {
  if (fit.moved_px > kOutlineFit.straight_px) compare(fit, ramp_px);
  const auto step = solve_arcs(fit.arcs, kOutlineFit.tolerance_px + 0.5 * off_px);
  if (!step) return std::nullopt;
  const double limit = std::max(ramp_px, 0.5);
  const Eigen::Vector3d change = step->change_px.cwiseMax(-limit).cwiseMin(limit);
  const double radius = fit.outline.radius_px() + change.z();
  if (!(radius >= 0.5 * settings.min_radius_px) || radius > kOutlineFit.max_radius_px) return std::nullopt;
  fit.outline =
      OutlineModel(settings.camera, fit.outline.centre_px() + change.head<2>(), radius, settings.blur_px);
  fit.covariance_px2 = step->covariance_px2;
  fit.reduced_chi_square = step->reduced_chi_square;
  fit.inlier_ratio = step->share;
  move_outline(fit.arcs, change);
  fit.moved_px += change.cwiseAbs().maxCoeff();
  return change.cwiseAbs().maxCoeff();
}

// Looks again at the image, around where the outline is by now.
void look(Fit& fit, const cv::Mat& image, const UnmixSettings& settings, double ramp_px,
          const std::optional<Shading>& shading = std::nullopt, Detail detail = Detail::kAll) {
  fit.rim = collect_rim(image, fit.outline, std::max(fit.outline.pure_px(), ramp_px), shading, detail);
  fit.colours = arc_colours(fit.rim, settings);
  fit.pixels = unmix(fit.rim, fit.colours);
  compare(fit, ramp_px);
}

// How much of an outline speaks for it, less what speaks against it, in radii along it.
double support(const Fit& fit) {
  double sum = 0.0;
  for (const ArcOffset& arc : fit.arcs) {
    if (arc.variance_px2 > 0.0) sum += 2.0 * arc.weight - 1.0;
  }
  return sum / static_cast<double>(fit.arcs.size()) * fit.outline.radius_px();
}

// Begins with a sharp edge where a whole ball's first guess is about right, as most are.
bool starts_sharp(Fit& fit, const cv::Mat& image, const FitSettings& settings, const UnmixSettings& unmix) {
  look(fit, image, unmix, 0.0, std::nullopt, Detail::kCoarse);
  const auto change = improve(fit, settings, 0.0, kOutlineFit.first_sharp_px);
  return change && *change < kOutlineFit.look_again_above_px &&
         support(fit) >= kOutlineFit.whole * fit.outline.radius_px();
}

// Begins with a wide ramp, which is narrowed as the outline comes nearer.
bool starts_with_ramp(Fit& fit, const cv::Mat& image, const FitSettings& settings,
                      const UnmixSettings& unmix) {
  for (double ramp = std::max(kOutlineFit.finest_ramp_px, kOutlineFit.first_ramp * fit.outline.radius_px());
       ramp >= kOutlineFit.finest_ramp_px;) {
    look(fit, image, unmix, ramp);
    const auto change = improve(fit, settings, ramp, ramp);
    if (!change) return false;
    if (*change < kOutlineFit.sharpen_below_px) break;
    ramp = std::min(*change * kOutlineFit.ramp_per_step, kOutlineFit.ramp_narrows * ramp);
  }
  look(fit, image, unmix, 0.0);
  return true;
}

// Looks at the rim by the shades that the ball must have there.
void look_by_shades(Fit& fit, const cv::Mat& image, const FitSettings& settings, const UnmixSettings& unmix,
                    const std::optional<SharedLightSource>& light_source) {
  const Shades shades(unmix.ball_bgr, settings.noise_sd_levels);
  const auto shading = fit_shading(image, settings.camera, fit.outline, shades,
                                   pixel_variance(settings.noise_sd_levels), light_source);
  if (shading) fit.light = shading->light();
  look(fit, image, unmix, 0.0, shading);
}

// Steps until the outline stands still.
bool settle(Fit& fit, const FitSettings& settings) {
  double off = 0.0;
  for (int i = 0;
       i < kOutlineFit.shaded_steps || (i < kOutlineFit.most_shaded_steps && off > kOutlineFit.converged_px);
       ++i) {
    const auto change = improve(fit, settings, 0.0, 0.0);
    if (!change) return false;
    off = *change;
  }
  return true;
}

// The last steps, by the shades that the ball must have at its rim; they are looked at again from where that
// leads.
bool suit_shades(Fit& fit, const cv::Mat& image, const FitSettings& settings, const UnmixSettings& unmix,
                 const std::optional<SharedLightSource>& light_source) {
  for (int i = 0; i < kOutlineFit.shaded_looks; ++i) {
    const OutlineModel before = fit.outline;
    look_by_shades(fit, image, settings, unmix, light_source);
    if (!settle(fit, settings)) return false;
    if (distance_px(before, fit.outline) < kOutlineFit.look_again_above_px) break;
  }
  return true;
}

std::optional<Fit> converge(const cv::Mat& image, const OutlineModel& start, const FitSettings& settings,
                            const UnmixSettings& unmix) {
  Fit fit{.outline = start, .is_resampled = settings.resampled};
  if (!starts_sharp(fit, image, settings, unmix)) {
    fit.outline = start;
    if (!starts_with_ramp(fit, image, settings, unmix)) return std::nullopt;
  }
  double off = kOutlineFit.first_sharp_px;
  for (int i = 0; i < kOutlineFit.sharp_steps && off > kOutlineFit.converged_px; ++i) {
    const auto change = improve(fit, settings, 0.0, off);
    if (!change) return std::nullopt;
    if (*change > kOutlineFit.look_again_above_px) look(fit, image, unmix, 0.0);
    off = *change;
  }
  // An outline that the ball's own shades do not suit was pulled aside, and is better looked for from
  // elsewhere.
  if (!suit_shades(fit, image, settings, unmix, std::nullopt)) return std::nullopt;
  return fit;
}

// Whether a patch lies within an outline, as far as its box tells: patches end before the rim does.
bool holds(const OutlineModel& outline, const Blob& blob) {
  const double reach = outline.semi_major_px() + kOutlineFit.roughness_px;
  const Eigen::Vector2d& centre = outline.centre_px();
  return blob.min_x - 0.5 >= centre.x() - reach && blob.max_x + 0.5 <= centre.x() + reach &&
         blob.min_y - 0.5 >= centre.y() - reach && blob.max_y + 0.5 <= centre.y() + reach;
}

// From the patch as a whole, and unless all around speaks for what comes of that, from its boundary.
std::optional<Fit> fit_patch(const cv::Mat& image, const Blob& blob, const FitSettings& settings,
                             const UnmixSettings& unmix) {
  std::optional<Fit> whole = converge(image, first_guess(blob, settings), settings, unmix);
  const bool held = whole && holds(whole->outline, blob);
  if (held && support(*whole) >= kOutlineFit.whole * whole->outline.radius_px()) return whole;
  const std::optional<Circle> circle = guess_from_boundary(image, blob);
  if (!circle) return whole;
  std::optional<Fit> part = converge(
      image, {settings.camera, circle->centre_px, circle->radius_px, settings.blur_px}, settings, unmix);
  if (!part || !whole) return part ? part : whole;
  const bool part_held = holds(part->outline, blob);
  const bool better = part_held != held ? part_held : support(*part) > support(*whole);
  return better ? part : whole;
}

// How much of a rim pixel something else covers, of the part that the ball should.
double hidden_part(const Fit& fit, const RimPixel& pixel, const Shades& shades) {
  const ArcColours& colours = fit.colours[pixel.sector];
  const double covered = fit.outline.coverage(fit.outline.rim_point(pixel.position_px)).fraction;
  if (covered <= 0.0) return 0.0;
  if (!colours.usable) return shades.contain(pixel.colour.head<3>().cast<double>()) ? 0.0 : covered;
  return std::clamp(covered - colours.shown(pixel) / colours.whole(pixel), 0.0, covered);
}

// Area of the outline, px, in which the image does not show the ball.
double hidden_area(const cv::Mat& image, const Fit& fit, const Shades& shades) {
  double hidden = 0.0;
  const double blur_reach = fit.outline.blur_reach_px();
  const double inside = 1.0 - (kOutlineFit.rim_depth_px + blur_reach) / fit.outline.semi_minor_px();
  for (const RimPixel& pixel : fit.rim.pixels) {
    if (fit.arcs[pixel.sector].weight > 0.0) continue;
    if (pixel.distance_px < 1.0 + blur_reach && fit.outline.level(pixel.position_px) > inside)
      hidden += hidden_part(fit, pixel, shades);
  }
  visit_ring(fit.outline, 0.0, inside, image.size(), 1, [&](const ColumnSpan& columns, int y) {
    const auto* row = image.ptr<std::uint8_t>(y);
    for (int x = columns.first; x <= columns.last; ++x) {
      const std::uint8_t* bgr = row + 3 * x;
      if (!shades.contain(Eigen::Vector3d(bgr[0], bgr[1], bgr[2]))) hidden += 1.0;
    }
  });
  return hidden;
}

// Area of the outline, px, beyond the image's border.
double outside_area(const cv::Mat& image, const OutlineModel& outline) {
  const double extent = outline.semi_major_px() + 1.0;
  const int first_x = static_cast<int>(std::floor(outline.centre_px().x() - extent));
  const int last_x = static_cast<int>(std::ceil(outline.centre_px().x() + extent));
  const int first_y = static_cast<int>(std::floor(outline.centre_px().y() - extent));
  const int last_y = static_cast<int>(std::ceil(outline.centre_px().y() + extent));
  if (first_x >= 0 && first_y >= 0 && last_x < image.cols && last_y < image.rows) return 0.0;
  double outside = 0.0;
  for (int y = first_y; y <= last_y; ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      if (x >= 0 && y >= 0 && x < image.cols && y < image.rows) continue;
      outside += edge_coverage(outline.rim_point(Eigen::Vector2d(x, y))).fraction;
    }
  }
  return outside;
}

// What the arcs that agree show of their edges.
EdgeProfile edge_of(const Fit& fit) {
  EdgeProfile edge;
  for (const UnmixedPixel& pixel : fit.pixels) {
    if (fit.arcs[pixel.sector].weight < 1.0) continue;
    edge.add(pixel.distance_px, pixel.shown, pixel.whole, 1.0 / fit.colours[pixel.sector].noise_variance);
  }
  return edge;
}

// @param result of which colour and patch are known
MeasuredOutline measured(const Fit& fit, const cv::Mat& image, const UnmixSettings& unmix,
                         MeasuredOutline result) {
  const double radius = fit.outline.radius_px();
  result.centre_px = fit.outline.centre_px();
  result.radius_px = radius;
  result.covariance_px2 = fit.covariance_px2;
  const double centre_sd = kOutlineFit.centre_sd_px + kOutlineFit.centre_sd_per_blur * fit.outline.blur_px();
  const double rim_sd = fit.is_resampled ? kOutlineFit.resampled_rim_sd_px : kOutlineFit.rim_sd_px;
  result.covariance_px2.diagonal() += Eigen::Vector3d(centre_sd, centre_sd, rim_sd).cwiseAbs2();
  result.reduced_chi_square = fit.reduced_chi_square;
  result.inlier_ratio = fit.inlier_ratio;
  const Shades shades(unmix.ball_bgr, unmix.noise_sd_levels);
  result.hidden_fraction = hidden_area(image, fit, shades) / (slam::kPi * radius * radius);
  result.outside_fraction = outside_area(image, fit.outline) / (slam::kPi * radius * radius);
  result.light = fit.light;
  result.edge = edge_of(fit);
  return result;
}

}  // namespace

std::optional<MeasuredOutline> fit_outline(const cv::Mat& image, const Blob& blob,
                                           const FitSettings& settings) {
  if (!may_be_ball(blob)) return std::nullopt;
  const UnmixSettings unmix{palette_bgr(blob.colour), settings.noise_sd_levels};
  const std::optional<Fit> fit = fit_patch(image, blob, settings, unmix);
  if (!fit || fit->outline.radius_px() < kOutlineFit.too_small * settings.min_radius_px) return std::nullopt;
  return measured(*fit, image, unmix, {.colour = blob.colour, .seen_px = blob.area_px});
}

MeasuredOutline refine_outline(const cv::Mat& image, const MeasuredOutline& outline,
                               const SharedLightSource& light_source, const FitSettings& settings) {
  const UnmixSettings unmix{palette_bgr(outline.colour), settings.noise_sd_levels};
  Fit fit{.outline = {settings.camera, outline.centre_px, outline.radius_px, settings.blur_px},
          .is_resampled = settings.resampled};
  if (!suit_shades(fit, image, settings, unmix, light_source)) return outline;
  return measured(fit, image, unmix, outline);
}

}  // namespace stereobench::vision
