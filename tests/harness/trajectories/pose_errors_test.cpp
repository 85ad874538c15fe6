#include "harness/trajectories/pose_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/trajectories/pairing.h"
#include "tests/harness/trajectories/paths.h"

namespace stereobench::harness {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Eigen::Vector3d kUp(0.0, 0.0, 1.0);

// A robot that drives a metre a second along x, and an estimate of it that turns and stretches a little each
// step.
TrajectoryPairs drifting(int poses, double stretch, double turn_rad) {
  TrajectoryPairs pairs;
  PoseInSpace estimate;
  for (int i = 0; i < poses; ++i) {
    pairs.stamps_ns.push_back(1'000'000'000LL * i);
    pairs.truth.push_back({Eigen::Matrix3d::Identity(), {1.0 * i, 0.0, 0.0}});
    pairs.estimate.push_back(estimate);
    estimate = compose(estimate, {turned(turn_rad, kUp), {stretch, 0.0, 0.0}});
  }
  return pairs;
}

TEST(ErrorStatistics, ByHand) {
  const ErrorStatistics s = statistics_of({3.0, 1.0, 2.0, 4.0});
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
  EXPECT_DOUBLE_EQ(s.sse, 30.0);
  EXPECT_TRUE(std::isnan(statistics_of({}).rmse));
}

// Law: relative errors do not depend on the frames of estimate and truth. Mutation: differences in the world.
TEST(RelativeErrors, DoNotDependOnTheFrames) {
  TrajectoryPairs pairs = pair_trajectories(disturbed(winding_path(), 0.1, 0.1, 3), winding_path());
  const PoseErrors here = relative_errors(pairs, {.length = 3.0});
  const PoseInSpace elsewhere{turned(2.0, {1.0, 2.0, 3.0}), {4.0, 5.0, -6.0}};
  for (PoseInSpace& pose : pairs.estimate) pose = compose(elsewhere, pose);
  const PoseErrors there = relative_errors(pairs, {.length = 3.0});
  ASSERT_EQ(here.translation_m.size(), 66U);
  for (std::size_t i = 0; i < here.translation_m.size(); ++i) {
    EXPECT_NEAR(here.translation_m[i], there.translation_m[i], 1e-12);
    EXPECT_NEAR(here.rotation_rad[i], there.rotation_rad[i], 1e-7);
  }
}

// A stretch of one in a hundred is a centimetre a metre, over any delta of a straight path.
TEST(RelativeErrors, AreThoseOfTheSpan) {
  const TrajectoryPairs pairs = drifting(101, 1.01, 0.0);
  for (const auto& [text, delta_m, count] :
       {std::tuple("1", 1.0, 100U), {"7", 7.0, 14U}, {"5s", 5.0, 20U}, {"10m", 10.0, 9U}}) {
    const PoseErrors errors = relative_errors(pairs, parse_delta(text));
    EXPECT_EQ(errors.translation_m.size(), count) << text;
    EXPECT_THAT(errors.translation_m, Each(DoubleNear(0.01 * delta_m, 1e-9))) << text;
  }
  Delta every = parse_delta("10m");
  every.all_pairs = true;
  EXPECT_EQ(relative_errors(pairs, every).translation_m.size(), 92U);
  EXPECT_TRUE(relative_errors(pairs, parse_delta("500s")).translation_m.empty());
}

// At 10 Hz a delta of 0.2 s is two poses, to the nanosecond. Mutation: differences of seconds as
// floating-point numbers, of which 0.3 - 0.1 is less than 0.2.
TEST(RelativeErrors, InSecondsCountNanoseconds) {
  TrajectoryPairs pairs = drifting(201, 1.0, 0.0);
  for (std::int64_t& stamp_ns : pairs.stamps_ns) stamp_ns /= 10;
  for (const char* seconds : {"0.1s", "0.2s", "0.3s", "0.7s"}) {
    Delta in_poses = parse_delta(seconds);
    in_poses.length = std::round(10.0 * in_poses.length);
    in_poses.unit = Delta::Unit::kPoses;
    EXPECT_EQ(relative_errors(pairs, parse_delta(seconds)).translation_m.size(),
              relative_errors(pairs, in_poses).translation_m.size())
        << seconds;
  }
  pairs.stamps_ns.clear();
  EXPECT_THAT([&] { relative_errors(pairs, parse_delta("1s")); },
              ThrowsMessage<std::runtime_error>(HasSubstr("--delta: a file has no times")));
}

TEST(ParseDelta, ReadsWhatItWritesAndRefusesTheRest) {
  for (const char* text : {"1", "10m", "0.5s", "2.5m"}) EXPECT_EQ(text_of(parse_delta(text)), text);
  for (const char* text : {"", "m", "1.5", "-1", "0", "1km", "1 m", "nan", "inf"})
    EXPECT_THAT([&] { parse_delta(text); },
                ThrowsMessage<std::runtime_error>(HasSubstr("--delta: expected a number of poses")))
        << text;
}

// KITTI's errors of a path that is 1 % too long and turns by 0.1 degrees a metre: each piece says so, but for
// what the turn moves. Mutations: a piece's error not divided by its length; a piece from every pose.
TEST(SegmentErrors, AreADriftPerMetre) {
  constexpr double kTurn_deg = 0.1;
  const std::vector<SegmentErrors> turns =
      segment_errors(drifting(1001, 1.0, kTurn_deg * M_PI / 180.0), {100.0, 800.0});
  ASSERT_EQ(turns.size(), 3U);
  EXPECT_EQ(turns[0].count, 90);
  EXPECT_EQ(turns[1].count, 20);
  EXPECT_EQ(turns[2].count, 110);
  // A piece ends at the first pose beyond its length, a metre further.
  EXPECT_NEAR(turns[0].rotation_deg_per_m, kTurn_deg * 101.0 / 100.0, 1e-9);
  // An arc's end lies half its turn off the straight line.
  EXPECT_NEAR(turns[0].translation_percent, 101.0 * (0.5 * kTurn_deg * 100.0) * M_PI / 180.0, 0.05);
  const std::vector<SegmentErrors> stretches = segment_errors(drifting(1001, 1.01, 0.0), {100.0, 2000.0});
  EXPECT_NEAR(stretches[0].translation_percent, 1.01, 1e-9);
  EXPECT_EQ(stretches[1].count, 0);
  EXPECT_TRUE(std::isnan(stretches[1].translation_percent));
  EXPECT_NEAR(stretches[2].translation_percent, 1.01, 1e-9);
}

}  // namespace
}  // namespace stereobench::harness
