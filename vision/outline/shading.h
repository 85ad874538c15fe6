/// The colours that a matt ball of one paint shows.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "vision/outline/light_source.h"
#include "vision/outline/outline_model.h"
#include "vision/tuning/shading.h"
#include "vision/types.h"

namespace stereobench::vision {

/// The shades of a ball's colour: what lies near the line from black through it.
class Shades {
 public:
  /// @param ball_bgr any brightness
  /// @param noise_levels standard deviation of the channels of the colours to be tested
  Shades(const Eigen::Vector3d& ball_bgr, double noise_levels)
      : line_(ball_bgr.normalized()), noise_tolerance_(kShades.noise_sigmas * noise_levels) {}

  /// Whether a colour is a shade of the ball's.
  bool contain(const Eigen::Vector3d& bgr) const {
    const double brightness = line_.dot(bgr);
    const double tolerance = kShades.tolerance * brightness + noise_tolerance_;
    return brightness >= kShades.darkest_levels &&
           bgr.squaredNorm() - brightness * brightness <= tolerance * tolerance;
  }

 private:
  Eigen::Vector3d line_;
  double noise_tolerance_;
};

/// The surface of the ball behind an outline.
class BallSurface {
 public:
  BallSurface(const Intrinsics& camera, const OutlineModel& outline);

  /// Where the ball faces that a pixel shows; beyond the outline, where its nearest point faces.
  /// @return unit, in the camera's frame
  Eigen::Vector3d normal(const Eigen::Vector2d& pixel_px) const {
    const Eigen::Vector2d sight = (pixel_px - principal_px_) * per_focal_px_;  // and 1 ahead, as the ball is
    const double along = sight.dot(centre_) + 1.0;
    const double length2 = sight.squaredNorm() + 1.0;
    const double half_chord2 = along * along - length2 * tangent2_;
    const bool is_met = half_chord2 > 0.0;
    const double scale = (is_met ? along - std::sqrt(half_chord2) : along) / length2;
    const Eigen::Vector3d outwards(scale * sight.x() - centre_.x(), scale * sight.y() - centre_.y(),
                                   scale - 1.0);
    return outwards * (is_met ? per_radius_ : 1.0 / outwards.norm());
  }

 private:
  Eigen::Vector2d principal_px_;
  double per_focal_px_;
  Eigen::Vector2d centre_;
  double tangent2_;    ///< squared length of a tangent from the camera
  double per_radius_;  ///< of the ball
};

/// What a ball shows of itself under one light source and light from all around: c0 + max(0, n . l) in each
/// channel (Lambert), n the surface's normal.
class Shading {
 public:
  Shading(const BallSurface& surface, const BallLight& light)
      : surface_(surface), light_(light), light_source_(light.colours.bottomRows<3>().rowwise().sum()) {}

  /// What a pixel of the ball shows, BGR levels; beyond the outline what its nearest point shows.
  Eigen::Vector3d at(const Eigen::Vector2d& pixel_px) const {
    const Eigen::Vector3d normal = surface_.normal(pixel_px);
    Eigen::Vector3d colour = light_.colours.row(0).transpose();
    if (light_source_.dot(normal) > 0.0)
      colour.noalias() += light_.colours.bottomRows<3>().transpose() * normal;
    return colour;
  }

  const BallLight& light() const { return light_; }

 private:
  BallSurface surface_;
  BallLight light_;
  Eigen::Vector3d light_source_;  ///< where it shines from, times its brightness in all channels
};

/// Fits the shading of a ball to what is seen of it, by least squares; which samples are turned away from the
/// light source is found in turns with it.
/// @param image CV_8UC3, BGR
/// @param shades pixels of other colours are not the ball's
/// @param noise_variance of a pixel's channel, levels^2
/// @param shared what other balls tell of the light source, if anything
/// @return empty when too little of the ball is seen
std::optional<Shading> fit_shading(const cv::Mat& image, const Intrinsics& camera,
                                   const OutlineModel& outline, const Shades& shades, double noise_variance,
                                   const std::optional<SharedLightSource>& shared);

}  // namespace stereobench::vision
