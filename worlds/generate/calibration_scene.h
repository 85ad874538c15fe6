/// A world to calibrate cameras in: balls of all colours at all distances around a robot that turns on the
/// spot.
#pragma once

#include <cstdint>

#include "worlds/types.h"

namespace stereobench::worlds {

/// Depths that the balls of a calibration scene are drawn from.
struct CalibrationDepths {
  double nearest_m = 0.0;  ///< where one outline and its shift between the cameras fill six tenths of a row
  double farthest_m = 0.0;
};

/// The depths at which a rig can measure balls at all.
/// @param smallest_radius_px outlines below that are not measured
CalibrationDepths measurable_depths(const vision::StereoRig& rig, double ball_radius_m,
                                    double smallest_radius_px);

/// What a calibration scene looks like.
struct CalibrationSceneSettings {
  CalibrationDepths depths;
  bool plain = false;  ///< walls and floor without texture: what is measured then is the noise alone
};

/// A scenario with the cameras of another: its rig, what is believed of it, its camera, its detector, and its
/// size of balls with their tolerance, which world_for_seed draws. All else is drawn: where balls are (evenly
/// over the logarithm of their depth and over the pictures), their colours, the sun and the ambient light,
/// the materials of the floor and of walls behind them. Balls may hide parts of each other. The robot stands
/// at the origin and looks once into each direction, as many as its field of view has room for; it does not
/// move, so that the shutter is left out.
/// @param scenario with a stereo sensor
/// @param seed of the draws
Scenario calibration_scene(const Scenario& scenario, const CalibrationSceneSettings& settings,
                           std::uint64_t seed);

}  // namespace stereobench::worlds
