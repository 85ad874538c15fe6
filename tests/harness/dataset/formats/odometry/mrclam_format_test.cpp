#include "harness/dataset/formats/odometry/mrclam_format.h"

#include <gmock/gmock.h>

#include "harness/logs/measurement_log_reader.h"
#include "harness/logs/measurement_log_writer.h"
#include "slam/math/random.h"
#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

/// Half a second a step, with numbers that need all their digits; the last step sees nothing.
MeasurementLog sighted_log() {
  slam::RandomStream random(7, slam::Stream::kWorld);
  MeasurementLog log;
  for (int i = 0; i < 4; ++i) log.landmarks.push_back({i, 3 * i, {random.normal(), random.normal()}});
  for (int i = 0; i < 8; ++i) {
    LogStep step = {.stamp_ns = i * 500'000'000LL,
                    .odometry = {},
                    .measurements = {},
                    .truth = slam::Pose{random.normal(), random.normal(), random.uniform()}};
    for (int k = 0; i > 0 && k < 2; ++k) step.odometry.push_back({random.normal(), random.normal(), 0.25});
    for (int k = 0; i < 7 && k < 1 + i % 3; ++k)
      step.measurements.push_back({.range_m = 1.0 + random.uniform(),
                                   .bearing_rad = random.uniform(),
                                   .covariance = Eigen::Matrix2d::Identity(),
                                   .landmark_id = k});
    log.steps.push_back(step);
  }
  log.start = log.steps.front().truth.value();
  return log;
}

RecordedLog read_back(const TestFolder& folder, const MeasurementLog& log) {
  for (const DatasetFile& file : mrclam_writer({})->drive_files(log)) folder.write(file.name, file.bytes());
  return read_log(folder.path(), {.odometry_delay_s = 0.0});
}

// Law: what the layout holds is read back exactly. Meant to catch: six digits; subjects from 1 on, which are
// robots; no reading at the end: the last step is lost; v and w exchanged.
TEST(MrclamFormat, IsReadBackAsItWasMeasured) {
  const TestFolder folder;
  const MeasurementLog log = sighted_log();
  const RecordedLog found = read_back(folder, log);
  ASSERT_EQ(found.log.steps.size(), log.steps.size());
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    const LogStep &step = found.log.steps[i], &wanted = log.steps[i];
    EXPECT_EQ(step.stamp_ns, wanted.stamp_ns);
    EXPECT_EQ(step.truth->x_m, wanted.truth->x_m);
    EXPECT_EQ(step.truth->y_m, wanted.truth->y_m);
    EXPECT_EQ(step.truth->heading_rad, wanted.truth->heading_rad);
    ASSERT_EQ(step.odometry.size(), wanted.odometry.size());
    for (std::size_t k = 0; k < wanted.odometry.size(); ++k) {
      EXPECT_EQ(step.odometry[k].v_mps, wanted.odometry[k].v_mps);
      EXPECT_EQ(step.odometry[k].w_radps, wanted.odometry[k].w_radps);
      EXPECT_EQ(step.odometry[k].duration_s, wanted.odometry[k].duration_s);
    }
    ASSERT_EQ(step.measurements.size(), wanted.measurements.size());
    for (std::size_t k = 0; k < wanted.measurements.size(); ++k) {
      EXPECT_EQ(step.measurements[k].range_m, wanted.measurements[k].range_m);
      EXPECT_EQ(step.measurements[k].bearing_rad, wanted.measurements[k].bearing_rad);
      EXPECT_EQ(step.measurements[k].landmark_id, wanted.measurements[k].landmark_id + 6);
    }
  }
  ASSERT_EQ(found.log.landmarks.size(), log.landmarks.size());
  for (std::size_t i = 0; i < log.landmarks.size(); ++i) {
    EXPECT_EQ(found.log.landmarks[i].landmark_id, log.landmarks[i].landmark_id + 6);
    EXPECT_EQ(found.log.landmarks[i].position_m, log.landmarks[i].position_m);
  }
}

// Meant to catch: the identity of nothing written as that of a robot, 5.
TEST(MrclamFormat, GivesSightingsWithoutIdentityABarcodeOfNobody) {
  const TestFolder folder;
  MeasurementLog log = sighted_log();
  for (LogStep& step : log.steps)
    for (slam::RangeBearing& seen : step.measurements) seen.landmark_id = slam::kUnknown;
  log.steps.front().measurements.front().landmark_id = 0;
  const RecordedLog found = read_back(folder, log);
  long sightings = 0, all = 0;
  for (const LogStep& step : found.log.steps) sightings += std::ssize(step.measurements);
  for (const LogStep& step : log.steps) all += std::ssize(step.measurements);
  EXPECT_EQ(sightings, 1);
  EXPECT_EQ(found.facts.unknown_barcodes, all - 1);
}

// The folder has no picture, nor parts of one.
TEST(MrclamFormat, HasTheLogAlone) {
  const WrittenDrive drive("mrclam");
  for (const char* name : {"Robot1_Odometry.dat", "Robot1_Groundtruth.dat", "Barcodes.dat"})
    EXPECT_TRUE(drive.has(name)) << name;
  EXPECT_FALSE(drive.has("dataset.parts"));
  EXPECT_EQ(words_of(drive.text("Robot1_Groundtruth.dat")).size(), 3U);
}

}  // namespace
}  // namespace stereobench::harness
