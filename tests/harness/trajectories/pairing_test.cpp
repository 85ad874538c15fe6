#include "harness/trajectories/pairing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/trajectories/paths.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Poses whose x says when they were.
Trajectory at_ms(const std::vector<std::int64_t>& stamps_ms) {
  Trajectory path;
  for (const std::int64_t stamp_ms : stamps_ms) {
    path.stamps_ns.push_back(1'000'000 * stamp_ms);
    path.poses.push_back({Eigen::Matrix3d::Identity(), {static_cast<double>(stamp_ms), 0.0, 0.0}});
  }
  return path;
}

std::vector<double> when(const std::vector<PoseInSpace>& poses) {
  std::vector<double> stamps;
  for (const PoseInSpace& pose : poses) stamps.push_back(pose.position_m.x());
  return stamps;
}

// Mutation: the next pose in place of the nearest.
TEST(PairTrajectories, TakesTheNearestInTimeWithinALimit) {
  const TrajectoryPairs pairs = pair_trajectories(at_ms({98, 206, 340, 404}), at_ms({0, 100, 200, 300, 400}));
  EXPECT_THAT(when(pairs.estimate), ElementsAre(98, 206, 404));
  EXPECT_THAT(when(pairs.truth), ElementsAre(100, 200, 400));
  EXPECT_THAT(times_of(pairs), ElementsAre(0.0, 0.1, 0.3));
  EXPECT_EQ(pairs.repeated, 0);
}

// Mutation: the offset's sign, where the truth is the shorter one.
TEST(PairTrajectories, ShiftsTheEstimateWhicheverIsLonger) {
  const Trajectory late = at_ms({5100, 5200}), more = at_ms({5000, 5100, 5200, 5300});
  const PairingRules rules{.offset_s = -5.0};
  EXPECT_THAT(when(pair_trajectories(late, at_ms({0, 100, 200, 300}), rules).truth), ElementsAre(100, 200));
  EXPECT_THAT(when(pair_trajectories(more, at_ms({100, 200}), rules).estimate), ElementsAre(5100, 5200));
}

// An estimate that is denser for a while shares true poses; of two that are as near the earlier one counts.
// Mutations: not counted; the later one.
TEST(PairTrajectories, CountsPosesThatAreShared) {
  const TrajectoryPairs pairs =
      pair_trajectories(at_ms({98, 99, 101}), at_ms({100, 200, 300, 400}), {.most_dt_s = 0.005});
  EXPECT_THAT(when(pairs.truth), ElementsAre(100, 100, 100));
  EXPECT_EQ(pairs.repeated, 2);
  EXPECT_THAT(when(pair_trajectories(at_ms({150}), at_ms({100, 200}), {.most_dt_s = 1.0}).truth),
              ElementsAre(100));
}

TEST(PairTrajectories, WithoutTimesGoesByNumber) {
  Trajectory estimate = at_ms({1, 2, 3});
  estimate.stamps_ns.clear();
  const TrajectoryPairs pairs = pair_trajectories(estimate, at_ms({7, 8, 9}));
  EXPECT_THAT(when(pairs.truth), ElementsAre(7, 8, 9));
  EXPECT_TRUE(pairs.stamps_ns.empty());
  EXPECT_THAT(times_of(pairs), ElementsAre(0, 1, 2));
  EXPECT_THROW(pair_trajectories(estimate, at_ms({7, 8, 9}), {.offset_s = 1.0}), std::runtime_error);
  EXPECT_THAT(
      [&] {
        pair_trajectories(estimate, at_ms({7, 8}));
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("the estimate has 3 poses and the truth 2")));
  EXPECT_THAT(
      [&] { pair_trajectories(at_ms({1}), at_ms({100})); },
      ThrowsMessage<std::runtime_error>(HasSubstr("no two times of estimate and truth lie within 0.01 s")));
}

}  // namespace
}  // namespace stereobench::harness
