/// What was seen on a drive stands in for its pictures: all stages behind the detector give the same, to the
/// last bit.
#include "harness/drive/seen_drive.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

const std::vector<std::string> kSmall = {"path.laps=0.2",          "rig.width_px=512",
                                         "rig.height_px=384",      "rig.focal_px=443",
                                         "placement_jitter_m=0.1", "shutter={drop_probability: 0.2}"};

Experiment experiment_with(const std::vector<std::string>& overrides) {
  return read_experiment(scenario_path("ball_circle"), with(kSmall, overrides));
}

std::string text_of_log(const MeasurementLog& log) {
  std::string text;
  for (const LogStep& step : log.steps) {
    for (const slam::Control& control : step.odometry) text += fmt::format("{} ", control.v_mps);
    for (std::size_t i = 0; i < step.measurements.size(); ++i) {
      const slam::RangeBearing& seen = step.measurements[i];
      text += fmt::format("{} {} {} {} {} {} {}\n", step.stamp_ns, step.true_landmarks.at(i), seen.range_m,
                          seen.bearing_rad, seen.covariance(0, 1), seen.landmark_id, seen.colour_class);
    }
  }
  return text;
}

void expect_same(const Recording& replayed, const Recording& recorded) {
  EXPECT_EQ(text_of_log(replayed.log), text_of_log(recorded.log));
  EXPECT_EQ(replayed.vision->range_errors_m, recorded.vision->range_errors_m);
  EXPECT_EQ(replayed.vision->recall(), recorded.vision->recall());
  EXPECT_EQ(replayed.vision->spurious, recorded.vision->spurious);
  EXPECT_EQ(replayed.faults, recorded.faults);
  EXPECT_EQ(replayed.detector, recorded.detector);
}

// Mutations: faults put in twice; outlines of another frame; the odometry of another seed; a member that is
// not written.
TEST(SeenDrive, GivesWhatTheDriveGives) {
  const StreamSeeds seeds(5);
  const Experiment plain = experiment_with({});
  const SeenDrive seen = see_together({&plain}, seeds, renderer::Backend::kSoftware, [](double) {}).front();
  const SeenDrive kept = seen_drive_from_bytes(to_bytes(seen));
  ASSERT_GT(kept.frames.size(), 4U);
  for (const std::vector<std::string>& behind : std::vector<std::vector<std::string>>{
           {},
           {"detector_noise={centre_sd_px: 0.7, miss_probability: 0.2, false_per_frame: 0.5}"},
           {"detector_noise={latency_frames: 2, identity_swap_probability: 0.3}"},
           {"perfect_detections={places: true, names: true}"},
           {"odometry_noise.v_per_v=0.3"}}) {
    const Experiment experiment = experiment_with(behind);
    expect_same(recording_of(experiment, seeds, kept), record(experiment, seeds, {}));
  }
}

// What is kept is what the detector itself answered, whoever looked first. Mutations: faults, or the truth,
// in what is kept.
TEST(SeenDrive, KeepsTheDetectorsOwnAnswers) {
  const StreamSeeds seeds(5);
  const Experiment perfect = experiment_with(
      {"perfect_detections={places: true, names: true}", "detector_noise={miss_probability: 0.5}"});
  const SeenDrive seen = see_together({&perfect}, seeds, renderer::Backend::kSoftware, [](double) {}).front();
  const Experiment plain = experiment_with({});
  expect_same(recording_of(plain, seeds, seen), record(plain, seeds, {}));
}

// Mutations: the first experiment's rig, or its detector, for all.
TEST(SeenDrive, ShowsTheSamePicturesToSeveral) {
  const StreamSeeds seeds(5);
  const Experiment plain = experiment_with({"detector_noise={centre_sd_px: 1}"});
  const Experiment wrong = experiment_with({"believed_rig={baseline_m: 0.13}"});
  const auto seen = see_together({&plain, &wrong}, seeds, renderer::Backend::kSoftware, [](double) {});
  ASSERT_EQ(seen.size(), 2U);
  expect_same(recording_of(plain, seeds, seen[0]), record(plain, seeds, {}));
  expect_same(recording_of(wrong, seeds, seen[1]), record(wrong, seeds, {}));
  EXPECT_NE(text_of_log(recording_of(wrong, seeds, seen[1]).log),
            text_of_log(recording_of(plain, seeds, seen[0]).log));
}

// Each part of a drive has a seed of its own. Mutations: two parts that swap theirs.
TEST(SeenDrive, DependsOnTheSeedOfEachPart) {
  const Experiment experiment = experiment_with({"detector_noise={centre_sd_px: 0.3}"});
  const auto log_with = [&](const StreamSeeds& seeds) { return record(experiment, seeds, {}).log; };
  const MeasurementLog one = log_with(5);
  StreamSeeds other_world(5), other_odometry(5), other_sensor(5), other_filter(5);
  other_world.world = other_odometry.odometry = other_sensor.sensor = other_filter.filter = 6;
  const MeasurementLog world = log_with(other_world);
  const MeasurementLog odometry = log_with(other_odometry);
  const MeasurementLog sensor = log_with(other_sensor);
  const auto first_speed = [](const MeasurementLog& log) { return log.steps.at(3).odometry.at(0).v_mps; };
  EXPECT_NE(world.landmarks[0].position_m, one.landmarks[0].position_m);
  EXPECT_EQ(first_speed(world), first_speed(one));
  EXPECT_EQ(odometry.landmarks[0].position_m, one.landmarks[0].position_m);
  EXPECT_NE(first_speed(odometry), first_speed(one));
  EXPECT_EQ(sensor.landmarks[0].position_m, one.landmarks[0].position_m);
  EXPECT_EQ(first_speed(sensor), first_speed(one));
  EXPECT_NE(text_of_log(sensor), text_of_log(one));
  EXPECT_EQ(text_of_log(log_with(other_filter)), text_of_log(one));
}

}  // namespace
}  // namespace stereobench::harness
