// Odometry of wheels, of a steered car, and of whoever compares pictures or scans.
#include "harness/logs/odometry_tables.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/logs/measurement_log_reader.h"
#include "slam/filter_registry.h"
#include "slam/models/motion.h"
#include "tests/complaint.h"
#include "tests/harness/logs/log_folder.h"

namespace stereobench::harness {
namespace {

const std::string kSteeringHeader = "t_s,v_mps,steering_rad,wheelbase_m\n";
const std::string kRelativeHeader =
    "from_s,to_s,x_m,y_m,theta_rad,x_var_m2,xy_m2,xt_m_rad,y_var_m2,yt_m_rad,theta_var_rad2\n";

// What dead reckoning makes of the small log with another odometry.
slam::Estimate reckoned(const std::string& odometry) {
  const TestFolder folder;
  write_small_csv_log(folder);
  folder.write("log/odometry.csv", odometry);
  const RecordedLog recorded = read_log(folder.path() / "log", {.odometry_delay_s = 0.0});
  slam::Filter filter = slam::make_filter("dead_reckoning", {}, recorded.log.start, 0);
  for (const LogStep& step : recorded.log.steps)
    for (const slam::Control& control : step.odometry) slam::predict(filter, control);
  return slam::estimate(filter);
}

// With a wheelbase of 2 m and wheels at 45 degrees a car turns about a point 2 m to its left. Mutations seen
// to turn this red: the sine of the steering; the turn rate times the wheelbase.
TEST(OdometryTables, ASteeredCarTurnsAboutThePointThatItsAxlesMeetIn) {
  const double quarter_s = 0.5 * M_PI * 2.0;  // at 1 m/s
  const slam::Estimate there =
      reckoned(kSteeringHeader + fmt::format("0,1,{},2\n{},0,0,2\n", 0.25 * M_PI, quarter_s));
  EXPECT_NEAR(there.pose.x_m, 2.0, 1e-6);
  EXPECT_NEAR(there.pose.y_m, 2.0, 1e-6);
  EXPECT_NEAR(there.pose.heading_rad, 0.5 * M_PI, 1e-6);
}

// Steps of a log cut poses into parts; put together they are the poses again, and their covariance is that of
// the poses one behind the other. Mutations seen to turn this red: parts as uncertain as the whole; y to the
// right; the covariance's columns exchanged.
TEST(OdometryTables, RelativePosesAddUp) {
  const slam::Estimate there = reckoned(
      kRelativeHeader + "0,1,0.4,0.1,0.3,1e-4,0,0,4e-4,1e-5,1e-4\n1,2,0.4,-0.1,-0.3,1e-4,0,0,4e-4,0,1e-4\n");
  const slam::Pose end = slam::compose({0.4, 0.1, 0.3}, {0.4, -0.1, -0.3});
  EXPECT_NEAR(there.pose.x_m, end.x_m, 1e-9);
  EXPECT_NEAR(there.pose.y_m, end.y_m, 1e-9);
  EXPECT_NEAR(there.pose.heading_rad, end.heading_rad, 1e-9);
  EXPECT_NEAR(there.covariance(2, 2), 2e-4, 1e-9);
  EXPECT_NEAR(there.covariance(0, 0), 2.3e-4, 0.2e-4);
  EXPECT_NEAR(there.covariance(1, 1), 8.0e-4, 0.5e-4);
  EXPECT_GT(there.covariance(1, 2), 3e-5);
}

TEST(OdometryTables, StatedNoiseIsNotAssumed) {
  const TestFolder folder;
  write_small_csv_log(folder);
  folder.write("log/odometry.csv", kRelativeHeader + "0,2,1,0,0,1e-4,0,0,1e-4,0,1e-4\n");
  const RecordedLog recorded = read_log(folder.path() / "log", {});
  for (const std::string& line : assumptions_of(recorded.facts, {}))
    EXPECT_THAT(line, testing::Not(testing::HasSubstr("--v-constant-mps")));
}

// Each is a mutation of the reader's: leave out the check, and the table is read.
TEST(OdometryTables, AreRefusedByLineAndColumn) {
  const std::string row = kRelativeHeader + "0,1,0.4,0.1,0.3,1e-4,0,0,1e-4,0,1e-4\n";
  const std::vector<std::pair<std::string, const char*>> cases = {
      {"t_s,v_mps\n0,1\n", "odometry.csv:1: "},
      {kSteeringHeader, "at least one reading"},
      {kSteeringHeader + "0,1,1.6,2\n",
       "odometry.csv:2: steering_rad: expected radians, less than a quarter"},
      {kSteeringHeader + "0,1,0.1,0\n", "odometry.csv:2: wheelbase_m: expected metres, more than 0"},
      {kSteeringHeader + "1,1,0.1,2\n0,1,0.1,2\n", "odometry.csv:3: t_s: expected a time not before"},
      {row + "1.5,2,0.4,0.1,0.3,1e-4,0,0,1e-4,0,1e-4\n",
       "odometry.csv:3: from_s: expected the time at which"},
      {row + "1,1,0.4,0.1,0.3,1e-4,0,0,1e-4,0,1e-4\n", "odometry.csv:3: to_s: expected a time after"},
      {row + "1,2,0.4,0.1,7,1e-4,0,0,1e-4,0,1e-4\n", "odometry.csv:3: theta_rad: expected radians"},
      {row + "1,2,0.4,0.1,0,1e-4,0,0,-1e-4,0,1e-4\n", "odometry.csv:3: y_var_m2: expected a variance"},
      {row + "1,2,0.4,0.1,0,1e-4,2e-4,0,1e-4,0,1e-4\n",
       "odometry.csv:3: xy_m2: expected covariances no larger"}};
  for (const auto& [text, message] : cases) {
    const TestFolder folder;
    folder.write("odometry.csv", text);
    EXPECT_THAT(complaint_of([&] { read_odometry(folder.path() / "odometry.csv"); }),
                testing::HasSubstr(message))
        << text;
  }
}

}  // namespace
}  // namespace stereobench::harness
