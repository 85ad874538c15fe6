/// A detector that is linked in: a run takes it as an argument.
#include <algorithm>

#include <gtest/gtest.h>

#include "harness/detector/detector.h"
#include "harness/drive/recording.h"
#include "harness/experiment/experiment.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

Experiment short_drive() {
  return read_experiment(scenario_path("ball_circle"),
                         {"path.laps=0.06", "rig.width_px=512", "rig.height_px=384", "rig.focal_px=443",
                          "believed_rig={baseline_m: 0.121}"});
}

// A callable that looks as ours does, and is wrong on purpose by what the score must then say. Mutations:
// ours is run all the same; the true rig is handed out; frames are counted from 1.
TEST(CallableDetector, IsAskedInPlaceOfOursAndScoredAlike) {
  constexpr double kOff_m = 0.25;
  const Experiment experiment = short_drive();
  const worlds::Scenario& scenario = experiment.scenario;
  const Detector ours = our_detector(detector_setup(scenario));
  std::vector<std::size_t> frames;
  std::vector<std::int64_t> stamps;
  std::vector<std::size_t> unnamed;  ///< balls of a frame without a colour, by which they would be known
  const Detector off = [&](const DetectorInput& input) {
    EXPECT_EQ(input.rig.baseline_m, 0.121);
    EXPECT_EQ(input.pair.left.size(), cv::Size(512, 384));
    frames.push_back(input.frame);
    stamps.push_back(input.stamp_ns);
    auto balls = ours(input);
    for (vision::BallObservation& ball : balls) ball.range_bearing.range_m += kOff_m;
    const auto whole =
        std::find_if(balls.begin(), balls.end(), [](const auto& ball) { return ball.trusted(); });
    unnamed.push_back(whole == balls.end() ? 0 : 1);
    if (whole != balls.end()) whole->colour = slam::kUnknown;
    return balls;
  };
  const Recording plain = record(experiment, 0, {});
  const Recording wrong = record(experiment, 0, {}, renderer::Backend::kSoftware, off);
  EXPECT_EQ(plain.detector, "stereobench");
  EXPECT_EQ(wrong.detector, "callable");
  ASSERT_EQ(frames.size(), scenario.path.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i], i);
    EXPECT_EQ(stamps[i], scenario.path[i].stamp_ns);
  }
  const auto& right = plain.vision->range_errors_m;
  ASSERT_GT(right.size(), 4U);
  ASSERT_EQ(wrong.vision->range_errors_m.size(), right.size());
  for (std::size_t i = 0; i < right.size(); ++i)
    EXPECT_NEAR(wrong.vision->range_errors_m[i], right[i] + kOff_m, 1e-12);
  for (std::size_t k = 0; k < frames.size(); ++k)
    EXPECT_EQ(wrong.log.steps[k].measurements.size() + unnamed[k], plain.log.steps[k].measurements.size());
}

}  // namespace
}  // namespace stereobench::harness
