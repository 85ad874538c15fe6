#include "harness/detector/detector.h"

#include <utility>

#include "renderer/camera/sensor_model.h"
#include "vision/observe.h"

namespace stereobench::harness {
namespace {

constexpr double kTypicalLevel = 128.0;  ///< at which detectors are told how large the camera's noise is

}  // namespace

vision::Levels levels_of(worlds::Encoding encoding) {
  return encoding == worlds::Encoding::kLinear ? vision::Levels::kLinear : vision::Levels::kSrgb;
}

DetectorSetup detector_setup(const worlds::Scenario& scenario) {
  return {.rig = scenario.believed_rig,
          .ball_radius_m = scenario.world.ball_radius_m(),
          .ball_radius_sd_m = scenario.world.ball_radius_sd_m,
          .rows_within_px = scenario.rows_within_px,
          .noise_sd_levels = renderer::noise_sd_levels(scenario.camera, kTypicalLevel),
          .encoding = scenario.camera.encoding,
          .gamma = scenario.camera.gamma};
}

Detector our_detector(const DetectorSetup& setup) {
  vision::ObserverSettings settings;
  settings.ball_radius_m = setup.ball_radius_m;
  settings.ball_radius_sd_m = setup.ball_radius_sd_m;
  settings.rows_within_px = setup.rows_within_px;
  settings.noise_sd_levels = setup.noise_sd_levels;
  const worlds::CameraSensor camera{.encoding = setup.encoding, .gamma = setup.gamma};
  const vision::CameraPair cameras = setup.cameras ? *setup.cameras : vision::cameras_of(setup.rig);
  std::optional<vision::ColourTable> learned;
  if (!setup.palette.empty()) learned = vision::table_of(setup.palette, levels_of(setup.encoding));
  return [settings, camera, learned, rectification = vision::Rectification(setup.rig, cameras),
          watch = vision::RigWatch{}](const DetectorInput& input) mutable {
    vision::ObserverSettings with_colours = settings;
    with_colours.learned = learned ? &*learned : nullptr;
    vision::StereoPair pair = input.pair;
    if (!learned)  // learned colours are found in levels as they are stored
      pair = {renderer::decode(input.pair.left, camera), renderer::decode(input.pair.right, camera)};
    vision::ObservedPair pair_seen = vision::observe(pair, rectification, with_colours, watch);
    watch = pair_seen.watch;
    return std::move(pair_seen.balls);
  };
}

}  // namespace stereobench::harness
