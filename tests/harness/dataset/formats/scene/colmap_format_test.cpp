#include "harness/dataset/formats/scene/colmap_format.h"

#include <map>

#include <gmock/gmock.h>

#include "tests/harness/dataset/formats/written_drive.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using vision::Side;

/// The lines of images.txt that are no comments; empty ones stay, since they are pictures that show no point.
std::vector<std::string> picture_lines(const WrittenDrive& drive) {
  std::istringstream stream(drive.text("sparse/0/images.txt"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with('#')) lines.push_back(line);
  return lines;
}

std::vector<std::string> words_in(const std::string& line) {
  return line.empty() ? std::vector<std::string>() : words_of(line).front();
}

/// The observations of a picture: point -> place in the file.
std::map<int, Eigen::Vector2d> seen_in(const std::string& line) {
  const std::vector<double> n = as_numbers(words_in(line));
  std::map<int, Eigen::Vector2d> seen;
  for (std::size_t i = 0; i + 2 < n.size(); i += 3) seen[static_cast<int>(n[i + 2])] = {n[i], n[i + 1]};
  return seen;
}

// Law: each picture's pose takes the points to where the picture observes them, which is where the renderer
// says that the centres are, half a pixel further.
TEST(ColmapFormat, ObservesTheCentresOfBallsFromTheTruePoses) {
  const WrittenDrive drive("colmap");
  const auto lines = picture_lines(drive);
  const auto points = words_of(drive.text("sparse/0/points3D.txt"));
  ASSERT_EQ(lines.size(), 12U);  // two lines of each picture
  ASSERT_FALSE(points.empty());
  EXPECT_EQ(points.front().front(), "1");
  const std::vector<double> ball = as_numbers(points.front(), 1);
  for (std::size_t picture = 0; picture < 6; ++picture) {
    const auto words = words_in(lines[2 * picture]);
    const Side side = picture % 2 == 0 ? Side::kLeft : Side::kRight;
    ASSERT_EQ(words.size(), 10U);
    EXPECT_EQ(words[0], std::to_string(picture + 1));
    EXPECT_EQ(words[8], side == Side::kLeft ? "1" : "2");
    EXPECT_TRUE(drive.has("images/" + words[9])) << words[9];
    std::vector<std::string> pose_words(words.begin(), words.begin() + 8);
    const std::vector<double> n = as_numbers(pose_words);
    const Eigen::Isometry3d camera_from_world = pose_of({n[5], n[6], n[7]}, n[1], n[2], n[3], n[4]);
    const Eigen::Vector2d shown = vision::project(
        drive.scenario().rig.intrinsics, camera_from_world * Eigen::Vector3d(ball[0], ball[1], ball[2]));
    const auto seen = seen_in(lines[2 * picture + 1]);
    ASSERT_TRUE(seen.contains(1));
    const Eigen::Vector2d half(0.5, 0.5);
    EXPECT_LT((seen.at(1) - half - shown).norm(), 1e-9);
    EXPECT_LT((seen.at(1) - half - drive.true_ball_px(picture / 2, side)).norm(), 1e-6);
  }
}

// Law: tracks and observations say the same.
TEST(ColmapFormat, HasTracksOfWhatIsSeen) {
  worlds::Scenario scenario = tilted_drive();
  scenario.world.balls[1] = {{2.6, 0.13, 0.3}, 0.05, 5};        // hidden behind ball 0 at first
  scenario.world.balls.push_back({{2.5, -0.2, 0.3}, 0.05, 1});  // never hidden
  const WrittenDrive drive("colmap", scenario);
  const auto lines = picture_lines(drive);
  std::size_t tracked = 0, observed = 0, in_id_pictures = 0;
  for (const auto& point : words_of(drive.text("sparse/0/points3D.txt"))) {
    const std::vector<double> n = as_numbers(point);
    EXPECT_EQ(n[7], 0.0);
    for (std::size_t i = 8; i < n.size(); i += 2, ++tracked) {
      const auto observations = words_in(lines.at(2 * static_cast<std::size_t>(n[i]) - 1));
      EXPECT_EQ(observations.at(3 * static_cast<std::size_t>(n[i + 1]) + 2), point.front());
    }
  }
  for (std::size_t picture = 0; picture < 6; ++picture) {
    const renderer::StereoFrame frame = drive.frame(picture / 2);
    const cv::Mat& ids = picture % 2 == 0 ? frame.left.ball_id : frame.right.ball_id;
    observed += seen_in(lines[2 * picture + 1]).size();
    for (int ball = 1; ball <= 3; ++ball) in_id_pictures += cv::countNonZero(ids == ball) > 0 ? 1U : 0U;
  }
  EXPECT_EQ(tracked, observed);
  EXPECT_EQ(observed, in_id_pictures);
  EXPECT_LT(observed, 18U) << "ball 1 should be hidden somewhere";
  EXPECT_GT(observed, 6U);
}

TEST(ColmapFormat, ChoosesTheModelByTheLens) {
  const auto camera_line = [](const vision::Distortion& lens) {
    worlds::Scenario scenario = tilted_drive();
    scenario.rig.distortion = lens;
    scenario.believed_rig = scenario.rig;
    const WrittenDrive drive("colmap", scenario);
    const std::string text = drive.text("sparse/0/cameras.txt");
    return text.substr(text.find("\n2 ") + 1);
  };
  EXPECT_EQ(camera_line({.pixel_aspect = 1.25}), "2 PINHOLE 160 120 140 175 76.75 64\n");
  EXPECT_EQ(camera_line({.k1 = -0.1, .p2 = 0.002}), "2 OPENCV 160 120 140 140 76.75 64 -0.1 0 0 0.002\n");
  EXPECT_EQ(camera_line({.k1 = -0.1, .k2 = 0.02, .p1 = 0.001, .p2 = 0.002, .k3 = 0.003}),
            "2 FULL_OPENCV 160 120 140 140 76.75 64 -0.1 0.02 0.001 0.002 0.003 0 0 0\n");
}

TEST(ColmapFormat, RefusesWhatItHasNoPlaceFor) {
  using Change = void (*)(worlds::Scenario&);
  const std::vector<std::pair<std::string, Change>> cases = {
      {"believed_rig", [](worlds::Scenario& scenario) { scenario.believed_rig.baseline_m = 0.13; }},
      {"shutter.readout_s", [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; }}};
  for (const auto& [line, change] : cases) {
    worlds::Scenario scenario = room_drive();
    change(scenario);
    EXPECT_THAT(
        [&] { check_colmap_format(drive_of(scenario, scenario.world, 0)); },
        ThrowsMessage<std::runtime_error>(HasSubstr("the format colmap has no place for " + line + ";")));
  }
}

}  // namespace
}  // namespace stereobench::harness
