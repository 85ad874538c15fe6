/// Single stereo pairs of a run, rendered again and shown to a detector.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/drive/recording.h"
#include "harness/experiment/types.h"
#include "harness/frame_replay/frame_name.h"
#include "harness/frame_replay/invocation.h"
#include "harness/vision_scoring/frame_match.h"
#include "renderer/surfaces/mesh_cache.h"
#include "renderer/types.h"
#include "vision/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// A pair, what it shows, and what a detector made of it.
struct ReplayedFrame {
  FrameName name;
  worlds::World world;    ///< of the seed
  vision::StereoRig rig;  ///< the true one
  worlds::CameraSensor camera;
  vision::StereoPair pair;      ///< as the camera stored it
  renderer::StereoFrame truth;  ///< the light before the camera, and what each pixel shows
  std::vector<vision::BallObservation> observations;
  FrameMatch match;
  std::string rows;  ///< its lines of detections.csv
};

/// @throws std::runtime_error where the sensor has no pictures, or the drive has no such step
void require_frame(const worlds::Scenario& scenario, const FrameName& frame);

/// @throws std::runtime_error that says that the shutter drops a frame
[[noreturn]] void refuse_dropped(const FrameName& frame);

/// The experiment that a result is of, as read_experiment reads it. Its detector is called from the folder
/// from which the run called it, as long as that is there.
/// @param meshes outlives what is done with the experiment
/// @throws std::runtime_error as read_experiment
Experiment experiment_of(const Invocation& invocation, renderer::MeshCache& meshes);

/// Renders single frames as `run` does and shows them to the experiment's detector, frames of one seed in the
/// order of their steps. Pictures do not depend on other frames. A detector with a memory (ours keeps what it
/// has learnt about a rig with faults) may answer as in the run only where it is shown the frames before.
/// @param with_before show the detector all frames before, too
/// @return in the order of seed and step, each once
/// @throws std::runtime_error where the sensor has no pictures, the drive has no such step, the shutter drops
///   it, and as record
std::vector<ReplayedFrame> replay_frames(const Experiment& experiment, std::span<const FrameName> frames,
                                         renderer::Backend backend, renderer::MeshCache& meshes,
                                         bool with_before = false);

/// The same of a result.
std::vector<ReplayedFrame> replay_frames(const Invocation& invocation, std::span<const FrameName> frames,
                                         bool with_before = false);

}  // namespace stereobench::harness
