/// Who looks for the balls: ours, a callable that was linked in, or somebody's program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "vision/camera/camera_pair.h"
#include "vision/colour/learned_palette.h"
#include "vision/types.h"
#include "worlds/camera_sensor.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// What a detector is shown: one instant, as the camera stores it.
struct DetectorInput {
  std::size_t frame = 0;  ///< the step of the path; lost frames are not shown
  std::int64_t stamp_ns = 0;
  const vision::StereoPair& pair;
  const vision::StereoRig& rig;  ///< as it is believed to be
};

/// Finds the balls of a pair. Each drive has one of its own, which is shown the frames in order of time.
///
/// An observation needs `range_bearing` with its covariance, in the robot's frame and with its colour_class,
/// `colour` (or kUnknown), and both cameras' pixels, or `has_pixels = false`; one that is not trusted() goes
/// neither to the score nor to the filters.
using Detector = std::function<std::vector<vision::BallObservation>(const DetectorInput&)>;

/// What a detector may know before it is shown anything.
struct DetectorSetup {
  vision::StereoRig rig;                      ///< as it is believed to be
  std::optional<vision::CameraPair> cameras;  ///< of a rig of two different cameras; ours alone knows of them
  double ball_radius_m = 0.05;                ///< that balls are made to
  double ball_radius_sd_m = 0.0;              ///< how exactly they are; 0: exactly
  double rows_within_px = 10.0;               ///< that the rig may be off by
  double noise_sd_levels = 0.0;               ///< of a grey pixel, in levels of 255
  worlds::Encoding encoding = worlds::Encoding::kLinear;
  double gamma = 2.2;                          ///< of Encoding::kGamma
  std::vector<vision::LearnedColour> palette;  ///< colours that were learned; empty: vision::kPalette
};

/// What levels are by their encoding, for colours that are learned: gamma is near enough to sRGB.
vision::Levels levels_of(worlds::Encoding encoding);

/// What detectors are told of a scenario.
DetectorSetup detector_setup(const worlds::Scenario& scenario);

/// vision::observe, after the encoding and what is believed of the rig are undone. What the frames so far
/// have told of the rig is kept from one to the next.
Detector our_detector(const DetectorSetup& setup);

}  // namespace stereobench::harness
