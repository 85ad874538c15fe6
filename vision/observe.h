/// The vision stage: from a stereo pair to the balls in it.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/camera/rectify.h"
#include "vision/observer_settings.h"
#include "vision/outline/outline_fit.h"
#include "vision/stereo/rig_watch.h"
#include "vision/types.h"

namespace stereobench::vision {

/// Finds the outlines of balls in one camera's picture.
/// @param image CV_8UC3 of the camera's size, BGR, linear light; row padding is fine
/// @return the largest patches of colour first
/// @throws std::invalid_argument as observe
std::vector<MeasuredOutline> find_outlines(const cv::Mat& image, const Intrinsics& camera,
                                           const ObserverSettings& settings);

/// Finds every ball that both cameras see and measures range and bearing to it. Colour gives the identity (or
/// its class), the outline's centre in each camera the position; eq. of sphere.h.
/// @param pair two CV_8UC3 images of the rig's size, BGR, linear light; row padding is fine
/// @param rig the rig as it is believed to be
///
/// How far a picture is out of focus is measured in it (edge_profile.h); a blur of 0.2 px or more is one of
/// the model's from then on.
///
/// Of a ball that is hidden or cut in part, at least a fifth of the outline must speak for it in each camera,
/// and a third for it to be trusted. All balls are measured by their places in both cameras and by the size
/// that balls have, as far as that is known (ball_fit.h), with the covariance that is left.
/// @return the balls sorted by colour, then by column; those whose outlines do not fit one ball, or of
///   which little is seen, are included, flagged, and not to be trusted; empty when no ball is seen by both
///   cameras
/// @throws std::invalid_argument when an image is empty, not CV_8UC3 or not of the rig's size, or when the
///   rig or the settings are not positive and finite
std::vector<BallObservation> observe(const StereoPair& pair, const StereoRig& rig,
                                     const ObserverSettings& settings);

/// What was seen, and what is known of the rig by then.
struct ObservedPair {
  std::vector<BallObservation> balls;
  RigWatch watch;
};

/// The same in pictures as they were taken, of a rig with faults: finds and measures in rectified pictures.
///
/// Rigs are off what is believed of them. Balls are matched within `rows_within_px`, by what this pair and
/// those before it tell of the rig (rig_search.h, rig_watch.h): that is undone, and covariances hold what is
/// not known of it.
/// @param watch what pairs before have told of the rig
/// @return balls as above, their centres those of the pictures as taken; the watch with this pair
/// @throws std::invalid_argument as above
ObservedPair observe(const StereoPair& pair, const Rectification& rectification,
                     const ObserverSettings& settings, const RigWatch& watch);

/// The same of a pair alone.
std::vector<BallObservation> observe(const StereoPair& pair, const Rectification& rectification,
                                     const ObserverSettings& settings);

}  // namespace stereobench::vision
