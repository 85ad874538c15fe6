#include "vision/rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Cholesky>

namespace stereobench::vision {
namespace {

constexpr double kArcLength_px = 3.0;
constexpr double kRingWidth_px = 2.0;
constexpr double kBackgroundDepth_px = 0.25;  // outside of the outline: where the background in rim pixels is
constexpr std::size_t kSlopeArcs = 2;         // to either side
constexpr double kShadeUncertainty = 0.12;    // of the ball's brightness at the rim, relative
constexpr double kShadeTolerance = 0.10;      // colour off the ball's line, relative to its brightness
constexpr double kMinShade_levels = 35.0;     // a ball in the deepest shade and its own noise has more
constexpr double kMeanSquareShare = 0.4;      // of either colour in a rim pixel
constexpr double kMinContrast_levels = 14.0;
constexpr double kMaxAlphaSd = 0.5;  // a pixel that knows its alpha no better says nothing
constexpr double kPi = 3.14159265358979323846;

// Angle in turns, [0, 1), to 0.001 turns: arithmetic only, so that every machine agrees on it.
double turns(const Eigen::Vector2d& direction) {
  const double ax = std::abs(direction.x());
  const double ay = std::abs(direction.y());
  if (ax + ay == 0.0) return 0.0;
  const double z = std::min(ax, ay) / std::max(ax, ay);
  double angle = z * (0.125 + 0.0434 * (1.0 - z));  // first octant
  if (ay > ax) angle = 0.25 - angle;
  if (direction.x() < 0.0) angle = 0.5 - angle;
  if (direction.y() < 0.0) angle = 1.0 - angle;
  return angle >= 1.0 ? 0.0 : angle;
}

// Sums over the pixels on one side of an arc.
struct SideSums {
  double count = 0.0;
  Eigen::Vector3d colour = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double distance = 0.0;
  double distance_squared = 0.0;
  Eigen::Vector3d distance_colour = Eigen::Vector3d::Zero();

  Eigen::Vector3d mean() const { return colour / count; }
  Eigen::Matrix3d covariance() const { return squares / count - mean() * mean().transpose(); }
};

struct ArcSamples {
  SideSums inside;  // colour and count only
  SideSums outside;
};

std::vector<ArcSamples> sample_arcs(const Rim& rim, double gap_px) {
  std::vector<ArcSamples> arcs(rim.sectors);
  for (const RimPixel& pixel : rim.pixels) {
    const double beyond_gap = std::abs(pixel.distance_px) - gap_px;
    if (beyond_gap < 0.0 || beyond_gap > kRingWidth_px) continue;
    ArcSamples& arc = arcs[pixel.sector];
    SideSums& side = pixel.distance_px < 0.0 ? arc.inside : arc.outside;
    side.count += 1.0;
    side.colour += pixel.bgr;
    if (pixel.distance_px < 0.0) continue;
    side.squares.noalias() += pixel.bgr * pixel.bgr.transpose();
    side.distance += pixel.distance_px;
    side.distance_squared += pixel.distance_px * pixel.distance_px;
    side.distance_colour += pixel.distance_px * pixel.bgr;
  }
  return arcs;
}

// The background's change per pixel outwards, pooled over the arcs beside this one, as far as noise allows to
// tell.
Eigen::Vector3d background_slope(const std::vector<ArcSamples>& arcs, std::size_t arc,
                                 double noise_variance) {
  double spread = 0.0;
  Eigen::Vector3d product = Eigen::Vector3d::Zero();
  for (std::size_t step = 0; step < 2 * kSlopeArcs + 1; ++step) {
    const SideSums& side = arcs[(arc + arcs.size() + step - kSlopeArcs) % arcs.size()].outside;
    if (side.count < 2.0) continue;
    spread += side.distance_squared - side.distance * side.distance / side.count;
    product += side.distance_colour - side.colour * (side.distance / side.count);
  }
  if (!(spread > 1.0)) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d slope = product / spread;
  const double expected_of_noise = 3.0 * noise_variance / spread;
  return slope * std::max(0.0, 1.0 - expected_of_noise / (slope.squaredNorm() + 1e-9));
}

// Small balls have few pixels inside: the arcs on both sides help out.
void borrow_inside(const std::vector<ArcSamples>& arcs, std::size_t arc, ArcSamples& into) {
  for (const std::size_t step : {std::size_t{1}, arcs.size() - 1}) {
    const SideSums& side = arcs[(arc + step) % arcs.size()].inside;
    into.inside.count += side.count;
    into.inside.colour += side.colour;
  }
}

// How the background's colours scatter about their means beside the arcs, beyond what noise explains:
// texture. An edge in the background may lie under the rim, unseen beside it, so what all arcs show goes for
// each.
Eigen::Matrix3d texture_covariance(const std::vector<ArcSamples>& arcs, double noise_variance) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  double freedom = 0.0;
  for (const ArcSamples& arc : arcs) {
    if (arc.outside.count < 2.0) continue;
    scatter += arc.outside.count * arc.outside.covariance();
    freedom += arc.outside.count - 1.0;
  }
  if (!(freedom > 0.0)) return Eigen::Matrix3d::Zero();
  const Eigen::Matrix3d texture = scatter / freedom - noise_variance * Eigen::Matrix3d::Identity();
  return texture.trace() > 0.0 ? texture : Eigen::Matrix3d::Zero();
}

// What disturbs the colours of rim pixels.
struct Disturbance {
  double noise_variance = 0.0;  // of each channel
  Eigen::Matrix3d texture = Eigen::Matrix3d::Zero();
};

// Generalised least squares of I - background = alpha (ball - background). The image's noise disturbs all
// channels alike, the shade at the rim lies along the ball's own colour, and texture mostly along grey: alpha
// is read in the direction that suffers least from the three of them.
ArcColours unmixing(const ArcSamples& arc, const Eigen::Vector3d& slope, const Disturbance& disturbance) {
  ArcColours result;
  const double outwards_px = arc.outside.distance / arc.outside.count - kBackgroundDepth_px;
  result.background = arc.outside.mean() - outwards_px * slope;
  const Eigen::Vector3d ball = arc.inside.mean();
  const Eigen::Vector3d contrast = ball - result.background;
  if (!(contrast.norm() > kMinContrast_levels)) return result;
  const Eigen::Vector3d shade = kShadeUncertainty * ball;
  const Eigen::Matrix3d covariance = disturbance.noise_variance * Eigen::Matrix3d::Identity() +
                                     kMeanSquareShare * (shade * shade.transpose() + disturbance.texture);
  const Eigen::LDLT<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d weighted = solver.solve(contrast);
  const double strength = contrast.dot(weighted);
  if (!solver.isPositive() || !(strength > 1.0 / (kMaxAlphaSd * kMaxAlphaSd))) return result;
  result.unmix = weighted / strength;
  result.noise_variance = disturbance.noise_variance * result.unmix.squaredNorm();
  result.texture_variance = std::max(0.0, result.unmix.dot(disturbance.texture * result.unmix));
  result.usable = true;
  return result;
}

}  // namespace

bool Shades::contain(const Eigen::Vector3d& bgr) const {
  const double brightness = line_.dot(bgr);
  const double tolerance = kShadeTolerance * brightness + noise_tolerance_;
  return brightness >= kMinShade_levels &&
         bgr.squaredNorm() - brightness * brightness <= tolerance * tolerance;
}

Rim collect_rim(const cv::Mat& image, const OutlineModel& outline, double reach_px) {
  Rim rim;
  rim.sectors =
      static_cast<std::size_t>(std::clamp(2.0 * kPi * outline.radius_px() / kArcLength_px, 9.0, 96.0));
  const Eigen::Vector2d centre = outline.centre_px();
  const double relative_reach = reach_px / outline.semi_minor_px();
  const double extent = outline.semi_major_px() * (1.0 + relative_reach);
  const int first_y = std::max(0, static_cast<int>(std::ceil(centre.y() - extent)));
  const int last_y = std::min(image.rows - 1, static_cast<int>(std::floor(centre.y() + extent)));
  for (int y = first_y; y <= last_y; ++y) {
    const auto* row = image.ptr<std::uint8_t>(y);
    const ColumnSpan outer = outline.columns_within(1.0 + relative_reach, y);
    const ColumnSpan inner = outline.columns_within(1.0 - relative_reach, y);
    const int last_x = std::min(image.cols - 1, outer.last);
    for (int x = std::max(0, outer.first); x <= last_x; ++x) {
      if (x == inner.first && inner.last > x) x = inner.last;  // the middle of the ball is not the rim
      const Eigen::Vector2d position(x, y);
      const double distance = outline.rim_point(position).distance_px;
      if (x > last_x || !(std::abs(distance) <= reach_px)) continue;
      const std::uint8_t* bgr = row + 3 * x;
      const auto sector =
          static_cast<std::size_t>(turns(position - centre) * static_cast<double>(rim.sectors));
      rim.pixels.push_back({position, Eigen::Vector3d(bgr[0], bgr[1], bgr[2]), distance, sector});
    }
  }
  return rim;
}

std::vector<ArcColours> arc_colours(const Rim& rim, const UnmixSettings& settings) {
  const std::vector<ArcSamples> samples = sample_arcs(rim, settings.gap_px);
  const double noise_variance = settings.noise_sd_levels * settings.noise_sd_levels + 1.0 / 12.0;
  const Disturbance disturbance{noise_variance, texture_covariance(samples, noise_variance)};
  std::vector<ArcColours> arcs(rim.sectors);
  std::vector<std::size_t> hidden;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    ArcSamples arc = samples[i];
    if (arc.inside.count < 3.0) borrow_inside(samples, i, arc);
    if (arc.inside.count < 2.0 || arc.outside.count < 2.0) continue;
    const Shades shades(settings.ball_bgr, std::sqrt(noise_variance / arc.inside.count));
    if (shades.contain(arc.inside.mean())) {
      arcs[i] = unmixing(arc, background_slope(samples, i, noise_variance), disturbance);
    } else {
      hidden.push_back(i);
    }
  }
  for (const std::size_t i : hidden) {  // what hides one arc may begin in the next
    arcs[(i + 1) % arcs.size()].usable = false;
    arcs[(i + arcs.size() - 1) % arcs.size()].usable = false;
  }
  return arcs;
}

}  // namespace stereobench::vision
