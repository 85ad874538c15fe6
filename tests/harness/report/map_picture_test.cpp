#include "harness/report/map_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "harness/report/legend.h"
#include "slam/math/random.h"
#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

/// The pixels of a colour within the plot, so without the legend.
std::vector<Point> plotted(const MapPicture& picture, const Colour& colour) {
  const Box plot = lay_out_map(picture).axes.plot();
  std::vector<Point> found = pixels_of(decoded(draw_map_picture(picture)), colour);
  std::erase_if(found, [&](const Point& p) { return p.x_px > plot.left_px + plot.width_px; });
  return found;
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Eigen::Vector2d along(b.x_px - a.x_px, b.y_px - a.y_px);
  const Eigen::Vector2d to(p.x_px - a.x_px, p.y_px - a.y_px);
  return (to - std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm();
}

MapPicture random_map(std::uint64_t seed) {
  slam::RandomStream random(seed, slam::Stream::kWorld);
  MapPicture picture;
  picture.title = "a map";
  const auto somewhere = [&] { return Eigen::Vector2d(20.0 * random.normal(), 5.0 * random.normal()); };
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector2d at = somewhere();
    picture.true_path.push_back({at.x(), at.y(), random.normal()});
    picture.landmarks.push_back({i, i - 2, somewhere()});
  }
  for (const char* filter : {"dead_reckoning", "fastslam2", "ufastslam"}) {
    MapEstimate estimate{filter, picture.true_path, {}};
    for (const LandmarkTruth& landmark : picture.landmarks) {
      estimate.landmarks.push_back(
          {landmark.landmark_id, 0, landmark.position_m, Eigen::Matrix2d::Identity()});
    }
    picture.estimates.push_back(estimate);
  }
  picture.walls.push_back({somewhere(), somewhere()});
  return picture;
}

// Catches: x and y swapped, y growing downwards, a margin forgotten in the mapping, filters' colours swapped.
TEST(ReportMap, APathIsDrawnWhereTheMappingSays) {
  slam::RandomStream random(7, slam::Stream::kWorld);
  for (int trial = 0; trial < 5; ++trial) {
    MapPicture picture;
    const slam::Pose from = {10.0 * random.normal(), random.normal(), 0.0};
    const slam::Pose to = {10.0 * random.normal(), random.normal(), 0.0};
    picture.estimates = {{"ufastslam", {from, to}, {}}};
    const Axes axes = lay_out_map(picture).axes;
    const Point a = axes.to_pixel(from.x_m, from.y_m);
    const Point b = axes.to_pixel(to.x_m, to.y_m);
    const std::vector<Point> line = plotted(picture, filter_stroke("ufastslam").colour);
    ASSERT_GT(static_cast<double>(line.size()), 0.5 * std::hypot(a.x_px - b.x_px, a.y_px - b.y_px));
    double nearest_to_a = 1e9;
    for (const Point& p : line) {
      EXPECT_LT(distance_to_segment(p, a, b), 2.2);
      nearest_to_a = std::min(nearest_to_a, std::hypot(p.x_px - a.x_px, p.y_px - a.y_px));
    }
    EXPECT_LT(nearest_to_a, 2.5);
  }
}

TEST(ReportMap, EverythingFitsAndMetresAreAlikeBothWays) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MapPicture picture = random_map(seed);
    const MapSheet sheet = lay_out_map(picture);
    const Box& plot = sheet.axes.plot();
    for (const LandmarkTruth& landmark : picture.landmarks) {
      const Point at = sheet.axes.to_pixel(landmark.position_m.x(), landmark.position_m.y());
      EXPECT_TRUE(at.x_px > plot.left_px && at.x_px < plot.left_px + plot.width_px);
      EXPECT_TRUE(at.y_px > plot.top_px && at.y_px < plot.top_px + plot.height_px);
    }
    const Point origin = sheet.axes.to_pixel(0.0, 0.0);
    EXPECT_NEAR(sheet.axes.to_pixel(1.0, 0.0).x_px - origin.x_px,
                origin.y_px - sheet.axes.to_pixel(0.0, 1.0).y_px, 1e-9);
  }
}

// The ball of colour 0 is a disc of its own colour at its place. Catches: red and blue swapped, a wrong
// palette row.
TEST(ReportMap, ABallIsADiscOfItsColour) {
  MapPicture picture;
  picture.landmarks = {{0, 0, {1.0, 2.0}}, {1, 1, {4.0, 3.0}}};
  const Axes axes = lay_out_map(picture).axes;
  for (const auto& [colour, place] :
       {std::pair{Colour{229 / 255.0, 0.0, 0.0, 1.0}, axes.to_pixel(1.0, 2.0)},
        std::pair{Colour{0.0, 229 / 255.0, 0.0, 1.0}, axes.to_pixel(4.0, 3.0)}}) {
    const std::vector<Point> disc = plotted(picture, colour);
    ASSERT_GT(disc.size(), 60u);
    EXPECT_NEAR(mean_of(disc).x_px, place.x_px, 0.3);
    EXPECT_NEAR(mean_of(disc).y_px, place.y_px, 0.3);
  }
}

// Catches: a landmark's ellipse of one sigma, or one that is drawn for its variance.
TEST(ReportMap, TheEllipseReachesTheChiSquareDistance) {
  MapPicture picture;
  Eigen::Matrix2d covariance = Eigen::Vector2d(4.0, 0.25).asDiagonal();
  picture.estimates = {{"fastslam2", {}, {{0, 0, {0.0, 0.0}, covariance}}}};
  picture.landmarks = {{0, 0, {-8.0, -8.0}}, {1, 0, {8.0, 8.0}}};
  const Axes axes = lay_out_map(picture).axes;
  const std::vector<Point> line = plotted(picture, filter_stroke("fastslam2").colour);
  ASSERT_FALSE(line.empty());
  const auto [left, right] = std::minmax_element(
      line.begin(), line.end(), [](const Point& a, const Point& b) { return a.x_px < b.x_px; });
  EXPECT_NEAR(left->x_px, axes.to_pixel(-2.0 * std::sqrt(5.9915), 0.0).x_px, 1.5);
  EXPECT_NEAR(right->x_px, axes.to_pixel(2.0 * std::sqrt(5.9915), 0.0).x_px, 1.5);
}

// Catches: an arrowhead that turns clockwise, or points backwards.
TEST(ReportMap, TheStartPointsWhereTheRobotLooks) {
  for (const double heading_rad : {0.0, 0.5 * std::numbers::pi, 2.5, -1.0}) {
    MapPicture picture;
    picture.true_path = {{0.0, 0.0, heading_rad}};
    picture.landmarks = {{0, 0, {-3.0, -3.0}}, {1, 0, {3.0, 3.0}}};
    const Point start = lay_out_map(picture).axes.to_pixel(0.0, 0.0);
    const std::vector<Point> arrow = plotted(picture, kBlack);
    double ahead_px = 0.0;
    double behind_px = 0.0;
    for (const Point& p : arrow) {
      const double along_px =
          (p.x_px - start.x_px) * std::cos(heading_rad) - (p.y_px - start.y_px) * std::sin(heading_rad);
      ahead_px = std::max(ahead_px, along_px);
      behind_px = std::max(behind_px, -along_px);
    }
    EXPECT_GT(ahead_px, behind_px + 1.0);
  }
}

// Catches: filters of one width, of which the last hides the others and the truth.
TEST(ReportMap, PathsThatLieOnEachOtherAreAllSeen) {
  MapPicture picture;
  picture.true_path = {{0.0, 0.0, 0.0}, {10.0, 4.0, 0.0}};
  picture.estimates = {{"fastslam2", picture.true_path, {}}, {"ufastslam", picture.true_path, {}}};
  for (const Colour& colour :
       {kBlack, filter_stroke("fastslam2").colour, filter_stroke("ufastslam").colour}) {
    EXPECT_GT(pixels_of(decoded(draw_map_picture(picture)), colour, 90.0).size(), 300u);
  }
}

TEST(ReportMap, WhatIsNotFiniteIsLeftOut) {
  const MapPicture clean = random_map(3);
  MapPicture dirty = clean;
  dirty.landmarks.push_back({99, 3, {kNaN, 0.0}});
  dirty.true_path.push_back({kNaN, kNaN, 0.0});
  dirty.walls.push_back({{kNaN, 0.0}, {1.0, 1.0}});
  dirty.walls.back().to_m = {0.0, kNaN};
  dirty.estimates[1].landmarks.push_back({7, 7, {kNaN, 1.0}, Eigen::Matrix2d::Identity()});
  dirty.estimates[2].path.push_back({0.0, std::numeric_limits<double>::infinity(), 0.0});
  EXPECT_EQ(draw_map_picture(dirty), draw_map_picture(clean));
}

TEST(ReportMap, NothingIsAnEmptyChart) {
  const cv::Mat image = decoded(draw_map_picture({}));
  EXPECT_GT(image.cols, 400);
  EXPECT_GT(image.rows, 300);
}

TEST(ReportMap, TheSameMapIsTheSameBytes) {
  EXPECT_EQ(draw_map_picture(random_map(5)), draw_map_picture(random_map(5)));
  EXPECT_NE(draw_map_picture(random_map(5)), draw_map_picture(random_map(6)));
}

}  // namespace
}  // namespace stereobench::harness
