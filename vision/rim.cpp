#include "vision/rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace stereobench::vision {
namespace {

constexpr double kArcLength_px = 3.0;
constexpr double kRingWidth_px = 2.0;
constexpr double kShadeUncertainty = 0.12;  // of the ball's brightness at the rim, relative
constexpr double kShadeTolerance = 0.10;    // colour off the ball's line, relative to its brightness
constexpr double kMinShade_levels = 35.0;   // a ball in the deepest shade and its own noise has more
constexpr double kMinContrast_levels = 14.0;
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

struct ColourSum {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double count = 0.0;

  void add(const Eigen::Vector3d& bgr) {
    sum += bgr;
    squares.noalias() += bgr * bgr.transpose();
    count += 1.0;
  }
  Eigen::Vector3d mean() const { return sum / count; }
  Eigen::Matrix3d covariance() const { return squares / count - mean() * mean().transpose(); }
};

struct ArcSamples {
  ColourSum inside;
  ColourSum outside;
};

std::vector<ArcSamples> sample_arcs(const Rim& rim, const OutlineModel& outline, double gap_px) {
  std::vector<ArcSamples> arcs(rim.sectors);
  for (const RimPixel& pixel : rim.pixels) {
    const double distance = outline.rim_point(pixel.position_px).distance_px;
    const double beyond_gap = std::abs(distance) - gap_px;
    if (beyond_gap < 0.0 || beyond_gap > kRingWidth_px) continue;
    ArcSamples& arc = arcs[pixel.sector];
    (distance < 0.0 ? arc.inside : arc.outside).add(pixel.bgr);
  }
  return arcs;
}

// Weighted least squares of I - background = alpha (ball - background), with noise sigma^2 in each channel
// and the shade's uncertainty along the ball's own colour.
ArcColours unmixing(const ArcSamples& arc, double noise_variance) {
  ArcColours result;
  result.background = arc.outside.mean();
  const Eigen::Vector3d ball = arc.inside.mean();
  const Eigen::Vector3d contrast = ball - result.background;
  const double shade_variance = 0.4 * kShadeUncertainty * kShadeUncertainty * ball.squaredNorm();
  const double damping = shade_variance / (noise_variance + shade_variance);
  const Eigen::Vector3d along = ball.normalized();
  const Eigen::Vector3d weighted = contrast - damping * along.dot(contrast) * along;
  const double strength = contrast.dot(weighted);
  if (!(strength > kMinContrast_levels * kMinContrast_levels)) return result;
  result.unmix = weighted / strength;
  const double texture = result.unmix.dot(arc.outside.covariance() * result.unmix);
  result.alpha_variance = noise_variance / strength + 0.5 * texture;
  result.usable = true;
  return result;
}

}  // namespace

bool is_shade_of(const Eigen::Vector3d& bgr, const Eigen::Vector3d& ball_bgr, double noise_levels) {
  const Eigen::Vector3d line = ball_bgr.normalized();
  const double brightness = line.dot(bgr);
  if (brightness < kMinShade_levels) return false;
  const double tolerance = kShadeTolerance * brightness + 3.0 * noise_levels;
  return (bgr - brightness * line).squaredNorm() <= tolerance * tolerance;
}

Rim collect_rim(const cv::Mat& image, const OutlineModel& outline, double reach_px) {
  Rim rim;
  rim.sectors =
      static_cast<std::size_t>(std::clamp(2.0 * kPi * outline.radius_px() / kArcLength_px, 12.0, 96.0));
  const Eigen::Vector2d centre = outline.centre_px();
  const double extent = outline.semi_major_px() + reach_px;
  const int first_y = std::max(0, static_cast<int>(std::ceil(centre.y() - extent)));
  const int last_y = std::min(image.rows - 1, static_cast<int>(std::floor(centre.y() + extent)));
  const int first_x = std::max(0, static_cast<int>(std::ceil(centre.x() - extent)));
  const int last_x = std::min(image.cols - 1, static_cast<int>(std::floor(centre.x() + extent)));
  for (int y = first_y; y <= last_y; ++y) {
    const auto* row = image.ptr<std::uint8_t>(y);
    for (int x = first_x; x <= last_x; ++x) {
      const Eigen::Vector2d position(x, y);
      const double distance = outline.rim_point(position).distance_px;
      if (!(std::abs(distance) <= reach_px)) continue;
      const std::uint8_t* bgr = row + 3 * x;
      const auto sector =
          static_cast<std::size_t>(turns(position - centre) * static_cast<double>(rim.sectors));
      rim.pixels.push_back({position, Eigen::Vector3d(bgr[0], bgr[1], bgr[2]), sector});
    }
  }
  return rim;
}

std::vector<ArcColours> arc_colours(const Rim& rim, const OutlineModel& outline,
                                    const UnmixSettings& settings) {
  const std::vector<ArcSamples> samples = sample_arcs(rim, outline, settings.gap_px);
  const double noise_variance = settings.noise_sd_levels * settings.noise_sd_levels + 1.0 / 12.0;
  std::vector<ArcColours> arcs(rim.sectors);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const ArcSamples& arc = samples[i];
    if (arc.inside.count < 2.0 || arc.outside.count < 2.0) continue;
    const double mean_noise = std::sqrt(noise_variance / arc.inside.count);
    if (!is_shade_of(arc.inside.mean(), settings.ball_bgr, mean_noise)) continue;
    arcs[i] = unmixing(arc, noise_variance);
  }
  return arcs;
}

}  // namespace stereobench::vision
