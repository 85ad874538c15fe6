/// What changed from one golden frame to another.
#include "harness/golden/golden_difference.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/golden/painted_frame.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

constexpr GoldenLimits kAnything = {.levels = 255, .share = 1.0};
const Eigen::Vector2d kStill = Eigen::Vector2d::Zero();

/// A frame with one pixel of another colour in its left picture.
GoldenFrame with_pixel(int u, int v, int levels) {
  GoldenFrame frame = painted_frame();
  auto& blue = frame.left.colour.at<cv::Vec3b>(v, u)[0];
  blue = static_cast<std::uint8_t>(blue > 128 ? blue - levels : blue + levels);
  see_something_else(frame.left);
  return frame;
}

TEST(GoldenDifference, OfEqualFramesIsNone) {
  for (const GoldenPreset& preset : golden_presets()) {
    const GoldenDifference difference = compare_golden(painted_frame(), painted_frame(), preset.limits);
    EXPECT_TRUE(difference.passes) << preset.name;
    EXPECT_TRUE(difference.is_none());
    EXPECT_TRUE(difference.left.shifts.empty());
    EXPECT_EQ(difference_text(difference), "");
  }
}

// Mutations: counts by the place of another pixel (rows for columns); kinds in another order; edges of walls.
TEST(GoldenDifference, CountsAPixelWhereItIs) {
  const auto place_of_pixel = [](int u, int v) {
    const GoldenDifference difference = compare_golden(painted_frame(), with_pixel(u, v, 5), kAnything);
    EXPECT_EQ(difference.left.all_changed(), 1);
    EXPECT_EQ(difference.right.all_changed(), 0);
    EXPECT_EQ(difference.left.most_levels, 5);
    const auto& counts = difference.left.changed;
    return static_cast<PixelPlace>(std::ranges::find(counts, 1) - counts.begin());
  };
  EXPECT_EQ(place_of_pixel(60, 80), PixelPlace::kBall);  // the middle of ball 3
  EXPECT_EQ(place_of_pixel(60, 65), PixelPlace::kBallEdge);
  EXPECT_EQ(place_of_pixel(100, 90), PixelPlace::kMesh);
  EXPECT_EQ(place_of_pixel(150, 69), PixelPlace::kWall);  // where the floor begins, and no ball is
  EXPECT_EQ(place_of_pixel(150, 70), PixelPlace::kFloor);
  EXPECT_EQ(place_of_pixel(5, 5), PixelPlace::kBackground);
}

TEST(GoldenDifference, SaysWhatChangedInALineForEachCamera) {
  const std::string text = difference_text(compare_golden(painted_frame(), with_pixel(60, 80, 5), kAnything));
  EXPECT_THAT(text, testing::StartsWith(
                        "left, seed 3 frame 12: 1 of 17600 pixels differ by up to 5 levels: 1 inside balls"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 1);
  EXPECT_THAT(text, Not(HasSubstr("right")));
}

// The reference: the distance of each pixel from each border between pixels of which one is a ball's.
// Mutations: edges of 4 or 24 neighbours; a ball's side alone; of one of the pictures.
TEST(GoldenDifference, EdgesAreWithinOneAndAHalfPixels) {
  const cv::Mat shown = painted_frame().left.shown;
  const cv::Mat places = places_of(shown, shown, kPaintedMesh);
  const auto surface = [&](int u, int v) { return shown.at<std::uint16_t>(v, u); };
  const auto is_near_border = [&](int u, int v) {
    for (int y = std::max(0, v - 2); y <= std::min(shown.rows - 1, v + 2); ++y) {
      for (int x = std::max(0, u - 2); x <= std::min(shown.cols - 1, u + 2); ++x) {
        const bool is_within = (x - u) * (x - u) + (y - v) * (y - v) <= 1.5 * 1.5;
        const bool at_a_ball = renderer::is_ball(surface(x, y)) || renderer::is_ball(surface(u, v));
        if (is_within && at_a_ball && surface(x, y) != surface(u, v)) return true;
      }
    }
    return false;
  };
  long edges = 0;
  for (int v = 0; v < shown.rows; ++v) {
    for (int u = 0; u < shown.cols; ++u) {
      const bool is_edge = places.at<std::uint8_t>(v, u) == static_cast<int>(PixelPlace::kBallEdge);
      ASSERT_EQ(is_edge, is_near_border(u, v)) << u << ", " << v;
      edges += is_edge;
    }
  }
  EXPECT_GT(edges, 300);
  // Of two pictures, those of both.
  const cv::Mat moved = painted_frame({Eigen::Vector2d(4.0, 0.0), kStill, kStill, kStill}).left.shown;
  const cv::Mat both = places_of(shown, moved, kPaintedMesh);
  EXPECT_EQ(cv::countNonZero(both != cv::min(places, places_of(moved, moved, kPaintedMesh))), 0);
}

// Mutation: identities that colours make up for.
TEST(GoldenDifference, IdentitiesMustBeEqualWhateverTheLimits) {
  GoldenFrame other = painted_frame();
  other.right.shown.at<std::uint16_t>(80, 60) = 1;
  see_something_else(other.right);
  const GoldenDifference difference = compare_golden(painted_frame(), other, kAnything);
  EXPECT_FALSE(difference.passes);
  EXPECT_EQ(difference.right.identities, 1);
  EXPECT_EQ(difference.left.identities, 0);
  EXPECT_THAT(difference_text(difference), HasSubstr("right, seed 3 frame 12: 1 pixel shows something else"));
}

// Mutations: < in place of <=, of levels and of the share; both pictures' pixels together.
TEST(GoldenDifference, LimitsAreInclusive) {
  const auto passes = [](int pixels, int levels, const GoldenLimits& limits) {
    GoldenFrame frame = painted_frame();
    for (int u = 0; u < pixels; ++u)
      frame.left.colour.at<cv::Vec3b>(100, u)[2] -= static_cast<std::uint8_t>(levels);
    see_something_else(frame.left);
    return compare_golden(painted_frame(), frame, limits).passes;
  };
  EXPECT_TRUE(passes(50, 3, {.levels = 3, .share = 0.0}));
  EXPECT_FALSE(passes(50, 4, {.levels = 3, .share = 0.0}));
  EXPECT_FALSE(passes(1, 4, {.levels = 3, .share = 0.0}));
  const double pixels = 160.0 * 110.0;
  EXPECT_TRUE(passes(44, 4, {.levels = 3, .share = 44.0 / pixels}));
  EXPECT_FALSE(passes(45, 4, {.levels = 3, .share = 44.0 / pixels}));
}

// Mutation: the hash of what the detector sees left out.
TEST(GoldenDifference, OfNoiseAloneFailsWhereLimitsAreExact) {
  GoldenFrame noisy = painted_frame();
  see_something_else(noisy.left);
  EXPECT_FALSE(compare_golden(painted_frame(), noisy, golden_limits("exact")).passes);
  const GoldenDifference difference = compare_golden(painted_frame(), noisy, golden_limits("rounding"));
  EXPECT_TRUE(difference.passes);
  EXPECT_FALSE(difference.is_none());
  EXPECT_THAT(difference_text(difference),
              HasSubstr("left, seed 3 frame 12: the small picture is equal, and"));
}

// Law: shifts change their sign and nothing else does. Mutations: places or gradients of one picture alone.
TEST(GoldenDifference, IsTheSameBackwardsButForSigns) {
  const GoldenFrame before = painted_frame();
  const GoldenFrame after = painted_frame(
      {Eigen::Vector2d(0.4, -0.3), Eigen::Vector2d(7.0, 2.0), kStill, Eigen::Vector2d(0.1, 0.0)});
  const GoldenDifference there = compare_golden(before, after, golden_limits("edges"));
  const GoldenDifference back = compare_golden(after, before, golden_limits("edges"));
  EXPECT_EQ(there.left.changed, back.left.changed);
  EXPECT_EQ(there.left.beyond, back.left.beyond);
  EXPECT_EQ(there.left.identities, back.left.identities);
  ASSERT_EQ(there.left.shifts.size(), back.left.shifts.size());
  ASSERT_GE(there.left.shifts.size(), 3u);
  for (std::size_t i = 0; i < there.left.shifts.size(); ++i) {
    EXPECT_EQ(there.left.shifts[i].ball, back.left.shifts[i].ball);
    EXPECT_EQ(there.left.shifts[i].shift_px, -back.left.shifts[i].shift_px);
  }
}

// Balls of radii from 5 to 15 px, each shifted alone before what stands still. Mutations: the sign; x for y;
// no smoothing; identities for colours, which are off by up to 0.15 px here.
TEST(GoldenDifference, FindsTheShiftOfEachBall) {
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(0.31, 0.02), Eigen::Vector2d(-0.5, 0.5), Eigen::Vector2d(0.0, -0.07)}) {
    const GoldenFrame after = painted_frame({shift, -shift, 0.5 * shift, kStill});
    const auto shifts = compare_golden(painted_frame(), after, kAnything).left.shifts;
    std::array<Eigen::Vector2d, 4> found;
    found.fill(kStill);
    for (const BallShift& one : shifts) found.at(static_cast<std::size_t>(one.ball)) = one.shift_px;
    EXPECT_LT((found[0] - shift).norm(), 0.05) << found[0].transpose();
    EXPECT_LT((found[1] + shift).norm(), 0.05) << found[1].transpose();
    EXPECT_LT((found[2] - 0.5 * shift).norm(), 0.05) << found[2].transpose();
    EXPECT_LT(found[3].norm(), 0.01) << found[3].transpose();
  }
}

// Mutation: brightness that is taken for a shift, of up to 0.1 px here.
TEST(GoldenDifference, TakesBrighterLightForNoShift) {
  GoldenFrame brighter = painted_frame();
  brighter.left.colour *= 1.1;
  const GoldenDifference difference = compare_golden(painted_frame(), brighter, kAnything);
  EXPECT_GT(difference.left.all_changed(), 10'000);
  for (const BallShift& shift : difference.left.shifts) EXPECT_LT(shift.shift_px.norm(), 0.01) << shift.ball;
}

// Mutation: colours in spite of the distance.
TEST(GoldenDifference, FindsLargeShiftsByIdentities) {
  const GoldenFrame after = painted_frame({Eigen::Vector2d(6.0, -3.0), kStill, kStill, kStill});
  const GoldenDifference difference = compare_golden(painted_frame(), after, kAnything);
  ASSERT_FALSE(difference.left.shifts.empty());
  EXPECT_EQ(difference.left.shifts.front().ball, 0);
  EXPECT_LT((difference.left.shifts.front().shift_px - Eigen::Vector2d(6.0, -3.0)).norm(), 1e-9);
  EXPECT_THAT(difference_text(difference), HasSubstr("ball 0 moved by (+6.00, -3.00) px"));
}

TEST(GoldenDifference, RefusesFramesOfOtherSizes) {
  GoldenFrame other = painted_frame();
  other.smaller = 2;
  EXPECT_THROW(compare_golden(painted_frame(), other, kAnything), std::runtime_error);
  other.smaller = 4;
  other.left.colour = other.left.colour(cv::Rect(0, 0, 80, 60));
  EXPECT_THROW(compare_golden(painted_frame(), other, kAnything), std::runtime_error);
}

TEST(GoldenDifference, SaysTheSameToPrograms) {
  const auto json = difference_json(compare_golden(painted_frame(), with_pixel(60, 80, 5), kAnything));
  EXPECT_EQ(json["left"]["changed"]["balls"], 1);
  EXPECT_EQ(json["left"]["changed"]["walls"], 0);
  EXPECT_EQ(json["left"]["most_levels"], 5);
  EXPECT_EQ(json["right"]["seen_equal"], true);
  EXPECT_EQ(json["frame"], 12);
}

// Mutation: a preset that is laxer than the next one.
TEST(GoldenLimits, AreCalledByName) {
  EXPECT_TRUE(golden_limits("exact").are_exact());
  EXPECT_FALSE(golden_limits("rounding").are_exact());
  EXPECT_EQ(golden_limits("rounding").levels, 1);
  for (std::size_t i = 1; i < golden_presets().size(); ++i) {
    EXPECT_GE(golden_presets()[i].limits.levels, golden_presets()[i - 1].limits.levels);
    EXPECT_GE(golden_presets()[i].limits.share, golden_presets()[i - 1].limits.share);
  }
  try {
    golden_limits("roundin");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "no limits of golden pictures are called 'roundin', did you mean rounding?");
  }
}

}  // namespace
}  // namespace stereobench::harness
