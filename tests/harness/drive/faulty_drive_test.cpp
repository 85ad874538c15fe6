/// Faults of detectors in a drive: any detector has them, the oracle too, and one without faults is the same
/// to the last bit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness/detector/detection_lines.h"
#include "harness/drive/recording.h"
#include "harness/experiment/experiment.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

/// What listeners are told, and the log.
struct Seen {
  std::vector<std::string> lines;  ///< of detections, one a frame
  Recording recording;
};

Seen seen_on(const std::string& scenario, std::vector<std::string> overrides, const Detector& detector = {}) {
  const Experiment experiment = read_experiment(scenario_path(scenario), overrides);
  Seen seen;
  Listeners listeners;
  listeners.on_frame = [&](const FrameEvent& event) {
    seen.lines.push_back(detections_line(event.step, event.observations));
  };
  seen.recording = record(experiment, 3, listeners, renderer::Backend::kSoftware, detector);
  return seen;
}

const std::vector<std::string> kShort = {"path.laps=0.12", "rig.width_px=512", "rig.height_px=384",
                                         "rig.focal_px=443"};

std::string sightings_of_log(const MeasurementLog& log) {
  std::string text;
  for (const LogStep& step : log.steps)
    for (std::size_t i = 0; i < step.measurements.size(); ++i) {
      const slam::RangeBearing& seen = step.measurements[i];
      text += fmt::format("{} {} {} {} {} {} {}\n", step.stamp_ns, step.true_landmarks.at(i), seen.range_m,
                          seen.bearing_rad, seen.covariance(0, 0), seen.landmark_id, seen.colour_class);
    }
  return text;
}

// Mutations: detections that are put together anew; a draw that others share.
TEST(FaultyDrive, WithoutFaultsIsTheSame) {
  const Seen without = seen_on("ball_circle", kShort);
  const Seen with_none = seen_on("ball_circle", with(kShort, {"detector_noise={}"}));
  EXPECT_GT(without.lines.size(), 3U);
  EXPECT_EQ(with_none.lines, without.lines);
  EXPECT_EQ(sightings_of_log(with_none.recording.log), sightings_of_log(without.recording.log));
  EXPECT_EQ(with_none.recording.vision->range_errors_m, without.recording.vision->range_errors_m);
  EXPECT_EQ(without.recording.faults, std::nullopt);
  EXPECT_EQ(with_none.recording.faults, FaultCounts{});
  const Seen oracle = seen_on("open_field", {});
  const Seen oracle_with_none = seen_on("open_field", {"detector_noise={}"});
  EXPECT_NE(sightings_of_log(oracle.recording.log), "");
  EXPECT_EQ(sightings_of_log(oracle_with_none.recording.log), sightings_of_log(oracle.recording.log));
}

// A detector that is linked in has them as ours has. Mutations: ours alone; the score and the log of what the
// detector gave; sightings that lose their ball where their pixels leave it.
TEST(FaultyDrive, IsScoredAndLoggedAsTheDetectionsArrive) {
  const Detector ours = [&] {
    const Experiment experiment = read_experiment(scenario_path("ball_circle"), kShort);
    return our_detector(detector_setup(experiment.scenario));
  }();
  const auto with_bias = with(kShort, {"detector_noise={centre_bias_px: [[0, 120], [0, 120]]}"});
  const Seen right = seen_on("ball_circle", kShort);
  const Seen wrong = seen_on("ball_circle", with_bias, ours);
  EXPECT_EQ(wrong.lines, seen_on("ball_circle", with_bias).lines);
  EXPECT_GT(right.recording.vision->right, 0);
  EXPECT_EQ(wrong.recording.vision->right, 0);
  EXPECT_EQ(wrong.recording.vision->spurious, wrong.recording.vision->observations);
  ASSERT_EQ(wrong.recording.log.steps.size(), right.recording.log.steps.size());
  for (std::size_t i = 0; i < right.recording.log.steps.size(); ++i)
    EXPECT_EQ(wrong.recording.log.steps[i].true_landmarks, right.recording.log.steps[i].true_landmarks);
  EXPECT_GT(wrong.recording.faults->moved, 0);
}

// A step that is looked at alone has what it has in the whole drive, and nobody is told of those that are
// looked at for that. Mutations: only steps that are wanted are taken; listeners told of all that is taken.
TEST(FaultyDrive, ShowsLateDetectionsOfASingleStep) {
  const auto overrides = with(kShort, {"detector_noise={latency_frames: 2, centre_sd_px: 0.5}"});
  const Seen whole = seen_on("ball_circle", overrides);
  const Experiment experiment = read_experiment(scenario_path("ball_circle"), overrides);
  std::vector<std::string> lines;
  Listeners listeners;
  listeners.is_wanted = [](std::size_t step) { return step == 3; };
  listeners.on_frame = [&](const FrameEvent& event) {
    lines.push_back(detections_line(event.step, event.observations));
  };
  const Recording single = record(experiment, 3, listeners);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], whole.lines.at(3));
  EXPECT_NE(lines[0], detections_line(3, {}));
  EXPECT_EQ(single.faults->delayed, static_cast<long>(single.vision->observations + single.vision->flagged));
}

// Mutation: the oracle's sightings without faults.
TEST(FaultyDrive, OfTheOracleComesLate) {
  const std::vector<std::string> field = {};
  const Seen prompt = seen_on("open_field", field);
  const Seen late = seen_on("open_field", with(field, {"detector_noise.latency_frames=2"}));
  const std::vector<LogStep>& before = prompt.recording.log.steps;
  const std::vector<LogStep>& after = late.recording.log.steps;
  ASSERT_GT(after.size(), 4U);
  for (std::size_t i = 0; i < after.size(); ++i) {
    const LogStep look = i < 2 ? LogStep{} : before[i - 2];
    ASSERT_EQ(after[i].measurements.size(), look.measurements.size()) << i;
    EXPECT_EQ(after[i].true_landmarks, look.true_landmarks);
    for (std::size_t k = 0; k < look.measurements.size(); ++k)
      EXPECT_EQ(after[i].measurements[k].range_m, look.measurements[k].range_m);
  }
}

}  // namespace
}  // namespace stereobench::harness
