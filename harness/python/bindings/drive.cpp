#include "harness/python/bindings/drive.h"

#include <stdexcept>

#include <fmt/format.h>

#include "harness/drive/drive_log.h"
#include "harness/experiment/filter_config.h"
#include "harness/scoring/references.h"
#include "harness/vision_scoring/ball_outline.h"
#include "renderer/camera/expose.h"
#include "worlds/scenario/scenario.h"

namespace stereobench::harness::bindings {

PyDrive::PyDrive(ScenarioPointer scenario, std::uint64_t seed)
    : scenario_(std::move(scenario)),
      seed_(seed),
      world_(worlds::world_for_seed(world_part(), seed)),
      setup_(detector_setup(world_part())) {
  if (world_part().sensor == worlds::SensorKind::kOracle) {
    recording_ = record(experiment(), seed_, {});
    return;
  }
  log() = log_without_sightings(world_part(), world_, seed_);
  recording_.detector = kOurDetector;
  stage_.emplace(experiment(), world_, seed_);
}

std::unique_lock<std::mutex> PyDrive::taken_by_this_thread() {
  std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock) throw std::runtime_error("a drive is used by another thread: each thread needs one of its own");
  return lock;
}

slam::Pose PyDrive::start() const {
  return told_start(log().start, world_part().start_noise, seed_);
}

StereoCamera& PyDrive::camera() {
  if (!camera_)
    camera_.emplace(world_part(), world_, seed_, scenario_->arguments.backend,
                    renderer::light_for(world_part().camera));
  return *camera_;
}

std::optional<TakenPair> PyDrive::take(std::size_t step) {
  const auto lock = taken_by_this_thread();
  if (!stage_) return {};
  return camera().take(step, recording_.timing);
}

renderer::StereoFrame PyDrive::render(const slam::Pose& world_from_robot) {
  const auto lock = taken_by_this_thread();
  return camera().renderer().render(world_from_robot);
}

std::vector<vision::BallObservation> PyDrive::observe(std::size_t step, const TakenPair& taken) {
  const auto lock = taken_by_this_thread();
  if (!ours_) ours_ = our_detector(setup_);
  return ours_({step, world_part().path[step].stamp_ns, taken.pair, world_part().believed_rig});
}

const std::vector<slam::RangeBearing>& PyDrive::measure(std::size_t step,
                                                        const std::optional<TakenPair>& taken,
                                                        std::vector<vision::BallObservation> balls,
                                                        const std::string& detector) {
  const auto lock = taken_by_this_thread();
  if (step < next_)
    throw std::runtime_error(
        fmt::format("frame {}: expected a frame after the last one that was measured, {}", step, next_ - 1));
  if (!balls.empty() && !taken)
    throw std::runtime_error(fmt::format("frame {}: expected no balls: there is no picture", step));
  next_ = step + 1;
  LogStep& logged = log().steps[step];
  if (!taken) return logged.measurements;
  recording_.detector = detector;
  const VisionTruth truth{world_, world_part().rig, world_part().path[step].pose, taken->exposed.frame};
  const ArrivedDetections arrived = stage_->arriving(step, ball_outlines(truth), std::move(balls));
  recording_.blur.add(taken->exposed.blur_step_px);
  Sightings seen = stage_->take(arrived);
  logged.measurements = std::move(seen.measurements);
  logged.true_landmarks = std::move(seen.balls);
  return logged.measurements;
}

BoundRun PyDrive::bound() const {
  return replay_bound(log(), world_part().path, world_part().odometry_noise,
                      start_covariance(world_part().start_noise));
}

SeedDrive PyDrive::ended(std::vector<FilterRun> runs) const {
  SeedDrive drive{.seed = seed_, .recording = recording_, .runs = std::move(runs)};
  if (stage_) {
    drive.recording.vision = stage_->score();
    drive.recording.faults = stage_->fault_counts();
  }
  drive.references.bound = bound();
  drive.recording.log.start = start();
  drive.references.batch = replay_batch(drive.recording.log, filter_config(experiment()));
  return drive;
}

}  // namespace stereobench::harness::bindings
