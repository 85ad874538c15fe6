#include "vision/outline/arc_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "slam/math/angles.h"
#include "vision/tuning/arc_fit.h"

namespace stereobench::vision {
namespace {

double robust_weight(double residual_px, double threshold_px) {
  const double size = std::abs(residual_px) / threshold_px;
  if (size <= 1.0) return 1.0;
  return size < kArcFit.cut_off ? 1.0 / size : 0.0;
}

Eigen::Vector3d direction(const ArcOffset& arc) {
  return {arc.normal.x(), arc.normal.y(), 1.0};
}

// How well an arc agrees with a change of the outline: 1 as far as chance goes, 0 when it does not.
double agreement(const ArcOffset& arc, const Eigen::Vector3d& change_px, double tolerance_px) {
  const double residual = arc.offset_px - direction(arc).dot(change_px);
  return robust_weight(residual, tolerance_px + kArcFit.huber_sigmas * std::sqrt(arc.variance_px2));
}

// @return whether any weight is another one than before
bool weigh(ScratchVector<ArcOffset>& arcs, const Eigen::Vector3d& change_px, double tolerance_px) {
  bool any_changed = false;
  for (ArcOffset& arc : arcs) {
    if (arc.variance_px2 <= 0.0) continue;
    const double weight = agreement(arc, change_px, tolerance_px);
    any_changed = any_changed || weight != arc.weight;
    arc.weight = weight;
  }
  return any_changed;
}

double agreement_of_all(const ScratchVector<ArcOffset>& arcs, const Eigen::Vector3d& change_px,
                        double tolerance_px) {
  double sum = 0.0;
  for (const ArcOffset& arc : arcs) {
    if (arc.variance_px2 > 0.0) sum += agreement(arc, change_px, tolerance_px);
  }
  return sum;
}

bool any_denied(const ScratchVector<ArcOffset>& arcs) {
  return std::ranges::any_of(
      arcs, [](const ArcOffset& arc) { return arc.variance_px2 > 0.0 && arc.weight <= 0.0; });
}

using Triple = std::array<const ArcOffset*, 3>;

// The change by which three arcs are right; not finite when they do not tell it.
Eigen::Vector3d change_by(const Triple& triple) {
  Eigen::Matrix3d directions;
  Eigen::Vector3d offsets;
  for (int i = 0; i < 3; ++i) {
    const ArcOffset& arc = *triple[static_cast<std::size_t>(i)];
    directions.row(i) = direction(arc).transpose();
    offsets[i] = arc.offset_px;
  }
  return directions.inverse() * offsets;
}

// Of `change_px` and what triples of arcs say, the change that most arcs agree with (Fischler and Bolles
// 1981, with triples that are not drawn but taken all around). Least squares are led astray where arcs that
// are hidden one beside the other show one edge.
Eigen::Vector3d most_agreed(const ScratchVector<ArcOffset>& arcs, Eigen::Vector3d change_px,
                            double tolerance_px) {
  double most = agreement_of_all(arcs, change_px, tolerance_px);
  for (const std::size_t part : kArcFit.triple_parts) {
    const std::size_t apart = std::max<std::size_t>(1, arcs.size() / part);
    for (std::size_t i = 0; i < kArcFit.triples; ++i) {
      const std::size_t first = i * arcs.size() / kArcFit.triples;
      const Triple triple = {&arcs[first], &arcs[(first + apart) % arcs.size()],
                             &arcs[(first + 2 * apart) % arcs.size()]};
      if (std::ranges::any_of(triple, [](const ArcOffset* arc) { return arc->variance_px2 <= 0.0; }))
        continue;
      const Eigen::Vector3d change = change_by(triple);
      if (!change.allFinite()) continue;
      const double agreed = agreement_of_all(arcs, change, tolerance_px);
      if (agreed <= most) continue;
      most = agreed;
      change_px = change;
    }
  }
  return change_px;
}

// How far from the outline a pixel may be that it crosses.
double crossed_reach_px(const OutlineModel& outline, double ramp_half_width_px) {
  constexpr double kHalfDiagonal_px = 0.7072;
  if (ramp_half_width_px > 0.0) return ramp_half_width_px;
  return outline.blur_px() > 0.0 ? std::numeric_limits<double>::infinity() : kHalfDiagonal_px;
}

// What the arcs' variances are to be multiplied by where they contradict each other more than by chance
// (Birge's ratio, squared).
double reduced_chi_square(const ScratchVector<ArcOffset>& arcs, const Eigen::Vector3d& change_px,
                          double tolerance_px) {
  double squares = 0.0;
  double freedom = -3.0;
  for (const ArcOffset& arc : arcs) {
    if (arc.weight <= 0.0) continue;
    const double residual = arc.offset_px - direction(arc).dot(change_px);
    squares += arc.weight * residual * residual / (arc.variance_px2 + tolerance_px * tolerance_px);
    freedom += arc.weight;
  }
  if (!(freedom > 1.0)) return 1.0;
  const double ratio = squares / freedom;
  return ratio > 1.0 + kArcFit.contradiction_sigmas * std::sqrt(2.0 / freedom) ? ratio : 1.0;
}

}  // namespace

ScratchVector<UnmixedPixel> unmix(const Rim& rim, const ScratchVector<ArcColours>& colours) {
  ScratchVector<UnmixedPixel> pixels;
  pixels.reserve(rim.pixels.size());
  for (const RimPixel& pixel : rim.pixels) {
    const ArcColours& colour = colours[pixel.sector];
    if (!colour.usable) continue;
    pixels.push_back(
        {pixel.position_px, colour.shown(pixel), colour.whole(pixel), pixel.distance_px, pixel.sector});
  }
  return pixels;
}

ScratchVector<ArcOffset> arc_offsets(const ScratchVector<UnmixedPixel>& pixels,
                                     const ScratchVector<ArcColours>& colours, const OutlineModel& outline,
                                     double ramp_half_width_px, bool is_resampled) {
  ScratchVector<ArcOffset> arcs(colours.size());
  ScratchVector<double> information(colours.size(), 0.0);
  const double in_focus = kArcFit.noise_factor + kArcFit.noise_factor_per_radius_px / outline.radius_px();
  const double noise_factor =
      in_focus + kArcFit.noise_per_edge * (in_focus - 1.0) * (edge_width_px(outline.blur_px()) - 1.0);
  const double in_picture = outline.blur_px() > 0.0 ? kArcFit.profile : kArcFit.quantisation;
  const double beyond_noise = is_resampled ? kArcFit.resampled : in_picture;
  const double arc_length_px = 2.0 * slam::kPi * outline.radius_px() / static_cast<double>(arcs.size());
  const double texture_factor =
      kArcFit.texture_factor * std::min(1.0, kArcFit.texture_length_px / arc_length_px);
  const double crossed = crossed_reach_px(outline, ramp_half_width_px) / outline.semi_minor_px();
  const double innermost = std::max(0.0, 1.0 - crossed);
  const double outermost = 1.0 + crossed;
  for (const UnmixedPixel& pixel : pixels) {
    const double level2 = outline.level2(pixel.position_px);
    if (!(level2 >= innermost * innermost && level2 <= outermost * outermost)) continue;
    const RimPoint point = outline.rim_point(pixel.position_px);
    const Coverage covered =
        ramp_half_width_px > 0.0 ? ramp_coverage(point, ramp_half_width_px) : outline.coverage(point);
    if (covered.per_px <= 0.0) continue;
    const double slope = covered.per_px * pixel.whole;
    ArcOffset& arc = arcs[pixel.sector];
    arc.offset_px += slope * (pixel.shown - covered.fraction * pixel.whole);
    arc.normal += slope * slope * point.normal;
    information[pixel.sector] += slope * slope;
  }
  const double ramp_px = std::max(1.0, 2.0 * ramp_half_width_px);  // along which a pixel of edge is spread
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (!(information[i] * ramp_px > kArcFit.least_edge_px)) continue;
    arcs[i].offset_px /= information[i];
    arcs[i].normal /= information[i];
    arcs[i].variance_px2 =
        (noise_factor * colours[i].noise_variance + beyond_noise * beyond_noise) / information[i] +
        texture_factor * colours[i].texture_variance;
    arcs[i].weight = 1.0;
  }
  return arcs;
}

void move_outline(ScratchVector<ArcOffset>& arcs, const Eigen::Vector3d& change_px) {
  for (ArcOffset& arc : arcs) arc.offset_px -= direction(arc).dot(change_px);
}

std::optional<OutlineStep> solve_arcs(ScratchVector<ArcOffset>& arcs, double tolerance_px) {
  OutlineStep step;
  const auto count = static_cast<double>(arcs.size());
  for (int pass = 0; pass < kArcFit.reweightings; ++pass) {
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
    double share = 0.0;
    for (const ArcOffset& arc : arcs) {
      if (arc.weight <= 0.0) continue;
      const double weight = arc.weight / arc.variance_px2;
      const Eigen::Vector3d along = direction(arc);
      normal_matrix.noalias() += weight * along * along.transpose();
      right_side += weight * arc.offset_px * along;
      share += arc.weight;
    }
    step.share = share / count;
    if (!(step.share > kArcFit.min_inlier_ratio)) return std::nullopt;
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal_matrix);
    step.change_px = solver.solve(right_side);
    step.covariance_px2 = solver.solve(Eigen::Matrix3d::Identity());
    if (!step.change_px.allFinite()) return std::nullopt;
    if (!weigh(arcs, step.change_px, tolerance_px)) break;
    if (pass == 0 && any_denied(arcs))
      weigh(arcs, most_agreed(arcs, step.change_px, tolerance_px), tolerance_px);
  }
  step.reduced_chi_square = reduced_chi_square(arcs, step.change_px, tolerance_px);
  step.covariance_px2 *= step.reduced_chi_square;
  return step;
}

}  // namespace stereobench::vision
