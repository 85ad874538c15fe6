/// frames.csv says which frames were late or dropped, as the pictures have it.
#include "harness/dataset/dataset_drive.h"

#include <sstream>

#include <gtest/gtest.h>

#include "harness/drive/recording.h"
#include "renderer/renderer.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

worlds::Scenario odd_shutter() {
  worlds::Scenario scenario;
  scenario.rig.intrinsics = {160, 120, 140.0, 79.5, 59.5};
  scenario.believed_rig = scenario.rig;
  scenario.shutter.late_s = 0.03;
  scenario.shutter.late_probability = 0.5;
  scenario.shutter.drop_probability = 0.3;
  scenario.shutter.right_delay_s = 0.02;
  scenario.world.balls = {{{2.0, 0.1, 0.3}, 0.1, 3}};
  for (int i = 0; i < 20; ++i)
    scenario.path.push_back({i * 100'000'000LL, {0.05 * i, 0.0, 0.02 * i}, {{0.5, 0.2, 0.1}}});
  scenario.path.front().controls.clear();
  return scenario;
}

std::vector<std::vector<std::string>> cells(const std::string& csv) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream row(line + ",");
    for (std::string cell; std::getline(row, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

// Each picture that was recorded is what is seen from the pose that stands there. Mutations: the pose of the
// step; a draw in another order; another seed.
TEST(DatasetDrive, SaysWhichFramesWereLateOrDroppedAndFromWhereTheyWereTaken) {
  const worlds::Scenario scenario = odd_shutter();
  const std::uint64_t seed = 5;
  const auto rows = cells(frames_csv(drive_of(scenario, scenario.world, seed)));
  ASSERT_EQ(rows.size(), 21U);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"step", "t_s", "has_pictures", "late_s", "x_m", "y_m",
                                               "theta_rad", "right_x_m", "right_y_m", "right_theta_rad"}));
  renderer::Renderer renderer(scenario.world, scenario.rig);
  std::size_t seen = 0, late = 0;
  record({.scenario = scenario}, seed, {.on_frame = [&](const FrameEvent& look) {
           const auto& row = rows.at(look.step + 1);
           ASSERT_EQ(row[0], std::to_string(look.step));
           ASSERT_EQ(row[2], "1");
           EXPECT_EQ(std::stod(row[3]), look.late_s);
           const slam::Pose pose{std::stod(row[4]), std::stod(row[5]), std::stod(row[6])};
           EXPECT_EQ(cv::norm(renderer.render(pose).left.colour, look.frame.left.colour, cv::NORM_INF), 0.0);
           const slam::Pose right{std::stod(row[7]), std::stod(row[8]), std::stod(row[9])};
           EXPECT_EQ(cv::norm(renderer.render(right).right.colour, look.frame.right.colour, cv::NORM_INF),
                     0.0);
           ++seen;
           late += look.late_s > 0.0 ? 1 : 0;
         }});
  std::size_t dropped = 0;
  for (const auto& row : rows)
    if (row[2] == "0") {
      ++dropped;
      EXPECT_EQ(row[3] + row[4] + row[5] + row[6] + row[7] + row[8] + row[9], "");
    }
  EXPECT_EQ(seen + dropped, 20U);
  EXPECT_GT(dropped, 2U);
  EXPECT_GT(late, 2U);
  EXPECT_LT(late, seen);
}

// Mutation: frames that are not wanted have pictures.
TEST(DatasetDrive, HasPicturesOfThoseThatAreWantedAlone) {
  worlds::Scenario scenario = odd_shutter();
  scenario.shutter.drop_probability = 0.0;
  const auto rows =
      cells(frames_csv(drive_of(scenario, scenario.world, 5, {.first = 2, .last = 10, .stride = 4})));
  for (std::size_t step = 0; step < 20; ++step)
    EXPECT_EQ(rows.at(step + 1)[2], step == 2 || step == 6 || step == 10 ? "1" : "0") << step;
}

}  // namespace
}  // namespace stereobench::harness
