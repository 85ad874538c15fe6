/// A camera that moves while it looks, that is late, that loses frames, and that is not the one believed in.
///
/// Mutations seen red here: the delay given to the left camera, half the shutter time, the first instant for
/// the average, vision told of the true rig, every frame kept.

#include "harness/drive/shutter.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "harness/drive/recording.h"
#include "renderer/truth/correspondence.h"
#include "renderer/truth/scene_geometry.h"
#include "slam/models/motion.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

/// Two balls ahead of a robot that drives a bend.
worlds::Scenario bend() {
  worlds::Scenario scenario{.name = "bend"};
  scenario.world.balls = {{{2.0, 0.2, 0.3}, 0.1, 0}, {{2.5, -0.4, 0.3}, 0.1, 6}};
  scenario.rig.intrinsics = {320, 240, 280.0, 159.5, 119.5};
  scenario.believed_rig = scenario.rig;
  scenario.path = worlds::drive_circle({{}, 2.0, 0.5, 0.05, 0.1});
  return scenario;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(Shutter, WithoutTimeOrDelayIsARendering) {
  const worlds::Scenario scenario = bend();
  renderer::Renderer renderer(scenario.world, scenario.rig);
  const renderer::StereoFrame seen = open_shutter(renderer, scenario.path, 2, scenario.shutter).frame;
  const renderer::StereoFrame rendered = renderer.render(scenario.path[2].pose);
  EXPECT_TRUE(same(seen.left.colour, rendered.left.colour));
  EXPECT_TRUE(same(seen.right.colour, rendered.right.colour));
  EXPECT_TRUE(same(seen.right.ball_id, rendered.right.ball_id));
}

TEST(Shutter, ADelayMovesTheRightCameraAlone) {
  const worlds::Scenario scenario = bend();
  renderer::Renderer renderer(scenario.world, scenario.rig);
  const renderer::StereoFrame seen = open_shutter(renderer, scenario.path, 2, {.right_delay_s = 0.05}).frame;
  const renderer::StereoFrame now = renderer.render(scenario.path[2].pose);
  const renderer::StereoFrame later = renderer.render(worlds::pose_near(scenario.path, 2, 0.05));
  EXPECT_TRUE(same(seen.left.colour, now.left.colour));
  EXPECT_TRUE(same(seen.right.colour, later.right.colour));
  EXPECT_FALSE(same(now.right.colour, later.right.colour));
}

// Light is not lost, and a rim that moves by d pixels is smeared over d: a uniform blur has variance d^2
// / 12.
TEST(Shutter, BlursWhatMovesByHowFarItMoves) {
  worlds::Scenario scenario = bend();
  scenario.world.sky_rgb = {0.0, 0.0, 0.0};
  scenario.world.balls.resize(1);
  scenario.world.light.ambient = 1.0;
  scenario.world.light.diffuse = 0.0;
  scenario.rig.pitch_down_rad = -0.5;  // the ball before the sky
  scenario.world.balls[0].centre_m = {2.0, 0.0, 1.4};
  renderer::Renderer renderer(scenario.world, scenario.rig);
  const auto moments = [&](const cv::Mat& picture) {
    cv::Mat channel;
    cv::extractChannel(picture, channel, 2);
    return cv::moments(channel);
  };
  const auto column_at = [&](double offset_s) {
    const cv::Moments m = moments(renderer.render(worlds::pose_near(scenario.path, 2, offset_s)).left.colour);
    return m.m10 / m.m00;
  };
  const cv::Moments sharp = moments(renderer.render(scenario.path[2].pose).left.colour);
  const worlds::Shutter shutter{.open_s = 0.2, .samples = 40};
  const cv::Moments blurred = moments(open_shutter(renderer, scenario.path, 2, shutter).frame.left.colour);
  const double moved_px = column_at(0.1) - column_at(-0.1);
  EXPECT_GT(std::abs(moved_px), 5.0);
  EXPECT_NEAR(blurred.m00 / sharp.m00, 1.0, 0.01);
  EXPECT_NEAR(blurred.mu20 / blurred.m00 - sharp.mu20 / sharp.m00, moved_px * moved_px / 12.0,
              0.03 * moved_px * moved_px / 12.0);
}

/// How far apart, in pixels, the copies are that a wall's end is blurred to: the longest run of equal levels
/// within the ramp of a row.
int longest_stair_px(const cv::Mat& picture, int row) {
  int longest = 0, run = 1;
  double low = 0.0, high = 0.0;
  cv::Mat channel;
  cv::extractChannel(picture.row(row), channel, 1);
  cv::minMaxLoc(channel, &low, &high);
  for (int u = 1; u < channel.cols; ++u) {
    const int level = channel.at<std::uint8_t>(0, u);
    run = level == channel.at<std::uint8_t>(0, u - 1) ? run + 1 : 1;
    if (level > low + 2.0 && level < high - 2.0) longest = std::max(longest, run);
  }
  return longest;
}

/// A robot that turns on the spot before a bright wall that ends ahead of it, the sky black behind it.
worlds::Scenario turning_before_an_end(double turn_radps) {
  worlds::Scenario scenario{.name = "turning"};
  scenario.world.walls = {{{3.0, 0.0}, {3.0, -20.0}, 9.0, worlds::Material::kPaint}};
  scenario.world.has_floor = false;
  scenario.world.sky_rgb = {0.0, 0.0, 0.0};
  scenario.rig.intrinsics = {320, 240, 280.0, 159.5, 119.5};
  const std::vector<slam::Control> turn = {{0.0, turn_radps, 0.5}};
  slam::Pose pose{0.0, 0.0, -0.5 * turn_radps};
  for (int i = 0; i < 3; ++i) {
    scenario.path.push_back({i * 500'000'000LL, pose, i == 0 ? std::vector<slam::Control>() : turn});
    pose = slam::advance(pose, turn.front());
  }
  return scenario;
}

// A blur of 90 px of 8 instants is a staircase of 11 px steps; it should be a ramp. Mutations:
// shutter.samples alone; a limit that is not kept.
TEST(Shutter, DrawsAsManyInstantsAsPointsGoPixels) {
  constexpr double kOpen_s = 0.2;
  for (const double blur_px : {2.0, 30.0, 90.0}) {
    const worlds::Scenario scenario = turning_before_an_end(blur_px / (280.0 * kOpen_s));
    renderer::Renderer renderer(scenario.world, scenario.rig);
    const ExposedFrame smooth = open_shutter(renderer, scenario.path, 1, {.open_s = kOpen_s});
    EXPECT_LE(smooth.blur_step_px, 1.0);
    EXPECT_GT(smooth.blur_step_px, blur_px < 8.0 ? 0.25 : 0.95) << "more instants than are needed";
    EXPECT_LE(longest_stair_px(smooth.frame.left.colour, 120), 2) << blur_px;
    const ExposedFrame coarse =
        open_shutter(renderer, scenario.path, 1, {.open_s = kOpen_s, .most_samples = 8});
    EXPECT_GE(coarse.blur_step_px, blur_px / 8.0);
    EXPECT_LE(coarse.blur_step_px, 1.4 * blur_px / 8.0) << "of the picture's border";
    EXPECT_GE(longest_stair_px(coarse.frame.left.colour, 120), blur_px > 80.0 ? 9 : 0);
  }
}

// What stands still is as it was: as many instants as asked for, all of them the same. Mutation: a step that
// is not a number.
TEST(Shutter, OfARobotThatStandsIsAnInstant) {
  const worlds::Scenario scenario = turning_before_an_end(0.0);
  renderer::Renderer renderer(scenario.world, scenario.rig);
  const ExposedFrame blurred = open_shutter(renderer, scenario.path, 1, {.open_s = 0.2});
  EXPECT_EQ(blurred.blur_step_px, 0.0);
  EXPECT_TRUE(same(blurred.frame.left.colour, renderer.render(scenario.path[1].pose).left.colour));
}

/// The longest way of a point that both of two looks see.
double longest_shift_px(const worlds::Scenario& scenario, renderer::Renderer& renderer, double from_s,
                        double to_s) {
  const auto ids = [&](double offset_s) {
    const slam::Pose pose = worlds::pose_near(scenario.path, 2, offset_s);
    return renderer.id_buffers(pose, pose);
  };
  const renderer::SceneGeometry scene(scenario.world);
  const renderer::StereoIdBuffers from = ids(from_s), to = ids(to_s);
  double longest_px = 0.0;
  for (const auto& [a, b] : {std::pair(from.left, to.left), {from.right, to.right}}) {
    const renderer::Correspondence found = renderer::correspond(scene, a, b);
    for (int v = 0; v < found.occlusion.rows; ++v)
      for (int u = 0; u < found.occlusion.cols; ++u)
        if (static_cast<renderer::Occlusion>(found.occlusion.at<std::uint8_t>(v, u)) ==
            renderer::Occlusion::kSeen)
          longest_px = std::max(longest_px, cv::norm(found.shift_px.at<cv::Vec2f>(v, u)));
  }
  return longest_px;
}

// Law: the step that is reported is the longest way between two instants that the truth of flow knows, for
// turning and driving, far and near. Mutations: the way of the picture's middle; no translation; the cameras'
// middle in place of the cameras.
TEST(Shutter, KnowsTheLongestWayOfAPoint) {
  constexpr double kOpen_s = 0.2;
  for (const auto& [speed_mps, turn_radps] : {std::pair(0.0, 0.5), {1.0, 0.0}, {0.6, -0.4}, {-0.5, 0.1}}) {
    worlds::Scenario scenario = bend();
    scenario.world.walls = {{{4.0, -3.0}, {4.0, 3.0}, 1.0}};
    const std::vector<slam::Control> control = {{speed_mps, turn_radps, 0.5}};
    slam::Pose pose;
    scenario.path.clear();
    for (int i = 0; i < 5; ++i) {
      scenario.path.push_back({i * 500'000'000LL, pose, i == 0 ? std::vector<slam::Control>() : control});
      pose = slam::advance(pose, control.front());
    }
    renderer::Renderer renderer(scenario.world, scenario.rig);
    const ExposedFrame blurred =
        open_shutter(renderer, scenario.path, 2, {.open_s = kOpen_s, .samples = 10, .most_samples = 10});
    double longest_px = 0.0;
    for (int i = 0; i + 1 < 10; i += 4)
      longest_px = std::max(longest_px, longest_shift_px(scenario, renderer, kOpen_s * (i / 10.0 - 0.45),
                                                         kOpen_s * ((i + 1) / 10.0 - 0.45)));
    EXPECT_NEAR(blurred.blur_step_px / longest_px, 1.0, 0.1) << speed_mps << ' ' << turn_radps;
  }
}

// Each row is that of a whole picture at the row's own time. Mutations: the last row first, the first row at
// the frame's time.
TEST(Shutter, ReadsRowsOneAfterAnother) {
  const worlds::Scenario scenario = bend();
  renderer::Renderer renderer(scenario.world, scenario.rig);
  const worlds::Shutter shutter{.right_delay_s = 0.01, .readout_s = 0.12};
  const renderer::StereoFrame rolled = open_shutter(renderer, scenario.path, 2, shutter).frame;
  for (const int row : {1, 60, 118, 121, 200, 238}) {
    const int first = row / 4 * 4;
    const double offset_s = 0.12 * ((first + 2) / 240.0 - 0.5);
    const renderer::StereoFrame instant = renderer.render(
        worlds::pose_near(scenario.path, 2, offset_s), worlds::pose_near(scenario.path, 2, offset_s + 0.01));
    EXPECT_TRUE(same(rolled.left.colour.row(row), instant.left.colour.row(row))) << row;
    EXPECT_TRUE(same(rolled.right.colour.row(row), instant.right.colour.row(row))) << row;
    EXPECT_TRUE(same(rolled.left.ball_id.row(row), instant.left.ball_id.row(row))) << row;
  }
  EXPECT_FALSE(same(rolled.left.colour, renderer.render(scenario.path[2].pose).left.colour));
}

// Mutations: a lateness that the shutter does not know of, a frame that is never late.
TEST(Shutter, LooksLateAsOftenAsAsked) {
  worlds::Scenario scenario = bend();
  scenario.shutter = {.late_probability = 0.5, .late_s = 0.05};
  scenario.path = worlds::drive_circle({{}, 2.0, 0.5, 0.1, 0.1});
  renderer::Renderer renderer(scenario.world, scenario.rig);
  int late = 0;
  const auto count_late = [&](const FrameEvent& look) {
    if (look.step + 1 == scenario.path.size()) return;  // the drive is over: late is no other place
    const auto looks_like = [&](double offset_s) {
      const renderer::StereoFrame then =
          renderer.render(worlds::pose_near(scenario.path, look.step, offset_s));
      return same(look.frame.left.colour, then.left.colour) &&
             same(look.frame.right.colour, then.right.colour);
    };
    const bool is_late = looks_like(0.05);
    EXPECT_NE(is_late, looks_like(0.0));
    late += is_late ? 1 : 0;
  };
  record({.scenario = scenario}, 1, {.on_frame = count_late});
  const double steps = static_cast<double>(scenario.path.size() - 1);
  EXPECT_NEAR(late, 0.5 * steps, 3.29 * std::sqrt(0.25 * steps));
}

double mean_range_ratio(const worlds::Scenario& scenario) {
  const MeasurementLog log = record({.scenario = scenario}, 0, {}).log;
  double sum = 0.0;
  int count = 0;
  for (const LogStep& step : log.steps) {
    for (const slam::RangeBearing& seen : step.measurements) {
      const Eigen::Vector2d ball =
          scenario.world.balls[static_cast<std::size_t>(seen.landmark_id)].centre_m.head<2>();
      sum += seen.range_m / (ball - Eigen::Vector2d(step.truth->x_m, step.truth->y_m)).norm();
      ++count;
    }
  }
  EXPECT_GT(count, 5);
  return sum / count;
}

/// A drive whose balls say nothing of the rig, as nobody knows how large they are.
worlds::Scenario bend_of_unknown_sizes() {
  worlds::Scenario scenario = bend();
  scenario.world.ball_radius_sd_m = 0.5 * scenario.world.ball_radius_m();
  return scenario;
}

// Range is f B / d: who believes in a baseline that is 2 % longer measures ranges that are 2 % longer, unless
// the sizes of balls tell that it is not.
TEST(Rigs, VisionBelievesInTheBelievedOne) {
  worlds::Scenario scenario = bend_of_unknown_sizes();
  EXPECT_NEAR(mean_range_ratio(scenario), 1.0, 0.003);
  scenario.believed_rig.baseline_m *= 1.02;
  EXPECT_NEAR(mean_range_ratio(scenario), 1.02, 0.003);
  scenario.world.ball_radius_sd_m = 0.0;
  EXPECT_NEAR(mean_range_ratio(scenario), 1.0, 0.003);
}

// About the vertical axis a turn of the right camera adds to the disparity: dZ / Z = -Z turn / B.
TEST(Rigs, ATurnedRightCameraIsMeasuredAsARangeThatIsWrong) {
  worlds::Scenario scenario = bend_of_unknown_sizes();
  scenario.rig.right_turn_rad.y() = 0.0005;
  EXPECT_NEAR(mean_range_ratio(scenario), 1.0 - 2.2 * 0.0005 / 0.12, 0.003);
  scenario.believed_rig = scenario.rig;
  EXPECT_NEAR(mean_range_ratio(scenario), 1.0, 0.003) << "who knows of it rectifies it";
}

// At a direction of 0.1 a lens with k1 = -0.3 is 0.3 % off, and less where the other camera looks: that is a
// disparity. Further out outlines are distorted so much that their arcs contradict each other.
TEST(Rigs, ALensIsUndoneByWhoKnowsOfIt) {
  worlds::Scenario scenario = bend();
  scenario.rig.distortion = {.k1 = -0.3, .k2 = 0.05, .p1 = 0.001};
  scenario.rig.right_turn_rad = {0.01, -0.02, 0.01};
  scenario.believed_rig = scenario.rig;
  EXPECT_NEAR(mean_range_ratio(scenario), 1.0, 0.003);
  scenario.believed_rig.distortion = {};
  EXPECT_GT(std::abs(mean_range_ratio(scenario) - 1.0), 0.003);
}

// What is 10 % shorter than it is wide is taken for nearer, and aside, by who does not know of it.
// Mutation: the aspect left out of what is rectified.
TEST(Rigs, PixelsThatAreNotSquareAreMeasuredAsSquareOnesByWhoKnowsOfIt) {
  for (const double aspect : {0.8, 0.95, 1.2}) {
    worlds::Scenario scenario = bend();
    scenario.rig.distortion.pixel_aspect = aspect;
    scenario.believed_rig = scenario.rig;
    EXPECT_NEAR(mean_range_ratio(scenario), 1.0, 0.003) << aspect;
  }
}

// Rectified pictures are larger than what was taken, and black there: a ball that the picture's border cuts
// looks whole in them, of another shape. Mutation: rectification that does not ask what the camera has seen.
TEST(Rigs, ABallThatTheBorderCutsIsNotMeasuredBehindALens) {
  for (const double k1 : {-0.3, 0.3}) {
    worlds::Scenario scenario = bend();
    scenario.rig.distortion = {.k1 = k1, .k2 = 0.05};
    scenario.believed_rig = scenario.rig;
    scenario.world.balls.resize(1);
    scenario.path.clear();
    for (int i = 0; i < 45; ++i)
      scenario.path.push_back({i * 1'000'000'000LL, {0.0, -0.4 - 0.02 * i, 0.0}, {}});
    int measured = 0;
    const auto check = [&](const FrameEvent& look) {
      const slam::Pose& pose = scenario.path[look.step].pose;
      const auto balls = ball_outlines({scenario.world, scenario.rig, pose, look.frame});
      for (const vision::BallObservation& seen : look.observations) {
        EXPECT_TRUE(!seen.trusted() || balls[0].inside_both) << k1 << ' ' << pose.y_m;
        measured += seen.trusted() ? 1 : 0;
      }
    };
    record({.scenario = scenario}, 0, {.on_frame = check});
    EXPECT_GT(measured, 5);
  }
}

TEST(Frames, AreLostAsOftenAsAsked) {
  worlds::Scenario scenario = bend();
  scenario.shutter.drop_probability = 1.0;
  const auto looks = [&] {
    int count = 0;
    const Recording recording =
        record({.scenario = scenario}, 1, {.on_frame = [&](const FrameEvent&) { ++count; }});
    EXPECT_EQ(recording.log.steps.size(), scenario.path.size());
    return count;
  };
  EXPECT_EQ(looks(), 0);
  scenario.shutter.drop_probability = 0.5;
  scenario.path = worlds::drive_circle({{}, 2.0, 0.5, 0.4, 0.1});
  const double steps = static_cast<double>(scenario.path.size());
  EXPECT_NEAR(looks(), 0.5 * steps, 3.29 * std::sqrt(0.25 * steps));
}

}  // namespace
}  // namespace stereobench::harness
