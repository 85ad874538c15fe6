#include "vision/outline/arc_colours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/LU>

#include "vision/pixel_noise.h"
#include "vision/tuning/arc_colours.h"

namespace stereobench::vision {
namespace {

// The ball beside one arc.
struct BallBeside {
  BallSums inside;
  bool shows_ball = false;
};

using Balls = ScratchVector<BallBeside>;

Balls balls_beside(const ScratchVector<RimArc>& arcs, const UnmixSettings& settings, double noise_variance) {
  Balls balls(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    BallSums& inside = balls[i].inside;
    inside = arcs[i].inside;
    if (inside.count() < 3.0) {  // small balls have few pixels inside: the arcs on both sides help out
      inside.add(arcs[(i + 1) % arcs.size()].inside);
      inside.add(arcs[(i + arcs.size() - 1) % arcs.size()].inside);
    }
    if (inside.count() < 2.0) continue;
    const Shades shades(settings.ball_bgr, std::sqrt(noise_variance / inside.count()));
    balls[i].shows_ball = shades.contain(inside.mean());
  }
  return balls;
}

// Visits an arc and as many as `reach` to either side of it, each once.
template <typename Arc, typename Visit>
void visit_around(const ScratchVector<Arc>& arcs, std::size_t arc, std::size_t reach, const Visit& visit) {
  const std::size_t count = std::min(2 * reach + 1, arcs.size());
  std::size_t next = arc >= reach ? arc - reach : arc + arcs.size() - std::min(reach, arcs.size());
  for (std::size_t step = 0; step < count; ++step) {
    visit(arcs[next]);
    if (++next == arcs.size()) next = 0;
  }
}

// How much of a difference is believed whose square is `squares` times its noise's, of so many degrees of
// freedom (the positive part of James and Stein's estimate).
double believed_part(double squares, double freedom) {
  return squares > freedom ? 1.0 - freedom / squares : 0.0;
}

// How the background's colours scatter beyond what noise explains: its own trace would be off by
// noise_variance sqrt(6 / freedom).
Eigen::Matrix3d texture(const Eigen::Matrix3d& scatter, double freedom, double noise_variance) {
  if (!(freedom > 0.0)) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d beyond = scatter / freedom - noise_variance * Eigen::Matrix3d::Identity();
  const double by_chance = kArcColours.texture_sigmas * noise_variance * std::sqrt(6.0 / freedom);
  return beyond.trace() > by_chance ? beyond : Eigen::Matrix3d::Zero();
}

// Beside all arcs, each about its own mean. An edge in the background may lie under the rim and be seen
// nowhere; deviations are averaged, not variances, so that one edge beside a few arcs says little of all.
Eigen::Matrix3d texture_everywhere(const ScratchVector<RimArc>& arcs, double noise_variance) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double deviations = 0.0;
  double count = 0.0;
  for (const RimArc& arc : arcs) {
    if (arc.outside.count() < 2.0) continue;
    count += 1.0;
    const Eigen::Matrix3d beside = texture(arc.outside.scatter(), arc.outside.count() - 1.0, noise_variance);
    const double variance = beside.trace();
    if (!(variance > 0.0)) continue;
    const double deviation = std::sqrt(variance);
    sum += beside / deviation;
    deviations += deviation;
  }
  return sum * (count > 0.0 ? deviations / (count * count) : 0.0);
}

// Beside an arc and its neighbours, about one mean: what is beside the rim most often goes on behind it.
Eigen::Matrix3d texture_around(const ScratchVector<RimArc>& arcs, std::size_t arc, double noise_variance) {
  BackgroundSums around;
  visit_around(arcs, arc, kArcColours.texture_arcs,
               [&](const RimArc& other) { around.moments += other.outside.moments; });
  return texture(around.scatter(), around.count() - 1.0, noise_variance);
}

// How the background beside one arc changes with its distance from the rim: `products` / `squares`, per px.
struct Gradient {
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  double squares = 0.0;
  bool is_smooth = false;  // nothing but noise is left
};

Gradient gradient(const BackgroundSums& outside, double noise_variance) {
  const double freedom = 3.0 * (outside.count() - 2.0);
  if (!(freedom > 0.0)) return {};
  const double distance = outside.mean_distance_px();
  Gradient result;
  result.products = outside.sums_by_distance().head<3>() - distance * outside.sums().head<3>();
  result.squares = outside.distance2 - distance * outside.sums_by_distance().w();
  if (!(result.squares > 0.0)) return {};
  const double rest = outside.scatter().trace() - result.products.squaredNorm() / result.squares;
  result.is_smooth = rest < noise_variance * (freedom + kArcColours.smooth_sigmas * std::sqrt(2.0 * freedom));
  return result;
}

// Of each arc; none are smooth while the outline is not where the rim is, and the ring may show some of it.
ScratchVector<Gradient> gradients_beside(const Rim& rim, double noise_variance) {
  ScratchVector<Gradient> gradients(rim.arcs.size());
  if (!rim.has_shades) return gradients;
  for (std::size_t i = 0; i < gradients.size(); ++i)
    gradients[i] = gradient(rim.arcs[i].outside, noise_variance);
  return gradients;
}

// The background's colour where the rim is. Beside a ball that stands behind, the colours of the ring are
// not those at the rim; a step in them, which no gradient explains, is texture.
Eigen::Vector3d background_at_rim(const BackgroundSums& outside, const ScratchVector<Gradient>& gradients,
                                  std::size_t arc, double noise_variance) {
  if (!gradients[arc].is_smooth) return outside.mean();
  Gradient around;
  visit_around(gradients, arc, kArcColours.gradient_arcs, [&](const Gradient& other) {
    if (!other.is_smooth) return;
    around.products += other.products;
    around.squares += other.squares;
  });
  const double squares = around.products.squaredNorm() / (around.squares * noise_variance);
  if (!(squares > kArcColours.gradient_by_chance)) return outside.mean();
  const Eigen::Vector3d per_px = believed_part(squares, 3.0) / around.squares * around.products;
  return outside.mean() - outside.mean_distance_px() * per_px;
}

// What the ball beside one arc says of how good its shading is.
struct ShadeCheck {
  double squares = 0.0;  // of what is seen beyond the shading, in noise
  double freedom = 0.0;
  double of_brightness = 0.0;  // squares along the ball's own colour, less noise
  double brightness = 0.0;     // squared
};

ScratchVector<ShadeCheck> check_shades(const Balls& balls, double noise_variance) {
  ScratchVector<ShadeCheck> checks(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!balls[i].shows_ball) continue;
    const BallSums& inside = balls[i].inside;
    const Eigen::Vector3d mean = inside.mean();
    const Eigen::Vector3d beyond = mean - inside.mean_shade();
    const double along = beyond.dot(mean);
    checks[i] = {.squares = inside.count() * beyond.squaredNorm() / noise_variance,
                 .freedom = 3.0,
                 .of_brightness = inside.count() * along * along / mean.squaredNorm() - noise_variance,
                 .brightness = inside.count() * mean.squaredNorm()};
  }
  return checks;
}

// How well the ball's colours at the rim of an arc are known.
struct ShadeTrust {
  double beyond_shade = 1.0;  // part of what is shown beyond the shading that is not noise
  double relative_sd = kArcColours.unknown_shade;
};

ShadeTrust trust_around(const ScratchVector<ShadeCheck>& checks, std::size_t arc) {
  ShadeCheck around{.freedom = -2.0};
  visit_around(checks, arc, kArcColours.shade_arcs, [&](const ShadeCheck& other) {
    around.squares += other.squares;
    around.freedom += other.freedom;
    around.of_brightness += other.of_brightness;
    around.brightness += other.brightness;
  });
  if (!(around.freedom > 0.0)) return {};
  const double beside = std::max(0.0, around.of_brightness / around.brightness);
  const double at_rim = std::sqrt(kArcColours.shade_at_rim * kArcColours.shade_at_rim * beside +
                                  kArcColours.least_shade * kArcColours.least_shade);
  return {believed_part(around.squares, around.freedom), std::min(kArcColours.unknown_shade, at_rim)};
}

// What black adds to each channel of a colour that is the mean of noisy pixels. Mixed pixels are above black:
// a ball without blue seems to have some, and its rim to lie further out.
Eigen::Vector3d raised(const Eigen::Vector3d& bgr, double noise_sd) {
  Eigen::Vector3d by_black;
  for (int channel = 0; channel < 3; ++channel)
    by_black[channel] = raised_by_black(std::max(0.0, bgr[channel]), noise_sd);
  return by_black;
}

// The two colours of an arc, and what disturbs them.
struct Mixture {
  Eigen::Vector3d background;
  Eigen::Vector3d ball;
  Eigen::Vector3d beyond_shade;  // part of the ball's colour that the shading does not tell
  Eigen::Matrix3d texture;
  double shade_sd;        // of the ball's brightness, relative
  double noise_variance;  // of each channel
};

// Generalised least squares of I - background = alpha (ball - background). The image's noise disturbs all
// channels alike, the shade at the rim lies along the ball's own colour, and texture mostly along grey: alpha
// is read in the direction that suffers least from the three of them.
ArcColours unmixed(const Mixture& mixture) {
  ArcColours arc;
  const Eigen::Vector3d contrast = mixture.ball - mixture.background;
  if (!(contrast.norm() > kArcColours.min_contrast_levels)) return arc;
  const Eigen::Vector3d shade = mixture.shade_sd * mixture.ball;
  const Eigen::Matrix3d covariance =
      mixture.noise_variance * Eigen::Matrix3d::Identity() +
      kArcColours.mean_square_share * (shade * shade.transpose() + mixture.texture);
  const Eigen::Vector3d weighted = covariance.inverse() * contrast;
  const double strength = contrast.dot(weighted);
  if (!(strength > 1.0 / (kArcColours.max_alpha_sd * kArcColours.max_alpha_sd))) return arc;
  const Eigen::Vector3d by_channel = weighted / strength;
  arc.unmix << by_channel.cast<float>(), static_cast<float>(-by_channel.dot(mixture.background));
  arc.beyond_shade = by_channel.dot(mixture.beyond_shade);
  arc.noise_variance = mixture.noise_variance * by_channel.squaredNorm();
  arc.texture_variance = std::max(0.0, by_channel.dot(mixture.texture * by_channel));
  arc.usable = true;
  return arc;
}

}  // namespace

ScratchVector<ArcColours> arc_colours(const Rim& rim, const UnmixSettings& settings) {
  const double noise_variance = pixel_variance(settings.noise_sd_levels);
  const Balls balls = balls_beside(rim.arcs, settings, noise_variance);
  const auto gradients = gradients_beside(rim, noise_variance);
  const auto checks = rim.has_shades ? check_shades(balls, noise_variance) : ScratchVector<ShadeCheck>();
  const Eigen::Matrix3d elsewhere =
      kArcColours.texture_elsewhere * texture_everywhere(rim.arcs, noise_variance);
  ScratchVector<ArcColours> arcs(rim.arcs.size());
  const double noise_sd = std::sqrt(noise_variance);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const RimArc& seen = rim.arcs[i];
    if (!balls[i].shows_ball || seen.outside.count() < 2.0 || seen.crossed.count() < 1.0) continue;
    const BallSums& inside = balls[i].inside;
    const ShadeTrust trust = rim.has_shades ? trust_around(checks, i) : ShadeTrust{};
    const Eigen::Vector3d shade = seen.crossed.mean_shade();
    const Eigen::Vector3d beyond_shade =
        trust.beyond_shade * (inside.mean() - inside.mean_shade()) - raised(shade, noise_sd);
    const Eigen::Vector3d beside = background_at_rim(seen.outside, gradients, i, noise_variance);
    arcs[i] = unmixed({.background = beside - raised(beside, noise_sd),
                       .ball = shade + beyond_shade,
                       .beyond_shade = beyond_shade,
                       .texture = elsewhere + texture_around(rim.arcs, i, noise_variance),
                       .shade_sd = trust.relative_sd,
                       .noise_variance = noise_variance});
  }
  for (std::size_t i = 0; i < arcs.size(); ++i) {  // what hides one arc may begin in the next
    if (balls[i].shows_ball || balls[i].inside.count() < 2.0 || rim.arcs[i].outside.count() < 2.0) continue;
    arcs[(i + 1) % arcs.size()].usable = false;
    arcs[(i + arcs.size() - 1) % arcs.size()].usable = false;
  }
  return arcs;
}

}  // namespace stereobench::vision
