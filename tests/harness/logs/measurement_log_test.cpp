#include <cmath>

#include <gmock/gmock.h>

#include "harness/logs/measurement_log_reader.h"
#include "harness/logs/measurement_log_writer.h"
#include "slam/math/random.h"
#include "slam/models/motion.h"
#include "tests/harness/logs/log_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(STEREOBENCH_SOURCE_DIR) / ".." / "shared" / "data";

/// A log as rendering would record it: every part is there, and some steps see nothing.
MeasurementLog random_log(std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  MeasurementLog log;
  for (int i = 0; i < 5; ++i) log.landmarks.push_back({i, i % 2, {random.normal(), random.normal()}});
  std::int64_t stamp_ns = 1'000'000'007 * static_cast<std::int64_t>(seed) - 3'000'000'000;
  for (int i = 0; i < 12; ++i) {
    LogStep step;
    for (int k = 0; i > 0 && k < 3; ++k) {
      const std::int64_t held_ns = 1 + std::llround(random.uniform() * 1e9);
      step.odometry.push_back({random.normal(), random.normal(), static_cast<double>(held_ns) * 1e-9});
      stamp_ns += held_ns;
    }
    step.stamp_ns = stamp_ns;
    for (int k = 0; k < i % 4; ++k) {
      const Eigen::Matrix2d root =
          Eigen::Matrix2d{{random.normal(), 0.0}, {random.normal(), random.normal()}};
      slam::RangeBearing z{std::abs(random.normal()), random.uniform() * 6.28 - 3.14, root * root.transpose(),
                           k - 1, 1 - k};
      z.colour_class = std::max(z.colour_class, slam::kUnknown);
      step.measurements.push_back(z);
    }
    step.truth = slam::Pose{random.normal(), random.normal(), random.uniform()};
    log.steps.push_back(step);
  }
  log.start = *log.steps.front().truth;
  return log;
}

void expect_same(const slam::Pose& a, const slam::Pose& b, double tolerance) {
  EXPECT_NEAR(a.x_m, b.x_m, tolerance);
  EXPECT_NEAR(a.y_m, b.y_m, tolerance);
  EXPECT_NEAR(slam::wrap_angle(a.heading_rad - b.heading_rad), 0.0, tolerance);
}

void expect_same_measurements(const LogStep& a, const LogStep& b, double tolerance) {
  ASSERT_EQ(a.measurements.size(), b.measurements.size());
  for (std::size_t i = 0; i < a.measurements.size(); ++i) {
    EXPECT_NEAR(a.measurements[i].range_m, b.measurements[i].range_m, tolerance);
    EXPECT_NEAR(a.measurements[i].bearing_rad, b.measurements[i].bearing_rad, tolerance);
    EXPECT_EQ(a.measurements[i].landmark_id, b.measurements[i].landmark_id);
    EXPECT_EQ(a.measurements[i].colour_class, b.measurements[i].colour_class);
    EXPECT_NEAR((a.measurements[i].covariance - b.measurements[i].covariance).norm(), 0.0, tolerance);
  }
}

void expect_same_odometry(const LogStep& a, const LogStep& b, double duration_tolerance_s) {
  ASSERT_EQ(a.odometry.size(), b.odometry.size());
  for (std::size_t i = 0; i < a.odometry.size(); ++i) {
    EXPECT_EQ(a.odometry[i].v_mps, b.odometry[i].v_mps);
    EXPECT_EQ(a.odometry[i].w_radps, b.odometry[i].w_radps);
    EXPECT_NEAR(a.odometry[i].duration_s, b.odometry[i].duration_s, duration_tolerance_s);
  }
}

class AnyLog : public testing::TestWithParam<std::uint64_t> {};

// Law: a log that was written and read has the same readings, to the nanosecond: what is made of them is the
// same when it is exported. Meant to catch: stamps cut in place of rounded.
TEST_P(AnyLog, HasTheSameReadingsWhenItIsReadBack) {
  const TestFolder folder;
  const MeasurementLog log = random_log(GetParam());
  write_log(folder.path(), log);
  const auto wanted = odometry_readings(log),
             found = odometry_readings(read_log(folder.path(), {.odometry_delay_s = 0.0}).log);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_EQ(found[i].stamp_ns, wanted[i].stamp_ns);
    EXPECT_EQ(found[i].v_mps, wanted[i].v_mps);
    EXPECT_EQ(found[i].w_radps, wanted[i].w_radps);
  }
}

// Mutations: writing six digits, transposing or dropping the covariance, leaving out the steps that see
// nothing (no instants.csv), stamping a reading with the end of its hold, exchanging v and w.
TEST_P(AnyLog, IsReadBackAsItWasWritten) {
  const TestFolder folder;
  const MeasurementLog log = random_log(GetParam());
  write_log(folder.path(), log);
  const RecordedLog back = read_log(folder.path(), {});
  ASSERT_EQ(back.log.steps.size(), log.steps.size());
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    EXPECT_EQ(back.log.steps[i].stamp_ns, log.steps[i].stamp_ns);
    expect_same_odometry(back.log.steps[i], log.steps[i], 1.5e-9);
    expect_same_measurements(back.log.steps[i], log.steps[i], 0.0);
    expect_same(*back.log.steps[i].truth, *log.steps[i].truth, 0.0);
  }
  expect_same(back.log.start, log.start, 0.0);
  ASSERT_EQ(back.log.landmarks.size(), log.landmarks.size());
  for (std::size_t i = 0; i < log.landmarks.size(); ++i) {
    EXPECT_EQ(back.log.landmarks[i].landmark_id, log.landmarks[i].landmark_id);
    EXPECT_EQ(back.log.landmarks[i].colour_class, log.landmarks[i].colour_class);
    EXPECT_EQ(back.log.landmarks[i].position_m, log.landmarks[i].position_m);
  }
}

TEST_P(AnyLog, WritingWhatWasReadChangesNoByte) {
  const TestFolder folder;
  fs::create_directories(folder.path() / "a");
  fs::create_directories(folder.path() / "b");
  write_log(folder.path() / "a", random_log(GetParam()));
  write_log(folder.path() / "b", read_log(folder.path() / "a", {}).log);
  for (const char* name : {"odometry", "observations", "landmarks", "groundtruth", "instants"}) {
    const std::string file = std::string(name) + ".csv";
    EXPECT_EQ(folder.read("a/" + file), folder.read("b/" + file)) << file;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyLog, testing::Range<std::uint64_t>(0, 20));

TEST(LogFiles, RefusesALogThatCouldNotBeReadBack) {
  MeasurementLog log = random_log(1);
  log.start.x_m += 1.0;
  EXPECT_THROW(log_files(log), std::invalid_argument);
  log = random_log(1);
  log.steps[3].odometry[1].duration_s += 1e-5;
  EXPECT_THROW(log_files(log), std::invalid_argument);
  log = random_log(1);
  log.steps[0].odometry.push_back({1.0, 0.0, 0.1});
  EXPECT_THROW(log_files(log), std::invalid_argument);
  EXPECT_THROW(log_files(MeasurementLog{}), std::invalid_argument);
}

TEST(ReadLog, UnderstandsTheSmallLog) {
  const TestFolder folder;
  write_small_csv_log(folder);
  const MeasurementLog log = read_log(folder.path() / "log", {0.2, 0.03}).log;
  ASSERT_EQ(log.steps.size(), 4U);  // 0, 0.5, 1.5 and 2 s
  const slam::RangeBearing& seen = log.steps[1].measurements.at(0);
  EXPECT_EQ(seen.landmark_id, 7);
  EXPECT_EQ(seen.colour_class, slam::kUnknown);
  EXPECT_DOUBLE_EQ(seen.covariance(0, 0), 0.04);
  EXPECT_DOUBLE_EQ(seen.covariance(1, 1), 0.0009);
  EXPECT_DOUBLE_EQ(log.steps[2].truth->heading_rad, 0.25);
  EXPECT_EQ(log.landmarks.at(0).position_m, Eigen::Vector2d(3.0, 0.0));
}

TEST(ReadLog, TakesAFileOfTheFolderGzipWindowsLineEndsAndTheParentsLandmarks) {
  const TestFolder folder;
  write_small_csv_log(folder);
  const MeasurementLog plain = read_log(folder.path() / "log", {}).log;
  fs::rename(folder.path() / "log/landmarks.csv", folder.path() / "landmarks.csv");
  fs::remove(folder.path() / "log/odometry.csv");
  write_gz(folder.path() / "log/odometry.csv.gz", "t_s,v_mps,w_radps\r\n0,1,0\r\n1.0,1e0,0.5\r\n2,0,0");
  const MeasurementLog packed = read_log(folder.path() / "log/odometry.csv.gz", {}).log;
  ASSERT_EQ(packed.steps.size(), plain.steps.size());
  EXPECT_EQ(packed.landmarks.size(), 1U);
  for (std::size_t i = 0; i < plain.steps.size(); ++i) {
    expect_same_odometry(packed.steps[i], plain.steps[i], 0.0);
    expect_same_measurements(packed.steps[i], plain.steps[i], 0.0);
  }
}

TEST(ReadLog, GoesWithoutTruthAndLandmarks) {
  const TestFolder folder;
  write_small_csv_log(folder);
  fs::remove(folder.path() / "log/groundtruth.csv");
  fs::remove(folder.path() / "log/landmarks.csv");
  const MeasurementLog log = read_log(folder.path() / "log", {}).log;
  EXPECT_TRUE(log.landmarks.empty());
  for (const LogStep& step : log.steps) EXPECT_FALSE(step.truth.has_value());
}

// Mutation: keeping stamps as doubles, which near this epoch resolve 240 ns only.
TEST(ReadLog, KeepsNanosecondsNearAUnixEpoch) {
  const TestFolder folder;
  write_small_csv_log(folder);
  folder.write("log/odometry.csv", "t_s,v_mps,w_radps\n1248446188.000000001,1,0\n1248446188.500000007,1,0\n");
  folder.write("log/observations.csv", "t_s,landmark_id,range_m,bearing_rad\n");
  const MeasurementLog log = read_log(folder.path() / "log", {}).log;
  EXPECT_EQ(log.steps.front().stamp_ns, 1'248'446'188'000'000'001);
  EXPECT_EQ(log.steps.back().stamp_ns, 1'248'446'188'500'000'007);
}

TEST(ReadLog, ReadsNegativeTimesAndExponents) {
  const TestFolder folder;
  write_small_csv_log(folder);
  folder.write("log/observations.csv", "t_s,landmark_id,range_m,bearing_rad\n");
  folder.write("log/odometry.csv", "t_s,v_mps,w_radps\n-0.25,1,0\n-1e-1,1,0\n.5,1,0\n");
  const MeasurementLog log = read_log(folder.path() / "log", {}).log;
  EXPECT_EQ(log.steps.front().stamp_ns, -250'000'000);
  EXPECT_EQ(log.steps.back().stamp_ns, 500'000'000);
  EXPECT_DOUBLE_EQ(log.steps.back().odometry.at(0).duration_s, 0.15);
}

// Mutations: taking the barcode for the subject; keeping the other robots; dropping them uncounted.
TEST(ReadMrclam, TranslatesBarcodesAndCountsWhatIsNoLandmark) {
  const TestFolder folder;
  write_small_csv_log(folder);
  const MeasurementLog csv = read_log(folder.path() / "log", {}).log;
  fs::remove_all(folder.path() / "log");
  write_small_mrclam_log(folder);
  const RecordedLog recorded = read_log(folder.path() / "log", {});
  EXPECT_EQ(recorded.facts.robot_sightings, 1);
  EXPECT_EQ(recorded.facts.unknown_barcodes, 1);
  ASSERT_EQ(recorded.log.steps.size(), csv.steps.size());
  for (std::size_t i = 0; i < csv.steps.size(); ++i) {
    EXPECT_EQ(recorded.log.steps[i].stamp_ns, csv.steps[i].stamp_ns);
    expect_same_odometry(recorded.log.steps[i], csv.steps[i], 1e-12);
    expect_same_measurements(recorded.log.steps[i], csv.steps[i], 0.0);
    expect_same(*recorded.log.steps[i].truth, *csv.steps[i].truth, 1e-12);
  }
}

// The CSVs were made from the authors' files by someone else, rounded to 1 ms and 0.01 mm.
TEST(ReadMrclam, BothFormatsOfRobot5AreTheSameRun) {
  if (!fs::exists(kData / "mrclam_original")) GTEST_SKIP() << "no MRCLAM data beside this checkout";
  const RecordedLog dat = read_log(kData / "mrclam_original/ds7_robot5", {});
  const RecordedLog csv = read_log(kData / "mrclam/ds7/robot5", {});
  EXPECT_EQ(dat.facts.robot_sightings, 4760 - 3424);
  EXPECT_EQ(dat.facts.unknown_barcodes, 0);
  EXPECT_EQ(dat.log.landmarks.size(), 15U);
  ASSERT_EQ(dat.log.steps.size(), csv.log.steps.size());
  std::size_t sightings = 0;
  for (std::size_t i = 0; i < dat.log.steps.size(); ++i) {
    ASSERT_EQ(dat.log.steps[i].stamp_ns, csv.log.steps[i].stamp_ns);
    expect_same_odometry(dat.log.steps[i], csv.log.steps[i], 0.0);
    expect_same_measurements(dat.log.steps[i], csv.log.steps[i], 0.0);
    ASSERT_EQ(dat.log.steps[i].truth.has_value(), csv.log.steps[i].truth.has_value());
    if (dat.log.steps[i].truth) expect_same(*dat.log.steps[i].truth, *csv.log.steps[i].truth, 1.1e-5);
    sightings += dat.log.steps[i].measurements.size();
  }
  EXPECT_EQ(sightings, 3424U);
}

// An independent look at the same data: a sighted landmark lies where truth and measurement put it.
// Mutations: barcodes not translated, bearings with the wrong sign, truth a second late.
TEST(ReadMrclam, SightingsOfRobot2PointAtTheLandmarks) {
  if (!fs::exists(kData / "mrclam")) GTEST_SKIP() << "no MRCLAM data beside this checkout";
  const MeasurementLog log = read_log(kData / "mrclam/ds7/robot2", {}).log;
  std::vector<double> misses_m;
  for (const LogStep& step : log.steps) {
    if (!step.truth) continue;
    for (const slam::RangeBearing& z : step.measurements) {
      const double direction = step.truth->heading_rad + z.bearing_rad;
      const Eigen::Vector2d there(step.truth->x_m + z.range_m * std::cos(direction),
                                  step.truth->y_m + z.range_m * std::sin(direction));
      for (const LandmarkTruth& landmark : log.landmarks) {
        if (landmark.landmark_id == z.landmark_id) misses_m.push_back((landmark.position_m - there).norm());
      }
    }
  }
  ASSERT_EQ(misses_m.size(), 3818U);
  std::nth_element(misses_m.begin(), misses_m.begin() + 1909, misses_m.end());
  EXPECT_LT(misses_m[1909], 0.15);
}

}  // namespace
}  // namespace stereobench::harness
