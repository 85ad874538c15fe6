#include "harness/logs/log_steps.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kSecond = 1'000'000'000;

LoggedSighting seen_at(std::int64_t stamp_ns, int id = 1) {
  LoggedSighting sighting;
  sighting.stamp_ns = stamp_ns;
  sighting.measurement.landmark_id = id;
  return sighting;
}

double total_s(const LogStep& step) {
  double sum = 0.0;
  for (const slam::Control& control : step.odometry) sum += control.duration_s;
  return sum;
}

/// Readings and sightings at random times over some 20 s.
RecordedStreams random_streams(std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  RecordedStreams streams;
  const auto some_time = [&](double longest_s) { return std::llround(random.uniform() * longest_s * 1e9); };
  for (std::int64_t t = some_time(1.0); t < 20 * kSecond; t += some_time(0.7)) {
    streams.odometry.push_back({t, random.normal(), random.normal()});
    streams.truth.push_back({t, {random.normal(), random.normal(), random.uniform()}});
  }
  for (std::int64_t t = some_time(3.0); t < 21 * kSecond; t += some_time(3.0)) {
    streams.sightings.push_back(seen_at(t));
  }
  return streams;
}

class AnyStreams : public testing::TestWithParam<std::uint64_t> {};

// Mutation: losing the part of a reading beyond a step's end, or the last reading.
TEST_P(AnyStreams, OdometryFillsEveryStepExactly) {
  const MeasurementLog log = steps_from_streams(random_streams(GetParam()));
  EXPECT_TRUE(log.steps.front().odometry.empty());
  for (std::size_t i = 1; i < log.steps.size(); ++i) {
    const double length_s = static_cast<double>(log.steps[i].stamp_ns - log.steps[i - 1].stamp_ns) * 1e-9;
    EXPECT_NEAR(total_s(log.steps[i]), length_s, 1e-12);
    EXPECT_GT(length_s, 0.0);
    EXPECT_LE(length_s, 1.0);
  }
}

// Mutation: taking the next reading in place of the held one.
TEST_P(AnyStreams, AnyCutOfTheTimeLeadsToTheSamePlace) {
  RecordedStreams streams = random_streams(GetParam());
  const MeasurementLog cut = steps_from_streams(streams);
  streams.instants_ns = {cut.steps.front().stamp_ns, cut.steps.back().stamp_ns};
  streams.sightings.clear();
  const MeasurementLog whole = steps_from_streams(streams);
  const auto drive = [](const MeasurementLog& log) {
    slam::Pose pose;
    for (const LogStep& step : log.steps) {
      for (const slam::Control& control : step.odometry) pose = slam::advance(pose, control);
    }
    return pose;
  };
  EXPECT_NEAR(drive(cut).x_m, drive(whole).x_m, 1e-9);
  EXPECT_NEAR(drive(cut).y_m, drive(whole).y_m, 1e-9);
  EXPECT_NEAR(slam::wrap_angle(drive(cut).heading_rad - drive(whole).heading_rad), 0.0, 1e-9);
}

TEST_P(AnyStreams, NoSightingIsLost) {
  const RecordedStreams streams = random_streams(GetParam());
  std::size_t dealt_out = 0;
  for (const LogStep& step : steps_from_streams(streams).steps) dealt_out += step.measurements.size();
  EXPECT_EQ(dealt_out, streams.sightings.size());
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyStreams, testing::Range<std::uint64_t>(0, 50));

TEST(LogSteps, SightingsWithinAMillisecondOfTheFirstAreOneStep) {
  RecordedStreams streams;
  streams.odometry = {{0, 1.0, 0.0}};
  streams.sightings = {seen_at(500 * kMillisecond_ns, 1), seen_at(501 * kMillisecond_ns, 2),
                       seen_at(502 * kMillisecond_ns, 3)};
  const MeasurementLog log = steps_from_streams(streams);
  ASSERT_EQ(log.steps.size(), 3U);
  EXPECT_EQ(log.steps[1].stamp_ns, 500 * kMillisecond_ns);
  ASSERT_EQ(log.steps[1].measurements.size(), 2U);
  EXPECT_EQ(log.steps[1].measurements[1].landmark_id, 2);
  EXPECT_EQ(log.steps[2].stamp_ns, 502 * kMillisecond_ns);
}

TEST(LogSteps, AGapIsCutIntoEqualPartsOfAtMostASecond) {
  RecordedStreams streams;
  streams.odometry = {{0, 1.0, 0.0}};
  streams.sightings = {seen_at(0), seen_at(2500 * kMillisecond_ns)};
  const MeasurementLog log = steps_from_streams(streams);
  ASSERT_EQ(log.steps.size(), 4U);
  EXPECT_NEAR(static_cast<double>(log.steps[1].stamp_ns) * 1e-9, 2.5 / 3, 1e-9);
  EXPECT_TRUE(log.steps[1].measurements.empty());
  EXPECT_EQ(log.steps[3].measurements.size(), 1U);
}

TEST(LogSteps, ReadingsAreHeldAndSplitWhereAStepEnds) {
  RecordedStreams streams;
  streams.odometry = {{200 * kMillisecond_ns, 1.0, 0.1},
                      {200 * kMillisecond_ns, 2.0, 0.2},
                      {600 * kMillisecond_ns, 3.0, 0.3}};
  streams.instants_ns = {0, 500 * kMillisecond_ns, 900 * kMillisecond_ns};
  const MeasurementLog log = steps_from_streams(streams);
  ASSERT_EQ(log.steps[1].odometry.size(), 2U);
  EXPECT_EQ(log.steps[1].odometry[0].v_mps, 0.0);  // before the first reading the robot stands
  EXPECT_DOUBLE_EQ(log.steps[1].odometry[0].duration_s, 0.2);
  EXPECT_EQ(log.steps[1].odometry[1].v_mps, 2.0);  // the second of two readings at one time holds
  EXPECT_DOUBLE_EQ(log.steps[1].odometry[1].duration_s, 0.3);
  ASSERT_EQ(log.steps[2].odometry.size(), 2U);
  EXPECT_EQ(log.steps[2].odometry[0].w_radps, 0.2);
  EXPECT_DOUBLE_EQ(log.steps[2].odometry[0].duration_s, 0.1);
  EXPECT_EQ(log.steps[2].odometry[1].w_radps, 0.3);  // the last reading holds to the end
  EXPECT_DOUBLE_EQ(log.steps[2].odometry[1].duration_s, 0.3);
}

// Mutation: interpolating the heading without wrapping, which passes through 0 instead of pi.
TEST(LogSteps, TruthLiesOnTheLineAndTheShorterArc) {
  RecordedStreams streams;
  streams.odometry = {{0, 0.0, 0.0}};
  streams.truth = {{0, {1.0, 2.0, 3.0}}, {kSecond, {2.0, 4.0, -3.0}}};
  streams.instants_ns = {500 * kMillisecond_ns, 750 * kMillisecond_ns};
  const MeasurementLog log = steps_from_streams(streams);
  ASSERT_TRUE(log.steps[0].truth.has_value());
  EXPECT_DOUBLE_EQ(log.steps[0].truth->x_m, 1.5);
  EXPECT_DOUBLE_EQ(log.steps[0].truth->y_m, 3.0);
  EXPECT_NEAR(std::abs(log.steps[0].truth->heading_rad), M_PI, 1e-12);
  EXPECT_LT(log.steps[1].truth->heading_rad, -3.0);
  EXPECT_DOUBLE_EQ(log.start.x_m, 1.5);
}

TEST(LogSteps, ThereIsNoTruthOutsideItsSpanNorInALongGap) {
  RecordedStreams streams;
  streams.odometry = {{0, 0.0, 0.0}};
  streams.truth = {{kSecond, {}}, {2 * kSecond, {}}, {3 * kSecond + 1, {}}, {4 * kSecond, {}}};
  streams.instants_ns = {
      0,           kSecond,    1500 * kMillisecond_ns, 2500 * kMillisecond_ns, 3500 * kMillisecond_ns,
      4 * kSecond, 5 * kSecond};
  std::vector<bool> known;
  for (const LogStep& step : steps_from_streams(streams).steps) known.push_back(step.truth.has_value());
  EXPECT_EQ(known, (std::vector<bool>{false, true, true, false, true, true, false}));
  EXPECT_EQ(steps_from_streams(streams).start.x_m, 0.0);
}

}  // namespace
}  // namespace stereobench::harness
