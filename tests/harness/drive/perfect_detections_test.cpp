/// Oracles in place of a detector: places and names from the truth, whatever was found.
#include "harness/drive/perfect_detections.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "harness/drive/recording.h"
#include "harness/experiment/experiment.h"
#include "slam/models/measurement.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

const std::vector<std::string> kDrive = {"path.laps=0.12",           "rig.width_px=512",
                                         "rig.height_px=384",        "rig.focal_px=443",
                                         "camera.noise_sd_levels=6", "world.ball_radius_sd_m=0"};

Recording recorded(const std::vector<std::string>& overrides, const Detector& detector = {}) {
  const Experiment experiment = read_experiment(scenario_path("ball_circle"), with(kDrive, overrides));
  return record(experiment, 3, {}, renderer::Backend::kSoftware, detector);
}

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<vision::BallObservation> see_nothing(const DetectorInput&) {
  return {};
}

// Mutations: places of the detector; the believed rig's outlines; missed balls left out.
TEST(PerfectDetections, AreWhereTheBallsAre) {
  const VisionScore found = *recorded({}).vision;
  const VisionScore perfect = *recorded({"perfect_detections={places: true}"}).vision;
  EXPECT_GT(rms(found.range_errors_m), 1e-3);
  EXPECT_LT(rms(perfect.range_errors_m), 1e-9);
  EXPECT_LT(rms(perfect.bearing_errors_rad), 1e-9);
  EXPECT_EQ(perfect.recall(), 1.0);
  EXPECT_EQ(perfect.spurious, 0);
  const VisionScore of_nothing = *recorded({"perfect_detections={places: true}"}, see_nothing).vision;
  EXPECT_EQ(of_nothing.recall(), 1.0);
  EXPECT_LT(rms(of_nothing.range_errors_m), 1e-9);
}

// A perfect detector sees true centres through the rig as it is believed to be: a baseline that is 1 % long
// makes ranges 1 % long. Mutation: the true rig in place of the believed one.
TEST(PerfectDetections, AreSeenThroughTheBelievedRig) {
  const VisionScore score =
      *recorded({"perfect_detections={places: true}", "believed_rig={baseline_m: 0.1212}"}).vision;
  ASSERT_GT(score.range_errors_m.size(), 10U);
  for (const double error_m : score.range_errors_m) {
    EXPECT_GT(error_m, 0.005);
    EXPECT_LT(error_m, 0.05);
  }
}

// Faults of places give way to perfect places, those of names to perfect names. Mutations: each fault kept.
TEST(PerfectDetections, HaveNoFaultsOfTheirKind) {
  const char* faults =
      "detector_noise={centre_sd_px: 2, miss_probability: 0.5, false_per_frame: 2, "
      "identity_swap_probability: 0.5}";
  const VisionScore places = *recorded({faults, "perfect_detections={places: true}"}).vision;
  EXPECT_LT(rms(places.range_errors_m), 1e-9);
  EXPECT_EQ(places.spurious, 0);
  EXPECT_GT(places.misidentified, 0);
  const Recording named = recorded({faults, "perfect_detections={names: true}"});
  EXPECT_EQ(named.vision->misidentified, 0);
  EXPECT_LT(named.vision->recall(), 0.9);
  EXPECT_GT(named.vision->spurious, 0);
}

// Filters are told whose a sighting is, also where nothing else could tell. Mutations: colours alone; false
// detections that are told a landmark.
TEST(PerfectDetections, TellFiltersTheLandmark) {
  const MeasurementLog log =
      recorded({"identity=none", "perfect_detections={names: true}", "detector_noise={false_per_frame: 1}"})
          .log;
  std::set<int> told;
  long of_nothing = 0;
  for (const LogStep& step : log.steps)
    for (std::size_t i = 0; i < step.measurements.size(); ++i) {
      EXPECT_EQ(step.measurements[i].landmark_id, step.true_landmarks[i]);
      told.insert(step.true_landmarks[i]);
      if (step.true_landmarks[i] == slam::kUnknown) ++of_nothing;
    }
  EXPECT_GT(told.size(), 2U);
  EXPECT_GT(of_nothing, 3);
}

// What filters are told of a detection stays: the bound is that of the detector with its faults. Mutations:
// the covariance of a perfect centre; faults that state nothing any more.
TEST(PerfectDetections, StateWhatTheyStatedBefore) {
  const auto stated = [](const std::vector<std::string>& overrides) {
    std::map<std::pair<std::size_t, int>, double> variances;
    const MeasurementLog log = recorded(overrides).log;
    for (std::size_t step = 0; step < log.steps.size(); ++step)
      for (std::size_t i = 0; i < log.steps[step].measurements.size(); ++i)
        variances[{step, log.steps[step].true_landmarks[i]}] =
            log.steps[step].measurements[i].covariance(0, 0);
    return variances;
  };
  const std::string faults = "detector_noise={centre_sd_px: 1, covariance_scale: 2}";
  const auto before = stated({faults});
  const auto after = stated({faults, "perfect_detections={places: true}"});
  ASSERT_GT(before.size(), 10U);
  for (const auto& [sighting, variance] : before) EXPECT_EQ(after.at(sighting), variance);
}

// The oracle's are exact, none is lost or false, and they state what they stated. Mutations: each.
TEST(PerfectDetections, OfTheOracleAreExact) {
  const auto log_with = [](const std::vector<std::string>& overrides) {
    return record(read_experiment(scenario_path("open_field"), overrides), 3, {}).log;
  };
  const MeasurementLog log = log_with({"oracle.miss_probability=0.3", "oracle.false_per_look=1",
                                       "detector_noise={range_scale: 1.1, miss_probability: 0.3}",
                                       "perfect_detections={places: true}"});
  const MeasurementLog plain = log_with({});
  for (std::size_t step = 0; step < log.steps.size(); ++step) {
    ASSERT_EQ(log.steps[step].true_landmarks, plain.steps[step].true_landmarks);
    for (std::size_t i = 0; i < log.steps[step].measurements.size(); ++i) {
      const auto ball = static_cast<std::size_t>(log.steps[step].true_landmarks[i]);
      const Eigen::Vector2d truth =
          slam::predict_sighting(*log.steps[step].truth, log.landmarks[ball].position_m);
      EXPECT_EQ(log.steps[step].measurements[i].range_m, truth.x());
      EXPECT_EQ(log.steps[step].measurements[i].covariance, plain.steps[step].measurements[i].covariance);
    }
  }
}

}  // namespace
}  // namespace stereobench::harness
