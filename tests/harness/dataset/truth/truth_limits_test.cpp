/// Truth of pictures that were not taken through a pinhole at one instant, and which there is none of.

#include "harness/dataset/truth/truth_limits.h"

#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "renderer/camera/lens.h"
#include "renderer/truth/distorted_ids.h"
#include "tests/harness/dataset/step_writer.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// A robot that turns, in a room with two balls.
worlds::Scenario turning() {
  worlds::Scenario scenario;
  scenario.rig.intrinsics = {160, 120, 140.0, 79.5, 59.5};
  scenario.world.balls = {{{2.0, 0.1, 0.3}, 0.2, 3}, {{2.6, -0.4, 0.3}, 0.2, 5}};
  scenario.world.walls = {{{4.0, -3.0}, {4.0, 3.0}, 2.5, worlds::Material::kPlaster}};
  for (int i = 0; i < 2; ++i) {
    const slam::Pose pose{0.0, 0.0, 0.3 * i};
    scenario.path.push_back({i * 100'000'000LL, pose, {{0.0, 3.0, 0.1}}});
  }
  scenario.path.front().controls.clear();
  return scenario;
}

/// The surfaces of the second step in the left camera, as they are written.
cv::Mat written_surface(const worlds::Scenario& scenario, const renderer::StereoFrame& frame, double late_s) {
  const TestFolder folder;
  StepWriter writer(folder, scenario, dataset_format("plain"), {parse_truth("surface,range,normal")});
  writer.write(1, frame, late_s);
  return cv::imread((folder.path() / "left_surface/000001.png").string(), cv::IMREAD_UNCHANGED);
}

/// In how many pixels the surface is another ball than the picture's identity says.
int other_balls(const cv::Mat& surface, const cv::Mat& ball_id) {
  cv::Mat ids, balls = surface.clone();
  ball_id.convertTo(ids, CV_16U);
  balls.setTo(0, surface > 254);
  return cv::countNonZero(balls != ids);
}

// Mutations: all rows at the middle one's time; the right camera's for the left one's; not late.
TEST(RollingTruth, IsThatOfEachRowsInstant) {
  worlds::Scenario scenario = turning();
  const renderer::StereoFrame still =
      renderer::Renderer(scenario.world, scenario.rig).render(scenario.path[1].pose);
  scenario.shutter.readout_s = 0.1;  // 17 degrees, 40 px
  renderer::Renderer renderer(scenario.world, scenario.rig);
  for (const double late_s : {0.0, -0.02}) {
    const renderer::StereoFrame frame =
        open_shutter(renderer, scenario.path, 1, scenario.shutter, late_s).frame;
    EXPECT_GT(cv::countNonZero(frame.left.ball_id != still.left.ball_id), 100);
    EXPECT_EQ(other_balls(written_surface(scenario, frame, late_s), frame.left.ball_id), 0) << late_s;
  }
}

// Mutation: not late.
TEST(LateTruth, IsThatOfWhenTheCamerasExposed) {
  const worlds::Scenario scenario = turning();
  renderer::Renderer renderer(scenario.world, scenario.rig);
  const renderer::StereoFrame frame = open_shutter(renderer, scenario.path, 1, scenario.shutter, -0.03).frame;
  EXPECT_EQ(other_balls(written_surface(scenario, frame, -0.03), frame.left.ball_id), 0);
}

// Mutation: the cameras exchanged.
TEST(TruthBehindALens, IsThatOfDistortedRays) {
  worlds::Scenario scenario = turning();
  scenario.rig.distortion = {.k1 = -0.25, .k2 = 0.08};
  const renderer::StereoFrame frame =
      renderer::Renderer(scenario.world, scenario.rig).render(scenario.path[1].pose);
  const cv::Mat surface = written_surface(scenario, frame, 0.0);
  ASSERT_EQ(surface.size(), frame.left.ball_id.size());
  EXPECT_LE(other_balls(surface, frame.left.ball_id), 60);  // along outlines: ids are the nearest ray's
  EXPECT_GT(cv::countNonZero(frame.left.ball_id), 900);
}

// Mutation: no look at any of the lines.
TEST(TruthLimits, AreNamedWithTheLineThatIsInTheWay) {
  using Change = void (*)(worlds::Scenario&);
  struct Case {
    const char* kind;
    Change change;
    const char* line;
  };
  const Change lens = [](worlds::Scenario& scenario) { scenario.rig.distortion.k1 = 0.1; };
  const Change rolls = [](worlds::Scenario& scenario) { scenario.shutter.readout_s = 0.01; };
  const Change both = [](worlds::Scenario& scenario) {
    scenario.rig.distortion.k1 = 0.1;
    scenario.shutter.readout_s = 0.01;
  };
  const Change late = [](worlds::Scenario& scenario) { scenario.shutter.late_probability = 0.1; };
  const Change lost = [](worlds::Scenario& scenario) { scenario.shutter.drop_probability = 0.1; };
  for (const Case& refused :
       {Case{"balls", lens, "rig.distortion"}, Case{"balls", rolls, "shutter.readout_s"},
        Case{"disparity", rolls, "shutter.readout_s"}, Case{"match", rolls, "shutter.readout_s"},
        Case{"flow", rolls, "shutter.readout_s"}, Case{"flow", late, "shutter.late_probability"},
        Case{"flow", lost, "shutter.drop_probability"}, Case{"range", both, "behind rig.distortion"}}) {
    worlds::Scenario scenario = turning();
    refused.change(scenario);
    EXPECT_THAT(
        [&] { require_truth({parse_truth(refused.kind)}, scenario.rig, scenario.shutter); },
        ThrowsMessage<std::runtime_error>(testing::AllOf(HasSubstr(refused.kind), HasSubstr(refused.line))));
  }
  for (const auto& [kinds, change] :
       {std::pair("surface,range,normal,disparity,match,flow", lens),
        std::pair("surface,range,normal", rolls), std::pair("balls,disparity,match", late),
        std::pair("balls,disparity,match", lost)}) {
    worlds::Scenario scenario = turning();
    change(scenario);
    EXPECT_NO_THROW(require_truth({parse_truth(kinds)}, scenario.rig, scenario.shutter)) << kinds;
  }
}

}  // namespace
}  // namespace stereobench::harness
