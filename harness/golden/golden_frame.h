/// Golden frames: what a run's cameras saw once, kept to be compared with what they see now.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <opencv2/core.hpp>

#include "harness/experiment/types.h"
#include "harness/frame_replay/frame_name.h"
#include "renderer/surfaces/mesh_cache.h"
#include "renderer/types.h"

namespace stereobench::harness {

/// A golden picture is at most so wide: small enough to be kept in git.
inline constexpr int kGoldenWidth_px = 256;

/// One camera's part of a golden frame.
struct GoldenPicture {
  /// Of the pixels that the detector is shown, in full size, with the sensor's noise: SHA-256.
  std::string seen_sha256;
  cv::Mat colour;  ///< CV_8UC3, BGR, as the camera stores it, without noise, of a rig with fewer pixels
  cv::Mat shown;   ///< CV_16UC1, of the same size: number of the surface that each pixel shows (primitives.h)
};

/// A stereo pair to be kept.
struct GoldenFrame {
  FrameName name;
  int smaller = 1;     ///< a golden picture has a pixel for so many of the camera's in a row
  int first_mesh = 0;  ///< number of the first surface that is a mesh; before it come balls, floor and walls
  bool is_linear = true;  ///< whether levels are linear light
  GoldenPicture left, right;
};

/// The rig with so many times fewer pixels in each direction that its pictures are at most kGoldenWidth_px
/// wide, which looks at the same scene.
/// @return how many times fewer; 1 leaves the rig as it is
int make_smaller(vision::StereoRig& rig);

/// SHA-256 of a picture's size, type and pixels.
std::string pixels_sha256(const cv::Mat& picture);

/// Renders a frame of a run twice: as the detector is shown it, of which the hash is kept, and in a small rig
/// without noise.
/// @param meshes of the experiment
/// @throws std::runtime_error where the frame has no pictures (replay_frames), where a rolling shutter is
///   behind a lens that distorts, so that no pixel's surface is known, or when a mesh cannot be read
GoldenFrame render_golden(const Experiment& experiment, const FrameName& frame, renderer::Backend backend,
                          renderer::MeshCache& meshes);

}  // namespace stereobench::harness
