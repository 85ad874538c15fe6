/// Golden frames, rendered.
#include "harness/golden/golden_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment.h"
#include "harness/frame_replay/frame_replay.h"
#include "harness/golden/golden_difference.h"
#include "harness/golden/golden_files.h"
#include "renderer/surfaces/primitives.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

constexpr FrameName kFrame = {1, 3};
constexpr auto kBackend = renderer::Backend::kSoftware;

/// A world with balls, walls, meshes and a floor.
struct Circle {
  explicit Circle(const std::vector<std::string>& overrides = {})
      : experiment(read_experiment(STEREOBENCH_SOURCE_DIR "/assets/scenarios/ball_circle.yaml", overrides,
                                   meshes.occluders())) {}
  GoldenFrame golden(const FrameName& frame = kFrame) {
    return render_golden(experiment, frame, kBackend, meshes);
  }
  renderer::MeshCache meshes;
  Experiment experiment;
};

bool is_same(const GoldenPicture& a, const GoldenPicture& b) {
  return a.seen_sha256 == b.seen_sha256 && pixels_sha256(a.colour) == pixels_sha256(b.colour) &&
         pixels_sha256(a.shown) == pixels_sha256(b.shown);
}

// The references: the pair that the detector is shown, and ids of the pass that paints balls.
// Mutations: left for right; the hash of the light; ids of another step.
TEST(RenderGolden, IsWhatTheDetectorSeesAndWhatPixelsShow) {
  Circle circle;
  const GoldenFrame golden = circle.golden();
  const ReplayedFrame seen =
      replay_frames(circle.experiment, std::span(&kFrame, 1), kBackend, circle.meshes).front();
  EXPECT_EQ(golden.left.seen_sha256, pixels_sha256(seen.pair.left));
  EXPECT_EQ(golden.right.seen_sha256, pixels_sha256(seen.pair.right));
  Circle small({"rig.width_px=256", "rig.height_px=192", "rig.focal_px=221.75", "camera.noise_sd_levels=0"});
  const ReplayedFrame in_small =
      replay_frames(small.experiment, std::span(&kFrame, 1), kBackend, small.meshes).front();
  EXPECT_EQ(pixels_sha256(golden.left.colour), pixels_sha256(in_small.pair.left));
  EXPECT_EQ(pixels_sha256(golden.right.colour), pixels_sha256(in_small.pair.right));
  cv::Mat balls = golden.right.shown.clone();
  balls.setTo(0, golden.right.shown >= renderer::kFloorPrimitive);
  balls.convertTo(balls, CV_8U);
  EXPECT_EQ(pixels_sha256(balls), pixels_sha256(in_small.truth.right.ball_id));
  EXPECT_GT(cv::countNonZero(balls), 100);
  EXPECT_EQ(golden.smaller, 4);
}

// Mutations: noise in the golden picture; none in what the detector sees.
TEST(RenderGolden, HasNoNoiseInItsPicture) {
  Circle quiet, noisy({"camera.noise_sd_levels=5"});
  const GoldenFrame a = quiet.golden(), b = noisy.golden();
  EXPECT_EQ(pixels_sha256(a.left.colour), pixels_sha256(b.left.colour));
  EXPECT_NE(a.left.seen_sha256, b.left.seen_sha256);
  Circle grainy({"camera.full_well_electrons=5000", "camera.read_noise_electrons=10"});
  const GoldenFrame c = grainy.golden(), again = grainy.golden();
  EXPECT_LE(compare_golden(a, c, {.levels = 0, .share = 1.0}).left.most_levels, 1);  // of 16 bits, rounded
  EXPECT_TRUE(is_same(c.left, again.left));
}

// Law: the same frame is the same bytes, and no other frame is.
TEST(RenderGolden, DependsOnTheFrameAlone) {
  Circle circle, other({"path.laps=1", "seeds=5"});
  const GoldenFrame golden = circle.golden();
  EXPECT_TRUE(is_same(golden.left, other.golden().left));
  EXPECT_FALSE(is_same(golden.left, circle.golden({1, 4}).left));
  EXPECT_FALSE(is_same(golden.left, circle.golden({2, 3}).left));
  EXPECT_FALSE(is_same(golden.left, golden.right));
}

// Law: where the whole scene is half a golden pixel further to the right and a quarter further up, each ball
// is, to 0.05 px. Mutations: identities for colours; a principal point that is not moved to the small rig.
TEST(RenderGolden, ShowsAShiftOfTheScene) {
  Circle circle;
  circle.experiment.scenario.world.meshes.clear();  // plates below balls, thinner than a pixel: drawn or not
  const GoldenFrame before = circle.golden();
  circle.experiment.scenario.rig.intrinsics.cx_px += 2.0;  // of the camera's pixels, four to one
  circle.experiment.scenario.rig.intrinsics.cy_px -= 1.0;
  const GoldenDifference difference = compare_golden(before, circle.golden(), golden_limits("edges"));
  EXPECT_FALSE(difference.passes);
  for (const PictureDifference* picture : {&difference.left, &difference.right}) {
    EXPECT_GE(picture->shifts.size(), 2u);
    for (const BallShift& shift : picture->shifts) {
      EXPECT_NEAR(shift.shift_px.x(), 0.5, 0.05) << shift.ball;
      EXPECT_NEAR(shift.shift_px.y(), -0.25, 0.05) << shift.ball;
    }
  }
}

// Mutations: the size of the camera's pictures; pictures that hardly pack.
TEST(RenderGolden, IsSmallEnoughForGit) {
  const TestFolder folder;
  Circle circle;
  write_golden(folder.path(), circle.golden());
  std::uintmax_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path())) bytes += file.file_size();
  EXPECT_LT(bytes, 150'000u);
}

// Law: a point that the rig sees at a place is seen by the smaller one where that pixel's area is.
// Mutations: the half pixel; focal lengths as they were.
TEST(MakeSmaller, LooksAtTheSameScene) {
  for (const int width : {100, 256, 257, 640, 1024, 1920}) {
    vision::StereoRig rig;
    rig.intrinsics = {.width_px = width, .height_px = 500, .focal_px = 300.0, .cx_px = 40.25, .cy_px = 260.0};
    vision::StereoRig small = rig;
    const int smaller = make_smaller(small);
    EXPECT_LE(small.intrinsics.width_px, kGoldenWidth_px);
    EXPECT_EQ(small.intrinsics.width_px, width / smaller);
    EXPECT_TRUE(smaller == 1 || width / (smaller - 1) > kGoldenWidth_px) << width;
    const double x = 0.3, y = -0.2;
    const double corner_x = rig.intrinsics.focal_px * x + rig.intrinsics.cx_px + 0.5;
    const double corner_y = rig.intrinsics.focal_px * y + rig.intrinsics.cy_px + 0.5;
    EXPECT_NEAR(small.intrinsics.focal_px * x + small.intrinsics.cx_px + 0.5, corner_x / smaller, 1e-12);
    EXPECT_NEAR(small.intrinsics.focal_px * y + small.intrinsics.cy_px + 0.5, corner_y / smaller, 1e-12);
  }
}

TEST(RenderGolden, RefusesWhatItCannotRender) {
  const auto refusal = [](Circle circle, const FrameName& frame) {
    try {
      circle.golden(frame);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal(Circle(), {0, 73}), HasSubstr("has the steps 0 to 72 (got 73)"));
  EXPECT_THAT(refusal(Circle({"shutter.drop_probability=1"}), {0, 2}), HasSubstr("the shutter drops"));
  EXPECT_THAT(refusal(Circle({"shutter.readout_s=0.02", "rig.distortion=[-0.1,0.02,0,0,0]"}), {0, 2}),
              HasSubstr("no golden pictures of a rolling shutter"));
  EXPECT_EQ(refusal(Circle({"shutter.readout_s=0.02"}), {0, 2}), "");
}

}  // namespace
}  // namespace stereobench::harness
