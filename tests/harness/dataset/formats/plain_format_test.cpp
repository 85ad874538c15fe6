#include "harness/dataset/formats/plain_format.h"

#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "harness/drive/shutter.h"
#include "renderer/truth/correspondence.h"
#include "tests/harness/dataset/step_writer.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using vision::Side;

/// The room, with a right camera that is late.
struct Drive {
  worlds::Scenario scenario = room_drive();
  Drive() { scenario.shutter.right_delay_s = 0.02; }
  renderer::StereoFrame frame(std::size_t step) const {
    renderer::Renderer renderer(scenario.world, scenario.rig);
    return open_shutter(renderer, scenario.path, step, scenario.shutter).frame;
  }
  StepWriter writer(const TestFolder& folder, const std::string& kinds,
                    TruthFormat format = TruthFormat::kExact) const {
    return {folder, scenario, dataset_format("plain"), {parse_truth(kinds), format}};
  }
};

cv::Mat picture(const TestFolder& folder, const std::string& name) {
  return cv::imread((folder.path() / name).string(), cv::IMREAD_UNCHANGED);
}

// Mutations: both cameras at the left one's time; flow to the step itself, or from the step before.
TEST(PlainFormat, FollowsTheCamerasAtTheTimesOfTheirExposures) {
  const Drive drive;
  const TestFolder folder;
  StepWriter writer = drive.writer(folder, "all");
  writer.write(0, drive.frame(0));
  writer.write(1, drive.frame(1));
  const slam::Pose left = drive.scenario.path[1].pose;
  const slam::Pose next = drive.scenario.path[2].pose;
  const slam::Pose right = worlds::pose_near(drive.scenario.path, 1, 0.02);
  renderer::Renderer renderer(drive.scenario.world, drive.scenario.rig);
  const renderer::StereoIdBuffers ids = renderer.id_buffers(left, right);
  const renderer::SceneGeometry scene(drive.scenario.world);
  const auto disparity =
      renderer::disparity_px(renderer::correspond(scene, ids.left, ids.right), Side::kLeft);
  EXPECT_EQ(cv::norm(picture(folder, "left_disparity/000001.pfm"), disparity, cv::NORM_INF), 0.0);
  const auto flow = renderer::correspond(scene, ids.left, renderer.id_buffers(next, next).left);
  cv::Mat u;
  cv::extractChannel(picture(folder, "left_flow/000001.pfm"), u, 2);
  cv::Mat expected;
  cv::extractChannel(flow.shift_px, expected, 0);
  EXPECT_EQ(cv::countNonZero(u != expected), 0);
  EXPECT_EQ(cv::norm(picture(folder, "left_flow_fate/000001.png"), flow.occlusion, cv::NORM_INF), 0.0);
}

TEST(PlainFormat, HasNoFlowOfTheLastStep) {
  const Drive drive;
  const TestFolder folder;
  StepWriter writer = drive.writer(folder, "flow,match", TruthFormat::kKitti);
  writer.write(2, drive.frame(2));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "left_flow/000002.png"));
  EXPECT_EQ(picture(folder, "right_match/000002.png").type(), CV_16UC3);
}

// Mutation: left identities for both cameras.
TEST(PlainFormat, HasALineForEachBallInView) {
  const Drive drive;
  const TestFolder folder;
  StepWriter writer = drive.writer(folder, "balls,surface");
  writer.write(0, drive.frame(0));
  writer.finish();
  const renderer::StereoFrame frame = drive.frame(0);
  for (const auto& [side, seen] : {std::pair("left", &frame.left), std::pair("right", &frame.right)}) {
    std::istringstream lines(folder.read(std::string(side) + "_balls/000000.jsonl"));
    int id = 0;
    for (std::string line; std::getline(lines, line); ++id) {
      const auto ball = nlohmann::json::parse(line);
      EXPECT_EQ(ball["ball_id"], id);
      EXPECT_EQ(ball["px_count_visib"], cv::countNonZero(seen->ball_id == id + 1));
      EXPECT_EQ(cv::countNonZero(picture(folder, std::string(side) + "_surface/000000.png") == id + 1),
                cv::countNonZero(seen->ball_id == id + 1));
    }
    EXPECT_EQ(id, 2);
  }
  EXPECT_THAT(folder.read("surfaces.csv"), HasSubstr("\n2,ball,1\n255,floor,0\n256,wall,0\n"));
}

// Mutations: a file that is there counts for all; files written over again.
TEST(PlainFormat, WritesWhatIsMissingAndNothingElse) {
  const Drive drive;
  const TestFolder folder;
  StepWriter first = drive.writer(folder, "all");
  first.write(0, drive.frame(0));
  const std::string whole = folder.read("right_normal/000000.pfm");
  for (const char* lost : {"right_normal/000000.pfm", "left_flow_fate/000000.png"})
    std::filesystem::remove(folder.path() / lost);
  folder.write("left_range/000000.pfm", "kept");
  StepWriter again = drive.writer(folder, "all");
  again.write(0, drive.frame(0));
  EXPECT_EQ(folder.read("right_normal/000000.pfm"), whole);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "left_flow_fate/000000.png"));
  EXPECT_EQ(folder.read("left_range/000000.pfm"), "kept");
}

}  // namespace
}  // namespace stereobench::harness
