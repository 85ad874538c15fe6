#include "harness/logs/repeated_sightings.h"

#include <gtest/gtest.h>

#include "harness/logs/measurement_log_reader.h"
#include "slam/math/random.h"
#include "tests/harness/logs/log_folder.h"

namespace stereobench::harness {
namespace {

/// Three sightings an instant, each of its own landmark, at ten instants 0.1 s apart.
std::vector<LoggedSighting> different_sightings() {
  slam::RandomStream random(1, slam::Stream::kWorld);
  std::vector<LoggedSighting> sightings;
  for (int i = 0; i < 30; ++i) {
    LoggedSighting sighting{i / 3 * 100'000'000LL, {}};
    sighting.measurement = {.range_m = 1.0 + random.uniform(), .bearing_rad = random.normal()};
    sighting.measurement.landmark_id = i % 3;
    sightings.push_back(sighting);
  }
  return sightings;
}

// Law: doubling a log and reading it is reading the log. Mutations: neighbours alone compared; any two of one
// landmark at an instant dropped; every second one dropped.
TEST(RepeatedSightings, ADoubledLogIsTheLog) {
  const std::vector<LoggedSighting> once = different_sightings();
  std::vector<LoggedSighting> doubled;
  for (std::size_t i = 0; i < once.size(); i += 3)  // an instant's three, and the three again
    for (const std::size_t k : {0U, 1U, 2U, 0U, 1U, 2U}) doubled.push_back(once[i + k]);
  for (std::size_t i = 0; i < doubled.size(); ++i)
    doubled[i].stamp_ns += i % 6 >= 3 ? 900'000 : 0;  // 0.9 ms later is the same instant
  EXPECT_EQ(drop_repeated(doubled), 30);
  ASSERT_EQ(doubled.size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i)
    EXPECT_EQ(doubled[i].measurement.range_m, once[i].measurement.range_m);
}

// Mutations: colours, bearings or stamps not compared.
TEST(RepeatedSightings, WhatDiffersInAnythingStays) {
  const LoggedSighting first{0, {.range_m = 2.0, .bearing_rad = 0.1, .landmark_id = 4, .colour_class = 1}};
  std::vector<LoggedSighting> sightings(6, first);
  sightings[1].measurement.range_m += 1e-12;
  sightings[2].measurement.bearing_rad = -0.1;
  sightings[3].measurement.landmark_id = 5;
  sightings[4].measurement.colour_class = 2;
  sightings[5].stamp_ns = 1'100'000;
  EXPECT_EQ(drop_repeated(sightings), 0);
  EXPECT_EQ(sightings.size(), 6U);
  EXPECT_EQ(count_concurrent(sightings), 3)
      << "the second, third and fifth are of landmark 4 at that instant";
}

// Mutation: sightings without an identity taken for one landmark's.
TEST(RepeatedSightings, WithoutIdentitiesNothingIsConcurrent) {
  std::vector<LoggedSighting> sightings = different_sightings();
  EXPECT_EQ(count_concurrent(sightings), 0);
  for (LoggedSighting& sighting : sightings) sighting.measurement.landmark_id = slam::kUnknown;
  EXPECT_EQ(count_concurrent(sightings), 0);
}

TEST(RepeatedSightings, AreCountedByTheReader) {
  const TestFolder folder;
  write_small_csv_log(folder);
  folder.write(
      "log/observations.csv",
      "t_s,landmark_id,range_m,bearing_rad\n0.5,7,2,0.1\n0.5,7,2,0.1\n1.5,7,1.5,0.2\n1.5,7,1.6,0.2\n");
  const RecordedLog recorded = read_log(folder.path() / "log", {});
  EXPECT_EQ(recorded.facts.repeated_sightings, 1);
  EXPECT_EQ(recorded.facts.concurrent_sightings, 1);
  EXPECT_EQ(recorded.log.steps[1].measurements.size(), 1U);
  EXPECT_EQ(recorded.log.steps[2].measurements.size(), 2U);
}

}  // namespace
}  // namespace stereobench::harness
