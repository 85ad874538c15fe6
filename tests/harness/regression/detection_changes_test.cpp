#include "harness/regression/detection_changes.h"

#include <cmath>

#include <gmock/gmock.h>

#include "harness/vision_scoring/detection_table.h"
#include "slam/math/random.h"
#include "tests/harness/scoring/scene.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using testing::ThrowsMessage;

/// Balls of 20 seeds, 12 frames and 9 balls each, all found twice with errors of 1 mm and 0.05 px.
PairedBalls balls_at_random() {
  slam::RandomStream random(5, slam::Stream::kOracle);
  PairedBalls pairs;
  std::vector<PairedBall>& balls = pairs.balls;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (int frame = 0; frame < 12; ++frame)
      for (int ball = 0; ball < 9; ++ball) {
        PairedBall& made = balls.emplace_back(
            PairedBall{.key = {seed, frame, ball}, .truth = {}, .first = {}, .second = {}});
        made.truth = {.is_required = true,
                      .colour = ball,
                      .range_m = 1.0 + 9.0 * random.uniform(),
                      .bearing_rad = 0.5 * random.normal(),
                      .radius_px = 10.0 + 20.0 * random.uniform(),
                      .fraction = 1.0,
                      .border_px = 300.0 * random.uniform()};
        for (BallFinding* finding : {&made.first, &made.second}) {
          finding->is_found = true;
          finding->range_error_m = 0.001 * random.normal();
          finding->left_error_px = 0.05 * Eigen::Vector2d(random.normal(), random.normal());
          finding->right_error_px = 0.05 * Eigen::Vector2d(random.normal(), random.normal());
        }
      }
  return pairs;
}

void lose(PairedBall& ball) {
  ball.second = {};
}

// Mutation: balls that were lost before and after.
TEST(DetectionChanges, SaysWhichBallsWereLost) {
  PairedBalls pairs = balls_at_random();
  std::vector<PairedBall>& balls = pairs.balls;
  for (PairedBall& ball : balls)
    if (ball.truth.colour == 3 && ball.truth.range_m > 6.0) lose(ball);
  for (PairedBall& ball : balls)
    if (ball.truth.colour == 5 && ball.key.frame < 6) ball.first = ball.second = {};
  const DetectionChanges changes = detection_changes(pairs);
  EXPECT_GT(changes.found.worse, 50);
  EXPECT_EQ(changes.found.better, 0);
  ASSERT_TRUE(changes.lost_slice);
  EXPECT_THAT(changes.lost_slice->conditions, Contains(StartsWith("range")));
  EXPECT_THAT(changes_text(changes, true), HasSubstr("A alone found"));
  EXPECT_EQ(counts_of(changes).at("vision.recall").count.worse, changes.found.worse);
}

// A ball that did not have to be found is no loss.
TEST(DetectionChanges, CountsBallsThatHadToBeFound) {
  PairedBalls pairs = balls_at_random();
  std::vector<PairedBall>& balls = pairs.balls;
  balls[7].truth.is_required = false;
  lose(balls[7]);
  lose(balls[8]);
  balls[9].first = {};  // found the second time alone
  const DetectionChanges changes = detection_changes(pairs);
  EXPECT_EQ(changes.required, static_cast<long>(balls.size()) - 1);
  EXPECT_EQ(changes.found.worse, 1);
  EXPECT_EQ(changes.found.better, 1);
}

// Mutation: both cameras' shifts in one number.
TEST(DetectionChanges, SaysInWhichCameraCentresMoved) {
  PairedBalls pairs = balls_at_random();
  std::vector<PairedBall>& balls = pairs.balls;
  for (PairedBall& ball : balls) ball.second.left_error_px.x() += 0.3;
  const DetectionChanges changes = detection_changes(pairs);
  const double standard_error_px = changes.left.x_px.sd / std::sqrt(changes.left.x_px.count);
  EXPECT_NEAR(changes.left.x_px.mean, 0.3, 5.0 * standard_error_px);
  EXPECT_NEAR(changes.right.x_px.mean, 0.0, 5.0 * standard_error_px);
  EXPECT_LT(standard_error_px, 0.003);
}

// Mutation: growth in metres.
TEST(DetectionChanges, SaysByHowMuchRangesGrew) {
  PairedBalls pairs = balls_at_random();
  for (PairedBall& ball : pairs.balls) ball.second = ball.first;
  for (PairedBall& ball : pairs.balls) ball.second.range_error_m += 0.01 * ball.truth.range_m;
  const DetectionChanges changes = detection_changes(pairs);
  EXPECT_NEAR(changes.range_growth.mean, 0.01, 1e-12);
  EXPECT_NEAR(changes.range_growth.sd, 0.0, 1e-12);
  EXPECT_THAT(changes_text(changes, true), HasSubstr("balls, B over A: +1.000 +- 0.000 %"));
  EXPECT_FALSE(changes.misplaced_slice) << "it is all balls";
}

TEST(DetectionChanges, SaysWhichColourWasTakenForWhich) {
  PairedBalls pairs = balls_at_random();
  std::vector<PairedBall>& balls = pairs.balls;
  for (PairedBall& ball : balls)
    if (ball.truth.colour == 2) ball.second = {.wrong_colour = 7};
  const DetectionChanges changes = detection_changes(pairs);
  EXPECT_EQ(changes.misidentified.worse, 240);
  ASSERT_FALSE(changes.confusions.empty());
  EXPECT_EQ(changes.confusions[0].colour, 2);
  EXPECT_EQ(changes.confusions[0].taken_for, 7);
  EXPECT_EQ(changes.confusions[0].balls, 240);
  EXPECT_THAT(changes_text(changes, true), HasSubstr("colour 2 taken for 7: 240"));
  ASSERT_TRUE(changes.misidentified_slice);
  EXPECT_THAT(changes.misidentified_slice->conditions, Contains("colour 2"));
}

TEST(DetectionChanges, NamesTheFramesThatChangedMost) {
  PairedBalls pairs = balls_at_random();
  std::vector<PairedBall>& balls = pairs.balls;
  for (PairedBall& ball : balls)
    if (ball.key.seed == 7 && ball.key.frame == 5) lose(ball);
  const DetectionChanges changes = detection_changes(pairs);
  ASSERT_EQ(changes.frames.size(), 10U);
  EXPECT_EQ(changes.frames[0].seed, 7U);
  EXPECT_EQ(changes.frames[0].frame, 5);
  EXPECT_EQ(changes.frames[0].balls, 9);
}

TEST(DetectionChanges, OfEqualResultsAreNone) {
  PairedBalls pairs = balls_at_random();
  std::vector<PairedBall>& balls = pairs.balls;
  for (PairedBall& ball : balls) ball.second = ball.first;
  EXPECT_THAT(changes_text(detection_changes(pairs), true), IsEmpty());
  EXPECT_THAT(changes_text(detection_changes({}), true), IsEmpty());
}

class DetectedBallsFile : public testing::Test {
 protected:
  DetectedBalls read(const std::string& rows) {
    return read_detected_balls(folder_.write("detections.csv", detections_csv_header() + rows));
  }
  TestFolder folder_;
};

// Law: what is read is what was written. Mutations: left for right; a flagged detection that counts.
TEST_F(DetectedBallsFile, IsReadAsItIsWritten) {
  const Scene scene({kAhead, kAside, kCut});
  const auto outlines = ball_outlines(scene.truth());
  vision::BallObservation right = perfect(outlines[0], 3);
  right.left_px.x() += 0.25;
  right.range_bearing.range_m += 0.5;
  vision::BallObservation flagged = perfect(outlines[1], 5);
  flagged.occluded = true;
  const FrameMatch match = match_observations(scene.truth(), std::vector{right, right, flagged});
  const PairOfRun pair{~std::uint64_t{0}, 3, scene.world, scene.rig};
  const DetectedBalls balls = read(detection_rows(pair, match));
  ASSERT_EQ(balls.size(), 2U);
  const DetectedBall& found = balls.at({~std::uint64_t{0}, 3, 0});
  EXPECT_TRUE(found.truth.is_required && found.finding.is_found);
  EXPECT_NEAR(found.finding.range_error_m, 0.5, 1e-12);
  EXPECT_NEAR((found.finding.left_error_px - Eigen::Vector2d(0.25, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(found.finding.right_error_px.norm(), 0.0, 1e-12);
  const DetectedBall& missed = balls.at({~std::uint64_t{0}, 3, 1});
  EXPECT_TRUE(missed.truth.is_required);
  EXPECT_FALSE(missed.finding.is_found);
}

TEST_F(DetectedBallsFile, IsRefusedWithTheLineThatIsWrong) {
  EXPECT_THAT([&] { read("0,1,miss,x,1,0,1,0,1,1,1,1,9,1,1,5,,,,,,,,,,\n"); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("detections.csv:2: ball: expected a whole number"), HasSubstr("'x'"))));
  EXPECT_THAT([&] { read("0,1,miss\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("expected 26 fields")));
}

// Balls of other worlds are not the same balls. Mutation: paired by their numbers alone.
TEST(PairedBalls, AreInTheSamePlace) {
  const DetectedBall ball{.truth = {.is_required = true, .range_m = 2.0}, .finding = {.is_found = true}};
  DetectedBall elsewhere = ball;
  elsewhere.truth.range_m = 2.1;
  const BallKey key{0, 1, 2};
  EXPECT_EQ(pair_balls({{key, ball}}, {{key, ball}}).balls.size(), 1U);
  const PairedBalls moved = pair_balls({{key, ball}}, {{key, elsewhere}});
  EXPECT_THAT(moved.balls, IsEmpty());
  EXPECT_EQ(moved.unpaired, 1);
  EXPECT_THAT(counts_of(detection_changes(moved)), IsEmpty());
  EXPECT_THAT(changes_text(detection_changes(moved), true), HasSubstr("are in one result alone: 1;"));
}

// One that did not have to be found is one that the other run did not find. Seeds of one run are left out.
TEST(PairedBalls, MayBeFoundOnce) {
  const DetectedBall required{.truth = {.is_required = true}, .finding = {.is_found = true}};
  const DetectedBall extra{.truth = {}, .finding = {.is_found = true}};
  const DetectedBalls first = {{{0, 1, 2}, required}, {{0, 1, 3}, extra}, {{7, 1, 2}, required}};
  const PairedBalls pairs = pair_balls(first, {{{0, 1, 2}, required}});
  ASSERT_EQ(pairs.balls.size(), 2U);
  EXPECT_EQ(pairs.unpaired, 0);
  EXPECT_TRUE(pairs.balls[1].first.is_found);
  EXPECT_FALSE(pairs.balls[1].second.is_found);
}

}  // namespace
}  // namespace stereobench::harness
