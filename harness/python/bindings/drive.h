/// A drive that Python takes step by step.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "harness/drive/detection_stage.h"
#include "harness/drive/recording.h"
#include "harness/drive/stereo_camera.h"
#include "harness/python/bindings/detector.h"
#include "harness/python/bindings/scenario.h"
#include "harness/run/seed_drive.h"

namespace stereobench::harness::bindings {

/// Who looked, as run.json says it.
inline constexpr const char* kOurDetector = "stereobench";
inline constexpr const char* kCallableDetector = "callable";

/// One seed of a scenario on its way: the same stages as record, in the hands of the caller.
class PyDrive {
 public:
  PyDrive(ScenarioPointer scenario, std::uint64_t seed);

  std::size_t steps() const { return world_part().path.size(); }
  const Experiment& experiment() const { return scenario_->experiment; }
  const worlds::Scenario& world_part() const { return experiment().scenario; }
  const worlds::World& world() const { return world_; }
  std::uint64_t seed() const { return seed_; }
  const DetectorSetup& setup() const { return setup_; }
  const ScenarioPointer& scenario() const { return scenario_; }

  /// The start that filters are told.
  slam::Pose start() const;
  const LogStep& log_step(std::size_t step) const { return log().steps[step]; }

  /// Takes the pair of a step. @return empty where there is none: the frame is lost, or the sensor an oracle
  std::optional<TakenPair> take(std::size_t step);

  /// Our detector's answer.
  std::vector<vision::BallObservation> observe(std::size_t step, const TakenPair& taken);

  /// What filters are given of a frame, which is also put into the drive's log.
  /// @param balls that were found in it; none without a picture
  /// @param detector who found them
  /// @throws std::runtime_error for a frame that is not later than all that were measured
  const std::vector<slam::RangeBearing>& measure(std::size_t step, const std::optional<TakenPair>& taken,
                                                 std::vector<vision::BallObservation> balls,
                                                 const std::string& detector);

  /// What both cameras see from a pose, without noise: BGR in linear light.
  renderer::StereoFrame render(const slam::Pose& world_from_robot);

  /// The least covariances that estimates can have.
  BoundRun bound() const;

  /// The drive's end: what was logged, some filters' runs, and what they are held against.
  SeedDrive ended(std::vector<FilterRun> runs) const;

 private:
  const MeasurementLog& log() const { return recording_.log; }
  MeasurementLog& log() { return recording_.log; }
  StereoCamera& camera();
  std::unique_lock<std::mutex> taken_by_this_thread();

  ScenarioPointer scenario_;
  std::uint64_t seed_;
  worlds::World world_;
  DetectorSetup setup_;
  Recording recording_;
  std::optional<DetectionStage> stage_;  ///< none of an oracle
  std::optional<StereoCamera> camera_;   ///< once something is rendered
  Detector ours_;                        ///< once it is asked
  std::size_t next_ = 0;                 ///< the first step that can be measured
  std::mutex mutex_;
};

using DrivePointer = std::shared_ptr<PyDrive>;

}  // namespace stereobench::harness::bindings
