/// A drive through a scenario, from the world to the log that filters are replayed on.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/detector/detector.h"
#include "harness/detector_faults/fault_counts.h"
#include "harness/drive/coarse_blur.h"
#include "harness/drive/stream_seeds.h"
#include "harness/experiment/types.h"
#include "harness/types.h"
#include "harness/vision_scoring/vision_score.h"
#include "renderer/renderer.h"
#include "renderer/types.h"
#include "worlds/types.h"

namespace stereobench::harness {

/// Wall-clock seconds a stage took; reported beside results, never inside what is compared.
using Timing = std::map<std::string, double>;

/// A frame of the drive: the truth, the exposed pair, and what was detected in it.
struct FrameEvent {
  std::size_t step;
  std::int64_t stamp_ns = 0;
  slam::Pose world_from_robot;  ///< at the step's time
  const renderer::StereoFrame& frame;
  const vision::StereoPair& pair;
  const std::vector<vision::BallObservation>& observations;
  const FrameMatch& match;
  const worlds::World& world;              ///< of the seed
  const vision::StereoRig& rig;            ///< the true one
  double late_s = 0.0;                     ///< by how much the cameras looked later than the step's time says
  renderer::Renderer* renderer = nullptr;  ///< that made the pictures, for those who want more of the truth
};

/// Who wants to be told while a drive goes on, and of which steps.
struct Listeners {
  /// Whether the cameras open at a step (sensors with pixels only). At others nothing is rendered or seen,
  /// but for what arrives late at this one; what is seen here does not depend on it, unless a detector has a
  /// memory.
  std::function<bool(std::size_t)> is_wanted = [](std::size_t) { return true; };
  std::function<void(const FrameEvent&)> on_frame = [](const FrameEvent&) {};
  std::function<void(double)> on_progress = [](double) {};  ///< fraction done, in [0, 1]
  bool wants_fine_light = false;  ///< a frame's light has 16 bits, also where the camera needs but 8
};

/// What one seed's drive gave.
struct Recording {
  MeasurementLog log;
  std::string detector = "none";      ///< who looked: "stereobench", a program's command, "callable"
  std::optional<VisionScore> vision;  ///< empty for a sensor without pixels
  std::optional<FaultCounts> faults;  ///< of the detector; empty where the experiment names none
  CoarseBlur blur;
  Timing timing;
};

/// Somebody who looks at the pictures of a drive.
struct Onlooker {
  const Experiment* experiment = nullptr;
  Listeners listeners = {};
  Detector detector = {};  ///< empty: the program that the experiment names, or the vision stage
};

/// What an onlooker has of a drive.
struct OnlookerResult {
  Recording recording;
  std::exception_ptr fault;  ///< of the onlooker's program, a DetectorFault: there is no recording
};

/// Drives through a scenario once for several onlookers: each pair is rendered and exposed once, and shown to
/// each.
/// @param onlookers at least one; their scenarios have the same world, path, cameras, exposure and shutter.
/// What each sees does not depend on the others. Progress is told to the first
/// @param seeds of the world, the odometry and the sensor
/// @param backend what renders, for a sensor with pixels
/// @param read meshes
/// @return one result an onlooker: the log with truth, and how vision scored
/// @throws std::runtime_error when this machine has no such back end or a mesh cannot be read
std::vector<OnlookerResult> record_together(const std::vector<Onlooker>& onlookers, const StreamSeeds& seeds,
                                            renderer::Backend backend = renderer::Backend::kSoftware,
                                            const renderer::FormReader& read = renderer::read_form);

/// Drives through a scenario once: at each step of the path the world is rendered, exposed, observed (or
/// sensed by the oracle), and the odometry is measured with its noise.
/// @param listeners told of each look (sensors with pixels only) and of the progress
/// @param detector who looks at the pairs; empty: the program that the experiment names, or the vision stage
/// @return the log with truth, and how vision scored
/// @throws std::runtime_error as record_together; DetectorFault when the program does not do what it should
Recording record(const Experiment& experiment, const StreamSeeds& seeds, const Listeners& listeners,
                 renderer::Backend backend = renderer::Backend::kSoftware, const Detector& detector = {},
                 const renderer::FormReader& read = renderer::read_form);

}  // namespace stereobench::harness
