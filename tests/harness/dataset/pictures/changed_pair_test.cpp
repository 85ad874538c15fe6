#include "harness/dataset/pictures/changed_pair.h"

#include <gmock/gmock.h>

#include "harness/dataset/camera_pose.h"
#include "tests/harness/dataset/step_writer.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// A step of a drive as it is rendered, with its truth.
class RenderedStep {
 public:
  explicit RenderedStep(const worlds::Scenario& scenario, std::size_t step = 0)
      : scenario_(scenario),
        renderer_(scenario_.world, scenario_.rig),
        frame_(open_shutter(renderer_, scenario_.path, step, scenario_.shutter).frame),
        pair_{frame_.left.colour, frame_.right.colour},
        event_{.step = step,
               .frame = frame_,
               .pair = pair_,
               .observations = observations_,
               .match = match_,
               .world = scenario_.world,
               .rig = scenario_.rig,
               .renderer = &renderer_},
        truth_(scenario_, scenario_.world, renderer::read_form) {
    truth_.look_at(event_);
  }
  FrameTruth& truth() { return truth_; }

 private:
  worlds::Scenario scenario_;
  renderer::Renderer renderer_;
  renderer::StereoFrame frame_;
  vision::StereoPair pair_;
  std::vector<vision::BallObservation> observations_;
  FrameMatch match_;
  FrameEvent event_;
  FrameTruth truth_;
};

/// The room from a camera that looks down beside its pictures' middle, its balls apart.
worlds::Scenario odd_room() {
  worlds::Scenario scenario = room_drive();
  scenario.rig.intrinsics = {360, 240, 280.3, 171.75, 131.25};
  scenario.rig.pitch_down_rad = 0.13;
  scenario.world.balls[1].centre_m = {2.3, -0.35, 0.1};
  scenario.believed_rig = scenario.rig;
  return scenario;
}

/// The same pair, changed after it was rendered, and rendered by the camera that has such pictures: its truth
/// knows nothing of scaling.
struct Both {
  explicit Both(const PictureChange& asked, worlds::Scenario scenario = odd_room())
      : change(asked),
        drive(changed(drive_of(scenario, scenario.world, 0), asked)),
        whole(scenario),
        pair(whole.truth(), drive, change),
        reference([&] {
          scenario.rig = scenario.believed_rig = drive.rig;
          return scenario;
        }()) {}
  PictureChange change;
  DatasetDrive drive;
  RenderedStep whole;
  ChangedPair pair;
  RenderedStep reference;
};

/// In how many pixels two pictures differ, and the largest difference where both are finite.
struct Difference {
  int pixels = 0;
  double most = 0.0;
};

Difference difference(const cv::Mat& one, const cv::Mat& other, double tolerance) {
  EXPECT_EQ(one.size(), other.size());
  EXPECT_EQ(one.type(), other.type());
  cv::Mat a, b;
  one.reshape(1).convertTo(a, CV_64F);
  other.reshape(1).convertTo(b, CV_64F);
  Difference found;
  for (int row = 0; row < a.rows; ++row)
    for (int column = 0; column < a.cols; ++column) {
      const double x = a.at<double>(row, column), y = b.at<double>(row, column);
      const bool are_same = x == y || std::abs(x - y) <= tolerance;
      if (!are_same) ++found.pixels;
      if (std::isfinite(x) && std::isfinite(y)) found.most = std::max(found.most, std::abs(x - y));
    }
  return found;
}

class ScaledPair : public testing::TestWithParam<int> {};

// Law: the truth of a scaled picture is that of the camera that has such pixels. Where four pixels show
// different things and no ball, the nearest one counts: some pixels along edges differ, of 19200 / N^2 * 4.
// Mutations: the pixel at the lower right in place of the mean; the mean of depths in place of inverse ones;
// a ball that its ray misses; the next pose of this step.
TEST_P(ScaledPair, HasTheTruthOfTheCameraWithSuchPixels) {
  Both both({.divide = GetParam()});
  const double pixels = both.drive.rig.intrinsics.width_px * both.drive.rig.intrinsics.height_px;
  const auto edges = static_cast<int>(0.004 * pixels);
  for (const Side side : kBothSides) {
    DatasetPair& reference = both.reference.truth();
    EXPECT_LE(difference(both.pair.ball_id(side), reference.ball_id(side), 0).pixels, 2);
    EXPECT_LE(difference(both.pair.depth_m(side), reference.depth_m(side), 2e-5).pixels, edges);
    EXPECT_LE(difference(both.pair.pixels(side).range_m, reference.pixels(side).range_m, 2e-5).pixels, edges);
    EXPECT_LE(difference(both.pair.pixels(side).normal, reference.pixels(side).normal, 1e-3).pixels, edges);
    EXPECT_LE(difference(both.pair.pixels(side).surface, reference.pixels(side).surface, 0).pixels, edges);
    const auto& across = both.pair.to_other_camera(side);
    EXPECT_LE(difference(across.shift_px, reference.to_other_camera(side).shift_px, 1e-3).pixels, edges);
    EXPECT_LE(difference(across.occlusion, reference.to_other_camera(side).occlusion, 0).pixels, 2 * edges);
    const auto& onward = both.pair.to_next_step(side);
    EXPECT_LE(difference(onward.shift_px, reference.to_next_step(side).shift_px, 1e-3).pixels, 2 * edges);
    EXPECT_LE(difference(onward.occlusion, reference.to_next_step(side).occlusion, 0).pixels, 2 * edges);
  }
}

INSTANTIATE_TEST_SUITE_P(Divisors, ScaledPair, testing::Values(2, 3, 4, 5));

// Law: what is triangulated of a scaled disparity lies where the scene is: on the wall, a ball or the floor.
// Mutation: the principal point without the half pixel (cx / N).
TEST(ChangedPair, TriangulatesToTheSamePoints) {
  const worlds::Scenario scenario = odd_room();
  Both both({.crop = cv::Rect(20, 10, 300, 220), .divide = 2}, scenario);
  const vision::StereoRig& rig = both.drive.rig;
  const Eigen::Isometry3d world_from_left = world_from_camera(both.drive, 0, Side::kLeft);
  const cv::Mat disparity_px = renderer::disparity_px(both.pair.to_other_camera(Side::kLeft), Side::kLeft);
  const cv::Mat ids = both.pair.ball_id(Side::kLeft);
  int on_ball = 0, elsewhere = 0;
  for (int row = 0; row < disparity_px.rows; ++row)
    for (int column = 0; column < disparity_px.cols; ++column) {
      const double d = disparity_px.at<float>(row, column);
      if (!std::isfinite(d)) continue;
      const double depth_m = rig.intrinsics.focal_px * rig.baseline_m / d;
      const Eigen::Vector3d at =
          world_from_left * (depth_m * vision::pixel_ray(rig.intrinsics, {column, row}));
      if (const int id = ids.at<std::uint8_t>(row, column); id > 0) {
        const worlds::Ball& ball = scenario.world.balls[static_cast<std::size_t>(id - 1)];
        EXPECT_NEAR((at - ball.centre_m).norm(), ball.radius_m, 1e-4) << row << " " << column;
        ++on_ball;
      } else {
        if (std::min(std::abs(at.z()), std::abs(at.x() - 4.0)) > 2e-3) ++elsewhere;
      }
    }
  const auto& across = both.reference.truth().to_other_camera(Side::kLeft);
  EXPECT_LE(difference(both.pair.to_other_camera(Side::kLeft).occlusion, across.occlusion, 0).pixels, 100);
  EXPECT_GT(on_ball, 250);
  EXPECT_LE(elsewhere, 40);  // beside the balls and along the foot of the wall
}

// Law: balls of a changed picture are those that the camera with such pictures has, to the pixel. Mutations:
// outlines moved after they are scaled; boxes of the whole picture; a ball out of the cut still listed.
TEST(ChangedPair, ListsTheBallsThatTheCameraWithSuchPicturesHas) {
  for (const PictureChange& change :
       {PictureChange{.divide = 2}, PictureChange{.crop = cv::Rect(150, 100, 100, 99)},
        PictureChange{.crop = cv::Rect(0, 0, 90, 90)},
        PictureChange{.crop = cv::Rect(141, 91, 99, 99), .divide = 3}}) {
    Both both(change);
    for (const Side side : kBothSides) {
      const auto is = both.pair.balls(side), was = both.reference.truth().balls(side);
      ASSERT_EQ(is.size(), was.size());
      for (std::size_t i = 0; i < is.size(); ++i) {
        EXPECT_EQ(is[i].ball, was[i].ball);
        EXPECT_LT((is[i].outline.centre_px - was[i].outline.centre_px).norm(), 1e-9);
        EXPECT_NEAR(is[i].outline.semi_major_px, was[i].outline.semi_major_px, 1e-9);
        EXPECT_LT((is[i].centre_px - was[i].centre_px).norm(), 1e-9);
        EXPECT_EQ(is[i].px_count_all, was[i].px_count_all);
        EXPECT_EQ(is[i].bbox_obj, was[i].bbox_obj);
        EXPECT_EQ(is[i].truncated, was[i].truncated);
        EXPECT_NEAR(static_cast<double>(is[i].px_count_visib), static_cast<double>(was[i].px_count_visib),
                    2.0);
        EXPECT_LE(is[i].visib_fract, 1.0);
      }
    }
  }
}

// Law: a cut leaves every value as it is, but for what is no longer seen in the other picture. Mutations: x
// and y of the cut swapped; points out of the other cut still seen.
TEST(ChangedPair, CutsWithoutTouchingValues) {
  const cv::Rect cut(60, 30, 120, 90);
  Both both({.crop = cut});
  DatasetPair& whole = both.whole.truth();
  for (const Side side : kBothSides) {
    EXPECT_EQ(difference(both.pair.picture(side), whole.picture(side)(cut), 0).pixels, 0);
    EXPECT_EQ(difference(both.pair.ball_id(side), whole.ball_id(side)(cut), 0).pixels, 0);
    EXPECT_EQ(difference(both.pair.depth_m(side), whole.depth_m(side)(cut), 0).pixels, 0);
    EXPECT_EQ(difference(both.pair.pixels(side).normal, whole.pixels(side).normal(cut), 0).pixels, 0);
    const auto& is = both.pair.to_other_camera(side);
    EXPECT_EQ(difference(is.shift_px, whole.to_other_camera(side).shift_px(cut), 0).pixels, 0);
    EXPECT_LE(difference(is.occlusion, both.reference.truth().to_other_camera(side).occlusion, 0).pixels, 3);
    EXPECT_GT(difference(is.occlusion, whole.to_other_camera(side).occlusion(cut), 0).pixels, 500);
  }
}

// Behind a lens, depth is that of a pixel a quarter beside at most (decision 020): a scaled one is as good.
TEST(ChangedPair, ScalesWhatALensShows) {
  worlds::Scenario scenario = odd_room();
  scenario.rig.distortion = {.k1 = -0.15, .p1 = 0.004};
  Both both({.divide = 2}, scenario);
  for (const Side side : kBothSides) {
    EXPECT_LE(difference(both.pair.ball_id(side), both.reference.truth().ball_id(side), 0).pixels, 40);
    EXPECT_LE(difference(both.pair.to_other_camera(side).shift_px,
                         both.reference.truth().to_other_camera(side).shift_px, 0.2)
                  .pixels,
              100);
  }
}

}  // namespace
}  // namespace stereobench::harness
