/// Detections as a perfect detector would have given them: an oracle in place of a part of the chain.
///
/// What a detection states of its covariance stays as it was, faults included: filters weigh it as before.
#pragma once

#include <span>
#include <vector>

#include "harness/detector_faults/detection.h"
#include "harness/experiment/types.h"
#include "harness/vision_scoring/frame_match.h"

namespace stereobench::harness {

/// Gives each observation that is of a ball the ball's colour. @param match of the observations
void give_true_names(const worlds::World& world, const FrameMatch& match,
                     std::vector<vision::BallObservation>& observations);

/// Puts each detection where its ball's true centres are in both pictures, and to the place that these have
/// in the rig as it is believed to be. Detections of nothing and second ones of a ball are left out. Balls
/// that are seen whole and were missed are added, with the covariance of a detector that says nothing
/// (kUnstatedSd_px).
/// @param outlines of the balls at the frame's time
std::vector<TracedDetection> at_true_places(const worlds::Scenario& scenario, const worlds::World& world,
                                            std::span<const BallInPair> outlines,
                                            std::span<const TracedDetection> detections);

/// Gives what the oracle sensed its true ranges and bearings.
void put_at_true_places(const worlds::World& world, const slam::Pose& world_from_robot,
                        std::vector<TracedDetection>& detections);

/// A detector's faults without those that perfect detections have not: losses and detections of nothing,
/// wrong names. Errors of places stay, for what is stated of them.
DetectorFaults without_perfect(const PerfectDetections& perfect, const DetectorFaults& faults);

}  // namespace stereobench::harness
