/// What is drawn over pictures, and charts of detections.
#include "harness/result_pages/frame_panels.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/result_pages/detection_charts.h"
#include "harness/vision_scoring/detection_table.h"
#include "slam/math/random.h"
#include "tests/test_folder.h"
#include "vision/camera/rig.h"
#include "vision/stereo/sphere.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// How far a point is from an ellipse, in units of its half axes: 0 on it.
double off_ellipse(const vision::OutlineEllipse& ellipse, const Eigen::Vector2d& point) {
  const Eigen::Vector2d from_centre = Eigen::Rotation2Dd(-ellipse.angle_rad) * (point - ellipse.centre_px);
  return Eigen::Vector2d(from_centre.x() / ellipse.semi_major_px, from_centre.y() / ellipse.semi_minor_px)
             .norm() -
         1.0;
}

// The closed form of a sphere's outline as independent reference. Mutations: a circle; the long axis across;
// the cosine in place of its root.
TEST(OutlinePx, IsThatOfASphere) {
  const vision::StereoRig rig;
  slam::RandomStream random(3, slam::Stream::kWorld);
  for (int i = 0; i < 500; ++i) {
    const double depth_m = 0.8 + 4.0 * random.uniform();
    const Eigen::Vector3d ball(depth_m * (random.uniform() - 0.5), 0.8 * depth_m * (random.uniform() - 0.5),
                               depth_m);
    const auto exact = vision::sphere_outline(rig.intrinsics, ball, 0.06).value();
    for (const Eigen::Vector2d& corner : outline_px(rig, exact.centre_px, exact.radius_px()))
      EXPECT_NEAR(off_ellipse(exact, corner), 0.0, 0.5 * 0.06 * 0.06 / (depth_m * depth_m));
  }
}

// Law: what a lens does to a place is undone by pinhole_point. Mutation: the lens left out.
TEST(TakenPx, IsWhereTheLensPutsIt) {
  vision::StereoRig rig;
  rig.distortion = {.k1 = -0.2, .k2 = 0.05, .p1 = 0.001, .p2 = -0.002, .pixel_aspect = 1.01};
  for (const double x : {20.0, 400.0, 900.0})
    for (const double y : {30.0, 380.0, 700.0}) {
      const Eigen::Vector2d taken = taken_px(rig, {x, y});
      EXPECT_GT((taken - Eigen::Vector2d(x, y)).norm(), 0.01);
      EXPECT_LT((vision::pinhole_point(rig, taken).value() - Eigen::Vector2d(x, y)).norm(), 1e-6);
    }
}

DetectionRow row(const std::string& outcome, std::optional<int> ball, bool required) {
  return {.seed = 2, .frame = 9, .outcome = outcome, .ball = ball, .is_required = required, .colour = ball};
}

// Mutations: a ball drawn once for each of its detections; one that was taken for another colour and found as
// missed; one that did not have to be found as missed.
TEST(PanelOf, DrawsEachBallOnceWithItsFate) {
  std::vector<DetectionRow> rows = {row("true_positive", 1, true),
                                    row("duplicate", 1, true),
                                    row("wrong_identity", 2, true),
                                    row("miss", 2, true),
                                    row("miss", 3, true),
                                    row("flagged", 4, false),
                                    row("false_positive", {}, false)};
  rows[2].detected_colour = 7;
  for (DetectionRow& one : rows) one.left_px = {10.0, 20.0};
  rows[3].left_px = rows[4].left_px = {kNan, kNan};
  const FramePanel panel = panel_of(rows, {}, vision::Side::kLeft);
  std::vector<Fate> balls, detections;
  for (const TrueOutline& outline : panel.truth) balls.push_back(outline.fate);
  for (const SeenCentre& seen : panel.detections) detections.push_back(seen.fate);
  EXPECT_THAT(balls, ElementsAre(Fate::kFound, Fate::kWrong, Fate::kMissed, Fate::kOther));
  EXPECT_THAT(detections, ElementsAre(Fate::kFound, Fate::kOther, Fate::kWrong, Fate::kOther, Fate::kFalse));
  EXPECT_EQ(panel.detections[2].label, "taken for 7");
  EXPECT_EQ(faults_of(rows), "2 missed, 1 misidentified, 1 of no ball, 1 repeated");
  EXPECT_EQ(faults_of(std::vector{rows[0], rows[5]}), "");
}

// Mutation: the left camera's places in the right picture.
TEST(PanelOf, HasThePlacesOfItsCamera) {
  DetectionRow found = row("true_positive", 1, true);
  found.left_px = {10.0, 20.0};
  found.right_px = {30.0, 40.0};
  found.true_left_px = {100.0, 200.0};
  found.true_right_px = {300.0, 400.0};
  const auto middle = [](const FramePanel& panel) {
    const auto& corners = panel.truth.at(0).corners_px;
    return Eigen::Vector2d(std::accumulate(corners.begin(), corners.end(), Eigen::Vector2d(0.0, 0.0)) /
                           static_cast<double>(corners.size()));
  };
  found.true_radius_px = 10.0;
  const std::vector rows = {found};
  const FramePanel left = panel_of(rows, {}, vision::Side::kLeft);
  const FramePanel right = panel_of(rows, {}, vision::Side::kRight);
  EXPECT_LT((left.detections.at(0).centre_px - found.left_px).norm(), 1e-9);
  EXPECT_LT((right.detections.at(0).centre_px - found.right_px).norm(), 1e-9);
  EXPECT_LT((middle(left) - found.true_left_px).norm(), 1e-6);
  EXPECT_LT((middle(right) - found.true_right_px).norm(), 1e-6);
}

// A baseline found ball 1 farther than it is, lost ball 2 and took ball 3 for colour 7; the present result
// lost ball 1. It knows nothing of ball 9. Mutations: errors without the truth that they are of; balls found
// as they are now; no miss for a lost ball.
TEST(RowsOfFindings, AreTheTruthWithWhatWasFoundThen) {
  std::vector<DetectionRow> now = {row("miss", 1, true), row("true_positive", 2, true), row("miss", 3, true)};
  for (DetectionRow& one : now) {
    one.true_range_m = 2.0;
    one.true_left_px = {100.0, 200.0};
    one.true_right_px = {50.0, 200.0};
  }
  now[1].range_m = 2.0;
  const BallFinding far = {.is_found = true,
                           .wrong_colour = {},
                           .range_error_m = 0.5,
                           .left_error_px = {1.0, 2.0},
                           .right_error_px = {3.0, 4.0}};
  const DetectedBalls then = {{{2, 9, 1}, {{.is_required = true}, far}},
                              {{2, 9, 2}, {{.is_required = true}, {}}},
                              {{2, 9, 3}, {{.is_required = true}, {.wrong_colour = 7}}},
                              {{2, 9, 9}, {{.is_required = true}, far}}};
  const std::vector<DetectionRow> rows = rows_of_findings(then, now);
  std::vector<std::string> outcomes;
  for (const DetectionRow& one : rows) outcomes.push_back(one.outcome);
  EXPECT_THAT(outcomes, ElementsAre("true_positive", "miss", "wrong_identity", "miss"));
  EXPECT_EQ(rows[0].range_m, 2.5);
  EXPECT_EQ(rows[0].left_px, Eigen::Vector2d(101.0, 202.0));
  EXPECT_EQ(rows[0].right_px, Eigen::Vector2d(53.0, 204.0));
  EXPECT_TRUE(std::isnan(rows[1].range_m));
  EXPECT_EQ(rows[2].detected_colour, 7);
}

TEST(RowsOf, AreThoseOfTheFrameOfTheSeed) {
  std::vector<DetectionRow> rows = {row("miss", 1, true), row("miss", 2, true), row("miss", 3, true)};
  rows[1].seed = 3;
  rows[2].frame = 8;
  const auto found = rows_of(rows, 2, 9);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].ball, 1);
}

// Mutations: cells of other columns; an empty cell as 0; the variance's square root.
TEST(ReadDetectionRows, ReadsEveryCellByItsName) {
  TestFolder folder;
  const auto file = folder.write(
      "detections.csv", detections_csv_header() +
                            "18446744073709551615,7,wrong_identity,3,1,4,1.5,-0.25,10,11,12,13,14,0.9,0.8,15,"
                            "6,1.75,-0.5,0.01,0.002,0.04,20,21,22,23\n2,8,false_positive" +
                            std::string(14, ',') + "5,1,0.5,1,0,1,,,,\n");
  const auto rows = read_detection_rows(file);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].seed, ~std::uint64_t{0});
  EXPECT_EQ(rows[0].frame, 7U);
  EXPECT_EQ(rows[0].outcome, "wrong_identity");
  EXPECT_EQ(rows[0].ball, 3);
  EXPECT_TRUE(rows[0].is_required);
  EXPECT_EQ(rows[0].colour, 4);
  EXPECT_EQ(rows[0].range_error_m(), 0.25);
  EXPECT_EQ(rows[0].bearing_rad - rows[0].true_bearing_rad, -0.25);
  EXPECT_EQ(rows[0].true_left_px, Eigen::Vector2d(10, 11));
  EXPECT_EQ(rows[0].true_right_px, Eigen::Vector2d(12, 13));
  EXPECT_EQ(rows[0].true_radius_px, 14.0);
  EXPECT_EQ(rows[0].detected_colour, 6);
  EXPECT_EQ(rows[0].covariance, (Eigen::Matrix2d() << 0.01, 0.002, 0.002, 0.04).finished());
  EXPECT_EQ(rows[0].left_px, Eigen::Vector2d(20, 21));
  EXPECT_EQ(rows[0].right_px, Eigen::Vector2d(22, 23));
  EXPECT_FALSE(rows[1].ball);
  EXPECT_FALSE(rows[1].is_required);
  EXPECT_TRUE(std::isnan(rows[1].true_range_m));
  EXPECT_TRUE(std::isnan(rows[1].left_px.x()));
  folder.write("detections.csv", detections_csv_header() + "1,2,miss\n");
  EXPECT_THAT([&] { read_detection_rows(file); },
              ThrowsMessage<std::runtime_error>(HasSubstr("detections.csv:2")));
}

// Law: the parts' squares add up to those of all, whatever the order. Mutations: a value in two parts, or in
// none; mean for rms.
TEST(BinnedRms, LosesNothing) {
  slam::RandomStream random(4, slam::Stream::kWorld);
  for (const std::size_t size : {1U, 19U, 39U, 40U, 161U, 1000U}) {
    std::vector<double> quantity, values;
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      quantity.push_back(random.uniform());
      values.push_back(random.normal());
      squares += values.back() * values.back();
      sum += quantity.back();
    }
    const BinnedRms bins = binned_rms(quantity, values);
    ASSERT_EQ(bins.rms.size(), std::clamp<std::size_t>(size / 20, 1, 8));
    double in_parts = 0.0, of_quantity = 0.0;
    for (std::size_t i = 0; i < bins.rms.size(); ++i) {
      const std::size_t parts = bins.rms.size();
      const auto count = static_cast<double>((i + 1) * size / parts - i * size / parts);
      in_parts += count * bins.rms[i] * bins.rms[i];
      of_quantity += count * bins.at[i];
      if (i > 0) {
        EXPECT_GT(bins.at[i], bins.at[i - 1]);
      }
    }
    EXPECT_NEAR(in_parts, squares, 1e-9 * squares);
    EXPECT_NEAR(of_quantity, sum, 1e-9 * sum);
  }
  EXPECT_TRUE(binned_rms({}, {}).rms.empty());
}

// 95 % of the intervals hold the true 1: 800 of them, so 760 +- 4 * 6.2. Mutations: the ends swapped; half
// the degrees of freedom; 90 %.
TEST(BinnedRms, IntervalsHoldTheTruthAsOftenAsTheySay) {
  for (const long degrees : {1L, 2L}) {
    slam::RandomStream random(6, slam::Stream::kWorld);
    int holds = 0;
    for (int i = 0; i < 800; ++i) {
      std::vector<double> quantity, values;
      for (int k = 0; k < 20; ++k) {
        double squares = 0.0;
        for (long part = 0; part < degrees; ++part)
          squares += std::pow(random.normal(), 2) / static_cast<double>(degrees);
        quantity.push_back(k);
        values.push_back(std::sqrt(squares));
      }
      const BinnedRms bins = binned_rms(quantity, values, degrees);
      holds += bins.low.at(0) <= 1.0 && 1.0 <= bins.high.at(0) ? 1 : 0;
    }
    EXPECT_NEAR(holds, 760, 25);
  }
}

// Detections whose errors are twice what is stated, of which every fourth ball is missed.
// Mutations: a wrong detection among the right ones; NIS in place of its half; misses left out.
TEST(DetectionCharts, ShowHowConsistentAndHowCompleteDetectionsAre) {
  slam::RandomStream random(7, slam::Stream::kWorld);
  std::vector<DetectionRow> rows;
  for (int i = 0; i < 4000; ++i) {
    DetectionRow one = row(i % 4 == 0 ? "miss" : "true_positive", i, true);
    one.true_range_m = 1.0 + 0.001 * i;
    one.covariance = Eigen::Vector2d(0.0001, 0.000004).asDiagonal();
    one.range_m = one.true_range_m + 2.0 * 0.01 * random.normal();
    one.bearing_rad = 2.0 * 0.002 * random.normal();
    rows.push_back(one);
  }
  rows.push_back(row("false_positive", {}, false));
  rows.back().range_m = 900.0;
  const NamedDetections sets[] = {{"", rows}};
  const std::vector<Chart> charts = detection_charts(sets);
  ASSERT_EQ(charts.size(), 4U);
  for (const double rms_mm : charts[0].series.at(0).y) EXPECT_NEAR(rms_mm, 20.0, 3.0);
  for (const double rms : charts[2].series.at(0).y) EXPECT_NEAR(rms, 2.0, 0.2);
  for (const double found : charts[3].series.at(0).y) EXPECT_NEAR(found, 0.75, 0.01);
  const NamedDetections nothing[] = {{"", {}}};
  EXPECT_TRUE(detection_charts(nothing).empty());
}

}  // namespace
}  // namespace stereobench::harness
