/// What was asked of losses, ranges, detections of nothing and latency, measured from the detections alone.
/// Bounds are 99 % intervals of the sample size; seeds are pinned.
#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "harness/detector/detection_lines.h"
#include "harness/detector_faults/misses.h"
#include "tests/harness/detector_faults/made_up_drive.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using worlds::Identity;
using worlds::SensorKind;

/// The (frame, ball) that are there.
std::set<std::pair<std::size_t, int>> seen_in(const Arrived& frames) {
  std::set<std::pair<std::size_t, int>> seen;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (const TracedDetection& detection : frames[i]) seen.emplace(i, detection.ball);
  return seen;
}

long count_of(const Arrived& frames, int ball) {
  long count = 0;
  for (const auto& detections : frames)
    for (const TracedDetection& detection : detections) count += detection.ball == ball ? 1 : 0;
  return count;
}

// Mutations: a loss counted and not made; the same draw for all balls of a frame.
TEST(FaultyDetector, LosesTheShareThatIsAsked) {
  const MadeUpDrive drive = made_up_drive(5000);
  DetectorFaults faults;
  faults.miss_probability = 0.15;
  const FaultyDrive faulty = drive_with(faults, drive);
  long lost = 0, frames_without_two = 0;
  for (const auto& detections : faulty.frames) {
    std::set<int> balls;
    for (const TracedDetection& detection : detections) balls.insert(detection.ball);
    lost += 4 - static_cast<long>(balls.size());
    frames_without_two += !balls.contains(0) && !balls.contains(1) ? 1 : 0;
  }
  EXPECT_TRUE(is_share(lost, 20000, 0.15)) << lost;
  EXPECT_TRUE(is_share(frames_without_two, 5000, 0.15 * 0.15)) << frames_without_two;
  EXPECT_EQ(faulty.counts, (FaultCounts{.lost = lost}));
}

// Mutations: range and visible fraction swapped; no interpolation; reasons that are added up; what is of no
// ball taken for hidden.
TEST(FaultyDetector, LosesByRangeAndByWhatIsSeenOfABall) {
  MadeUpDrive drive = made_up_drive(10000);
  for (std::size_t i = 0; i < 4; ++i) drive.perfect[i].visible_fraction = 0.25 * static_cast<double>(i + 1);
  drive.perfect[3].visible_fraction.reset();
  DetectorFaults faults;
  faults.miss_by_visible = {{0.25, 0.4}, {0.75, 0.2}};
  const Arrived by_visible = drive_with(faults, drive).frames;
  const double asked_by_visible[] = {0.4, 0.3, 0.2, 0.0};
  for (int ball = 0; ball < 4; ++ball)
    EXPECT_TRUE(is_share(10000 - count_of(by_visible, ball), 10000, asked_by_visible[ball])) << ball;
  faults.miss_by_range = {{1.5, 0.0}, {3.0, 0.6}};  // of balls at 1.5, 2, 2.5 and 3 m
  faults.miss_probability = 0.1;
  const Arrived by_all = drive_with(faults, drive).frames;
  const double asked_by_range[] = {0.0, 0.2, 0.4, 0.6};
  for (int ball = 0; ball < 4; ++ball) {
    const double kept = 0.9 * (1.0 - asked_by_visible[ball]) * (1.0 - asked_by_range[ball]);
    EXPECT_TRUE(is_share(count_of(by_all, ball), 10000, kept)) << ball;
  }
}

// The share is that of single losses, and a loss lasts a multiple of so many frames. Mutations: a burst begun
// with the probability of each frame; all balls lost by one clock.
TEST(FaultyDetector, LosesInBursts) {
  constexpr int kBurst = 4;
  const MadeUpDrive drive = made_up_drive(20000);
  DetectorFaults faults;
  faults.miss_probability = 0.2;
  faults.miss_burst_frames = kBurst;
  const Arrived frames = drive_with(faults, drive).frames;
  std::set<std::size_t> clocks;
  for (int ball = 0; ball < 4; ++ball) {
    const long lost = 20000 - count_of(frames, ball);
    EXPECT_TRUE(is_share(lost / kBurst, 20000 / kBurst, 0.2)) << lost;
    long run = 0;
    bool is_whole = false;  // the first run may have begun before the drive
    for (std::size_t i = 0; i < frames.size(); ++i) {
      bool is_there = false;
      for (const TracedDetection& detection : frames[i]) is_there = is_there || detection.ball == ball;
      if (is_there && is_whole) {
        EXPECT_EQ(run % kBurst, 0) << i;
      }
      if (is_there && is_whole && run > 0) clocks.insert(i % kBurst);
      is_whole = is_whole || is_there;
      run = is_there ? 0 : run + 1;
    }
  }
  EXPECT_GT(clocks.size(), 1U);
}

// Mutations: a mean for the oracle and none for pictures; each frame the same number; places uniform in
// range.
TEST(FaultyDetector, FindsAsMuchOfNothingAsIsAsked) {
  for (const SensorKind sensor : {SensorKind::kStereo, SensorKind::kOracle}) {
    MadeUpDrive drive = made_up_drive(4000, 3, sensor);
    drive.scenario.oracle.max_range_m = 4.0;
    drive.scenario.identity = Identity::kColourClass;
    DetectorFaults faults;
    faults.false_per_frame = 1.5;
    faults.false_within_m = 4.0;
    const FaultyDrive faulty = drive_with(faults, drive);
    double sum = 0.0, squares = 0.0;
    long near = 0, first_colour = 0, imagined = 0;
    for (const auto& detections : faulty.frames) {
      const double count = static_cast<double>(detections.size()) - 3.0;
      sum += count;
      squares += count * count;
      for (std::size_t i = 3; i < detections.size(); ++i) {
        const vision::BallObservation& seen = detections[i].seen;
        EXPECT_EQ(detections[i].ball, slam::kUnknown);
        EXPECT_LE(seen.range_bearing.range_m, 4.0);
        EXPECT_GT(seen.range_bearing.covariance.determinant(), 0.0);
        EXPECT_EQ(seen.colour, seen.range_bearing.colour_class);
        ++imagined;
        near += seen.range_bearing.range_m < 2.0 ? 1 : 0;
        first_colour += seen.colour == 0 ? 1 : 0;
        if (sensor == SensorKind::kOracle) continue;
        EXPECT_TRUE(vision::is_inside(drive.scenario.believed_rig.intrinsics, seen.left_px));
        EXPECT_TRUE(vision::is_inside(drive.scenario.believed_rig.intrinsics, seen.right_px));
      }
    }
    const double mean = sum / 4000.0, variance = squares / 4000.0 - mean * mean;
    EXPECT_NEAR(mean, 1.5, kWithin99 * std::sqrt(1.5 / 4000.0));
    EXPECT_NEAR(variance, 1.5, kWithin99 * std::sqrt((1.5 + 2.0 * 1.5 * 1.5) / 4000.0));
    EXPECT_TRUE(is_share(first_colour, imagined, 1.0 / 3.0)) << first_colour;
    if (sensor == SensorKind::kOracle) {
      EXPECT_TRUE(is_share(near, imagined, 0.25)) << near;
    }
    EXPECT_EQ(faulty.counts, (FaultCounts{.added = imagined}));
  }
}

// Mutation: the factor on the covariance as well.
TEST(FaultyDetector, ScalesRanges) {
  const MadeUpDrive drive = made_up_drive(1);
  DetectorFaults faults;
  faults.range_scale = 1.05;
  const FaultyDrive faulty = drive_with(faults, drive);
  for (std::size_t i = 0; i < 4; ++i) {
    const slam::RangeBearing& seen = faulty.frames[0].at(i).seen.range_bearing;
    EXPECT_EQ(seen.range_m, 1.05 * drive.perfect[i].seen.range_bearing.range_m);
    EXPECT_EQ(seen.bearing_rad, drive.perfect[i].seen.range_bearing.bearing_rad);
    EXPECT_EQ(seen.covariance, drive.perfect[i].seen.range_bearing.covariance);
  }
  EXPECT_EQ(faulty.counts, (FaultCounts{.moved = 4}));
}

// What each frame's detections are is told by their range. Mutations: a frame late or early; what arrives at
// a lost frame handed on with the next.
TEST(FaultyDetector, AnswersLate) {
  const MadeUpDrive drive = made_up_drive(20, 1);
  const auto find = [&](std::size_t frame) {
    std::vector<TracedDetection> detections = drive.perfect;
    detections[0].seen.range_bearing.range_m = static_cast<double>(frame);
    return detections;
  };
  DetectorFaults faults;
  faults.latency_frames = 3;
  const FaultyDrive faulty = drive_with(faults, drive, 1, find);
  for (std::size_t i = 0; i < 20; ++i) {
    ASSERT_EQ(faulty.frames[i].size(), i < 3 ? 0U : 1U) << i;
    if (i >= 3) {
      EXPECT_EQ(faulty.frames[i][0].seen.range_bearing.range_m, static_cast<double>(i - 3));
    }
  }
  EXPECT_EQ(faulty.counts, (FaultCounts{.delayed = 17, .undelivered = 3}));

  FaultyDetector with_gap(faults, drive.scenario, drive.scenario.world, 1);
  for (const std::size_t frame : {0U, 1U, 2U, 4U}) {
    const auto arrived = with_gap.arriving(frame, find(frame));
    EXPECT_EQ(arrived.size(), frame == 4 ? 1U : 0U);
    if (frame == 4) {
      EXPECT_EQ(arrived[0].seen.range_bearing.range_m, 1.0);
    }
  }
  EXPECT_EQ(with_gap.counts(), (FaultCounts{.delayed = 1, .undelivered = 3}));
}

// What is lost at one level is lost at a higher one, and so on. Mutations: a draw that depends on what is
// left; colours confused in the order of the palette.
TEST(FaultyDetector, HasLevelsThatContainEachOther) {
  const MadeUpDrive drive = made_up_drive(500);
  const auto at = [&](double level) {
    DetectorFaults faults;
    faults.centre_sd_px = level;
    faults.miss_probability = level;
    faults.identity_swap_probability = level;
    faults.false_per_frame = level;
    return drive_with(faults, drive).frames;
  };
  const Arrived low = at(0.1), high = at(0.2);
  const auto seen_low = seen_in(low), seen_high = seen_in(high);
  EXPECT_LT(seen_high.size(), seen_low.size());
  for (std::size_t i = 0; i < low.size(); ++i)
    for (const TracedDetection& detection : high[i]) {
      if (detection.ball == slam::kUnknown) continue;
      ASSERT_TRUE(seen_low.contains({i, detection.ball})) << i;
      for (const TracedDetection& lower : low[i]) {
        if (lower.ball != detection.ball) continue;
        const Eigen::Vector4d right = pixels_of(drive.perfect[static_cast<std::size_t>(lower.ball)]);
        EXPECT_LT((pixels_of(detection) - right - 2.0 * (pixels_of(lower) - right)).norm(), 1e-9);
        if (lower.seen.colour != lower.ball) {
          EXPECT_EQ(detection.seen.colour, lower.seen.colour);
        }
      }
    }
}

// All others beside it move no draw of a fault. Mutations: two faults with the numbers of one; a fault
// skipped for detections that another one has taken.
TEST(FaultyDetector, DrawsForEachFaultByItself) {
  const MadeUpDrive drive = made_up_drive(200);
  DetectorFaults noise;
  noise.centre_sd_px = 0.2;
  const Arrived alone = drive_with(noise, drive).frames;
  DetectorFaults all = noise;
  all.miss_probability = 0.3;
  all.miss_burst_frames = 3;
  all.identity_swap_probability = 0.3;
  all.false_per_frame = 2.0;
  all.confusion = {{0.5, 0.5}, {0.5, 0.5}};
  const Arrived together = drive_with(all, drive).frames;
  DetectorFaults misses;
  misses.miss_probability = 0.3;
  misses.miss_burst_frames = 3;
  const auto left = seen_in(drive_with(misses, drive).frames);
  for (std::size_t i = 0; i < alone.size(); ++i)
    for (const TracedDetection& detection : alone[i]) {
      const TracedDetection* found = nullptr;
      for (const TracedDetection& other : together[i])
        if (other.ball == detection.ball) found = &other;
      EXPECT_EQ(found != nullptr, left.contains({i, detection.ball})) << i;
      if (found != nullptr) {
        EXPECT_EQ(pixels_of(*found), pixels_of(detection));
      }
    }
}

// Mutation: the seed left out of the key.
TEST(FaultyDetector, DrawsOtherNumbersForAnotherSeed) {
  const MadeUpDrive drive = made_up_drive(5);
  DetectorFaults faults;
  faults.centre_sd_px = 0.2;
  EXPECT_NE(pixels_of(drive_with(faults, drive, 1).frames[0][0]),
            pixels_of(drive_with(faults, drive, 2).frames[0][0]));
  EXPECT_EQ(pixels_of(drive_with(faults, drive, 1).frames[4][1]),
            pixels_of(drive_with(faults, drive, 1).frames[4][1]));
}

// To the last bit. Mutation: a place that is put together anew.
TEST(FaultyDetector, WithoutFaultsChangesNothing) {
  for (const SensorKind sensor : {SensorKind::kStereo, SensorKind::kOracle}) {
    const MadeUpDrive drive = made_up_drive(3, 4, sensor);
    const FaultyDrive faulty = drive_with({}, drive);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(detections_line(i, observations_of(faulty.frames[i])),
                detections_line(i, observations_of(drive.perfect)));
    EXPECT_EQ(faulty.counts, FaultCounts{});
  }
}

}  // namespace
}  // namespace stereobench::harness
