#include "harness/run/serialise.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

using Limits = std::numeric_limits<double>;

/// The bits of a number, so that -0 is not 0; all NaN are one.
std::uint64_t bits(double value) {
  return std::isnan(value) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(value);
}

FilterRun run_at(double value) {
  FilterRun run{.filter = "ufastslam", .particles = 7, .seed = ~std::uint64_t{0}};
  run.poses = {{value, -value, 0.0}};
  run.covariances = {Eigen::Matrix3d::Zero()};
  run.covariances[0](0, 2) = value;
  run.last.landmarks = {{3, 5, {value, 1.0}, Eigen::Matrix2d::Identity()}};
  run.last.counters.resamplings = 11;
  run.updates = {{{{6, 2.5, true}}, 4.5, 3}};
  return run;
}

void expect_carried(double value) {
  const auto back = filter_runs_from_bytes(to_bytes(std::vector{run_at(value)}));
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(bits(back[0].poses.at(0).x_m), bits(value)) << value;
  EXPECT_EQ(bits(back[0].poses.at(0).y_m), bits(-value)) << value;
  EXPECT_EQ(bits(back[0].covariances.at(0)(0, 2)), bits(value)) << value;
  EXPECT_EQ(back[0].covariances.at(0)(2, 0), 0.0);
  EXPECT_EQ(bits(back[0].last.landmarks.at(0).position_m.x()), bits(value)) << value;
}

// Law: every number comes back with the bits it had.
// Mutations: matrices in single precision, or transposed.
TEST(Serialise, CarriesEveryNumberToTheLastBit) {
  for (const double value : {0.0, -0.0, 0.1, Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(),
                             Limits::max(), Limits::min(), Limits::denorm_min(), Limits::epsilon()})
    expect_carried(value);
  slam::RandomStream random(2, slam::Stream::kWorld);
  for (int i = 0; i < 200; ++i) expect_carried(std::ldexp(random.normal(), i - 100));
}

// Mutation: leaving out whether it failed.
TEST(Serialise, CarriesWhatARunIs) {
  FilterRun run = run_at(1.0);
  run.failed = true;
  run.failure = "step 3: lost";
  run.association = AssociationScore{.missed = 6};
  run.last.landmarks[0].origin = 17;
  const FilterRun back = filter_runs_from_bytes(to_bytes(std::vector{run})).at(0);
  EXPECT_EQ(back.filter, "ufastslam");
  EXPECT_EQ(back.association.value().missed, 6);
  EXPECT_EQ(back.last.landmarks.at(0).origin, 17);
  EXPECT_EQ(back.particles, 7);
  EXPECT_EQ(back.seed, ~std::uint64_t{0});
  EXPECT_TRUE(back.failed);
  EXPECT_EQ(back.failure, run.failure);
  EXPECT_EQ(back.last.landmarks.at(0).landmark_id, 3);
  EXPECT_EQ(back.last.landmarks.at(0).colour_class, 5);
  EXPECT_EQ(back.last.counters.resamplings, 11);
  EXPECT_EQ(back.updates.at(0).innovations.at(0).sighting, 6);
  EXPECT_EQ(back.updates[0].innovations[0].squared_length, 2.5);
  EXPECT_TRUE(back.updates[0].innovations[0].refused);
  EXPECT_EQ(back.updates[0].effective_particles, 4.5);
  EXPECT_EQ(back.updates[0].distinct_ancestors, 3);
}

TEST(Serialise, CarriesADriveWithAndWithoutTruthAndPixels) {
  SeedDrive drive{.seed = 9};
  drive.recording.log.start = {1.0, 2.0, 3.0};
  drive.recording.log.steps = {{.stamp_ns = 1'248'272'263'273'000'001, .odometry = {{0.1, 0.2, 0.3}}},
                               {.stamp_ns = 2, .truth = slam::Pose{4.0, 5.0, 6.0}}};
  drive.recording.log.landmarks = {{1, 2, {3.0, 4.0}}};
  drive.references.batch = run_at(0.3);
  drive.references.bound.emplace().poses = {Eigen::Matrix3d::Identity(), 0.1 * Eigen::Matrix3d::Identity()};
  drive.references.bound->landmarks = {0.2 * Eigen::Matrix2d::Identity()};
  drive.snapshots = {{12, std::string("\x89PNG\0\xff", 6)}};
  SeedDrive back = seed_drive_from_bytes(to_bytes(drive));
  EXPECT_EQ(back.seed, 9U);
  EXPECT_EQ(back.recording.log.start.heading_rad, 3.0);
  EXPECT_EQ(back.recording.log.steps.at(0).stamp_ns, 1'248'272'263'273'000'001);
  EXPECT_EQ(back.recording.log.steps[0].odometry.at(0).w_radps, 0.2);
  EXPECT_FALSE(back.recording.log.steps[0].truth);
  EXPECT_EQ(back.recording.log.steps.at(1).truth.value().y_m, 5.0);
  EXPECT_EQ(back.recording.log.landmarks.at(0).position_m.y(), 4.0);
  EXPECT_EQ(back.snapshots.at(0).png, drive.snapshots[0].png);
  EXPECT_EQ(back.references.batch.poses.at(0).x_m, 0.3);
  EXPECT_EQ(back.references.bound.value().poses.at(1)(2, 2), 0.1);
  EXPECT_EQ(back.references.bound->landmarks.at(0)(1, 1), 0.2);
  EXPECT_FALSE(back.recording.vision);
  drive.references.bound.reset();
  drive.recording.vision.emplace().repeated = 3;
  back = seed_drive_from_bytes(to_bytes(drive));
  EXPECT_EQ(back.recording.vision.value().repeated, 3);
  EXPECT_FALSE(back.references.bound);
}

}  // namespace
}  // namespace stereobench::harness
