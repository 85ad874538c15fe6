#include "harness/trajectories/alignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/trajectories/pairing.h"
#include "harness/trajectories/pose_errors.h"
#include "tests/harness/trajectories/paths.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

double rmse(const TrajectoryPairs& pairs, const Alignment& alignment) {
  TrajectoryPairs there = pairs;
  there.estimate = aligned(pairs.estimate, alignment);
  return statistics_of(absolute_errors(there).translation_m).rmse;
}

TrajectoryPairs noisy_pairs(std::uint64_t seed) {
  return pair_trajectories(disturbed(winding_path(), 0.3, 0.05, seed), winding_path());
}

class AlignmentLaw : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, AlignmentLaw, testing::Range<std::uint64_t>(0, 10));

// Law: what was turned, shifted and scaled is brought back. Mutation: no scale in the shift.
TEST_P(AlignmentLaw, UndoesASimilarity) {
  slam::RandomStream random(GetParam(), slam::Stream::kWorld);
  const Alignment there{turned(3.0 * random.normal(), {random.normal(), random.normal(), 1.0}),
                        {random.normal(), random.normal(), random.normal()},
                        0.5 + random.uniform()};
  TrajectoryPairs pairs = pair_trajectories(winding_path(), winding_path());
  pairs.estimate = aligned(pairs.estimate, there);
  const Alignment back = align(pairs, AlignmentKind::kSim3);
  EXPECT_NEAR(back.scale * there.scale, 1.0, 1e-12);
  EXPECT_LT(rmse(pairs, back), 1e-12);
  const std::vector<PoseInSpace> poses = aligned(pairs.estimate, back);
  EXPECT_LT(angle_of(poses[7].rotation.transpose() * pairs.truth[7].rotation), 1e-12);
}

// Law: no rotation, shift or scale near by fits better. Mutation: scale and rotation of the inverse problem.
TEST_P(AlignmentLaw, FitsBest) {
  TrajectoryPairs in_space = noisy_pairs(GetParam());
  if (GetParam() % 2 == 1)  // in part a mirror image, which must not be followed
    for (PoseInSpace& pose : in_space.estimate) pose.position_m.x() *= -0.3;
  for (const AlignmentKind kind :
       {AlignmentKind::kSe2, AlignmentKind::kSim2, AlignmentKind::kSe3, AlignmentKind::kSim3}) {
    const bool flat = is_in_plane(kind);
    const bool scales = kind == AlignmentKind::kSim2 || kind == AlignmentKind::kSim3;
    const TrajectoryPairs pairs = is_in_plane(kind) ? in_plane(in_space, Plane::kXz) : in_space;
    const Alignment best = align(pairs, kind);
    const double least = rmse(pairs, best);
    slam::RandomStream random(GetParam(), slam::Stream::kWorld);
    for (int i = 0; i < 30; ++i) {
      Alignment other = best;
      const Eigen::Vector3d axis(flat ? 0.0 : random.normal(), flat ? 0.0 : random.normal(), 1.0);
      other.rotation = best.rotation * turned(1e-3 * random.normal(), axis);
      other.translation_m +=
          1e-3 * Eigen::Vector3d(random.normal(), random.normal(), flat ? 0.0 : random.normal());
      if (scales) other.scale *= 1.0 + 1e-3 * random.normal();
      EXPECT_GE(rmse(pairs, other), least) << static_cast<int>(kind);
    }
    EXPECT_NEAR(best.rotation.determinant(), 1.0, 1e-12);
  }
}

// A mirrored path is not turned into its mirror image. Mutation: the sign of the least singular value.
TEST(Alignment, NeverMirrors) {
  TrajectoryPairs pairs = noisy_pairs(1);
  for (PoseInSpace& pose : pairs.estimate) pose.position_m.x() *= -1.0;
  for (const AlignmentKind kind : {AlignmentKind::kSe2, AlignmentKind::kSe3}) {
    const TrajectoryPairs there = is_in_plane(kind) ? in_plane(pairs, Plane::kXy) : pairs;
    EXPECT_NEAR(align(there, kind).rotation.determinant(), 1.0, 1e-12);
  }
}

TEST(Alignment, AtTheOriginBringsTheFirstPosesTogether) {
  const TrajectoryPairs pairs = noisy_pairs(2);
  const PoseInSpace first = aligned(pairs.estimate, align(pairs, AlignmentKind::kOrigin)).front();
  EXPECT_LT((first.position_m - pairs.truth.front().position_m).norm(), 1e-12);
  EXPECT_TRUE(first.rotation.isApprox(pairs.truth.front().rotation, 1e-12));
}

// In each plane a path that turns about its normal keeps its heading. Mutation: the axes of another plane.
TEST(Alignment, APlaneKeepsWhatTurnsAboutItsNormal) {
  const std::pair<Plane, Eigen::Vector3d> planes[] = {
      {Plane::kXy, {0.0, 0.0, 1.0}}, {Plane::kXz, {0.0, -1.0, 0.0}}, {Plane::kYz, {1.0, 0.0, 0.0}}};
  for (const auto& [plane, normal] : planes) {
    TrajectoryPairs pairs{.estimate = {{turned(0.7, normal), {1.0, 2.0, 3.0}}}, .truth = {{}}};
    pairs = in_plane(pairs, plane);
    EXPECT_NEAR(angle_of(pairs.estimate[0].rotation), 0.7, 1e-12);
    EXPECT_GT(pairs.estimate[0].rotation(1, 0), 0.0);
    EXPECT_EQ(pairs.estimate[0].position_m.z(), 0.0);
  }
}

TEST(Alignment, RefusesWhatDoesNotSayHowToTurn) {
  TrajectoryPairs line;
  for (int i = 0; i < 5; ++i) {
    line.estimate.push_back({Eigen::Matrix3d::Identity(), {1.0 * i, 0.0, 0.0}});
    line.truth.push_back({Eigen::Matrix3d::Identity(), {0.0, 1.0 * i, 0.0}});
  }
  EXPECT_THAT([&] { align(line, AlignmentKind::kSe3); },
              ThrowsMessage<std::runtime_error>(HasSubstr("lie on a line and do not say how to roll")));
  EXPECT_LT(rmse(line, align(line, AlignmentKind::kSe2)), 1e-12);  // in a plane it does
  for (PoseInSpace& pose : line.estimate) pose.position_m = Eigen::Vector3d(0.1, 0.2, 0.3) / 3.0;
  for (const AlignmentKind kind : {AlignmentKind::kSe2, AlignmentKind::kSim3})
    EXPECT_THAT([&] { align(line, kind); },
                ThrowsMessage<std::runtime_error>(HasSubstr("the 5 positions of the estimate coincide")));
}

}  // namespace
}  // namespace stereobench::harness
