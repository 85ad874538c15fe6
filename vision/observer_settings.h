/// What the vision stage is told before it looks.
#pragma once

#include "vision/colour/colour_table.h"

namespace stereobench::vision {

/// What the observer knows of the balls and of the camera before it looks.
struct ObserverSettings {
  double ball_radius_m = 0.05;    ///< that balls are made to
  double ball_radius_sd_m = 0.0;  ///< how exactly: standard deviation, at most the radius; 0 is exactly
  double noise_sd_levels = 0.0;   ///< per pixel and channel, in levels of 255; scales the covariances
  double rows_within_px = 10.0;   ///< that a rig may be off by: 0.5 degrees about x are 8 px at f = 887 px
  double min_radius_px = 5.0;     ///< outlines of less than 0.98 of it are not measured
  double min_depth_m = 0.15;      ///< nearer balls are not looked for
  /// Whether the pictures were interpolated, as those that were rectified are: edges are then less
  /// alike.
  bool resampled = false;
  /// Colours that were learned (learned_palette.h), in place of kPalette's; must outlive the settings.
  const ColourTable* learned = nullptr;
};

}  // namespace stereobench::vision
