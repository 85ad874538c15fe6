#include "harness/drive/seen_drive.h"

#include <utility>

#include "harness/drive/detection_stage.h"
#include "harness/drive/drive_log.h"
#include "harness/json/cbor.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::slam {
STEREOBENCH_ALL_FIELDS(RangeBearing, range_m, bearing_rad, covariance, landmark_id, colour_class, sd_scale)
}  // namespace stereobench::slam

namespace stereobench::vision {
STEREOBENCH_ALL_FIELDS(OutlineEllipse, centre_px, semi_major_px, semi_minor_px, angle_rad)
STEREOBENCH_ALL_FIELDS(BallObservation, colour, left_px, right_px, left_radius_px, right_radius_px, has_radii,
                       has_pixels, ball_in_camera, range_bearing, truncated, occluded)
}  // namespace stereobench::vision

namespace stereobench::harness {
STEREOBENCH_ALL_FIELDS(CoarseBlur, pairs, most_step_px)
STEREOBENCH_ALL_FIELDS(BallInPair, ball, ball_in_robot, left, right, left_fraction, right_fraction,
                       inside_both)
STEREOBENCH_ALL_FIELDS(SeenFrame, step, outlines, observations)
STEREOBENCH_ALL_FIELDS(SeenDrive, detector, blur, frames, timing)

std::vector<SeenDrive> see_together(const std::vector<const Experiment*>& experiments,
                                    const StreamSeeds& seeds, renderer::Backend backend,
                                    const std::function<void(double)>& on_progress) {
  std::vector<Experiment> without_faults;
  for (const Experiment* experiment : experiments) {
    without_faults.push_back(*experiment);
    without_faults.back().detector_noise.reset();
    without_faults.back().perfect_detections = {};
  }
  std::vector<SeenDrive> seen(experiments.size());
  std::vector<Onlooker> onlookers;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    onlookers.push_back({.experiment = &without_faults[i]});
    onlookers.back().listeners.on_progress = on_progress;
    onlookers.back().listeners.on_frame = [&frames = seen[i].frames](const FrameEvent& event) {
      frames.push_back({event.step, event.match.outlines, event.observations});
    };
  }
  std::vector<OnlookerResult> results = record_together(onlookers, seeds, backend);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].fault) std::rethrow_exception(results[i].fault);
    seen[i].detector = results[i].recording.detector;
    seen[i].blur = results[i].recording.blur;
    seen[i].timing = std::move(results[i].recording.timing);
  }
  return seen;
}

Recording recording_of(const Experiment& experiment, const StreamSeeds& seeds, const SeenDrive& seen) {
  const worlds::World world = worlds::world_for_seed(experiment.scenario, seeds.world);
  DetectionStage stage(experiment, world, seeds.sensor);
  Recording recording{.log = log_without_sightings(experiment.scenario, world, seeds.odometry),
                      .detector = seen.detector,
                      .blur = seen.blur};
  for (const SeenFrame& frame : seen.frames) {
    Sightings sightings = stage.take(stage.arriving(frame.step, frame.outlines, frame.observations));
    recording.log.steps[frame.step].measurements = std::move(sightings.measurements);
    recording.log.steps[frame.step].true_landmarks = std::move(sightings.balls);
  }
  recording.vision = stage.score();
  recording.faults = stage.fault_counts();
  return recording;
}

std::string to_bytes(const SeenDrive& seen) {
  return bytes_of(nlohmann::json(seen));
}

SeenDrive seen_drive_from_bytes(std::string_view bytes) {
  return json_of(bytes).get<SeenDrive>();
}

}  // namespace stereobench::harness
