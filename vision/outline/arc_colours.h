/// The two colours that mix in the rim of a ball, arc by arc.
#pragma once

#include <Eigen/Core>

#include "vision/outline/rim.h"

namespace stereobench::vision {

/// What the pixels of one arc are mixed of: covered . ball + (1 - covered) . background. The ball's colour at
/// a pixel is the shading's (RimPixel::shade) plus what the arc shows beyond it.
struct ArcColours {
  /// How much of the ball a colour is: 0 for the background just outside, about 1 for the ball.
  Colour unmix = Colour::Zero();
  double beyond_shade = 0.0;      ///< what the ball is worth beyond its shade
  double noise_variance = 0.0;    ///< of a pixel's share of the ball, from image noise
  double texture_variance = 0.0;  ///< the same, since texture is not the same at the rim as beside it
  bool usable = false;            ///< the ball's colour inside, another one outside, enough contrast

  /// How much of the ball a pixel shows, in the unit of `whole`.
  double shown(const RimPixel& pixel) const { return static_cast<double>(unmix.dot(pixel.colour)); }

  /// How much it would show if the ball covered it.
  double whole(const RimPixel& pixel) const {
    return static_cast<double>(unmix.dot(pixel.shade)) + beyond_shade;
  }
};

/// What arc colours are judged by.
struct UnmixSettings {
  Eigen::Vector3d ball_bgr = Eigen::Vector3d::Zero();  ///< palette colour, any brightness
  double noise_sd_levels = 0.0;
};

/// Samples both colours of each arc and prepares how they are told apart.
///
/// The ball's colour at the rim is the shading's; what is shown beside the rim says how well that can be
/// trusted. Without shading it is known from further inside only to some 12 %, since Lambert's shading
/// changes fastest there. Differences along which shade or the background's texture varies count for little.
ScratchVector<ArcColours> arc_colours(const Rim& rim, const UnmixSettings& settings);

}  // namespace stereobench::vision
