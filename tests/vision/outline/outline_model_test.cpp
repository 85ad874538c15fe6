#include "vision/outline/outline_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/stereo/sphere.h"

namespace stereobench::vision {
namespace {

// Catches: a dropped eccentricity correction in the fit's model, a transposed axis.
TEST(OutlineModel, IsTheOutlineOfTheBallThatItBelongsTo) {
  painter::Dice dice(3);
  const Intrinsics camera;
  for (int i = 0; i < 500; ++i) {
    const double z = dice.uniform(0.3, 9.0);
    const Eigen::Vector3d ball(dice.uniform(-0.6, 0.6) * z, dice.uniform(-0.5, 0.5) * z, z);
    const auto ellipse = sphere_outline(camera, ball, 0.05);
    ASSERT_TRUE(ellipse.has_value());
    const OutlineModel model(camera, ellipse->centre_px, ellipse->radius_px());
    const Eigen::Vector2d major(std::cos(ellipse->angle_rad), std::sin(ellipse->angle_rad));
    const Eigen::Vector2d minor(-major.y(), major.x());
    ASSERT_NEAR(model.semi_major_px(), ellipse->semi_major_px, 1e-6);
    ASSERT_NEAR(model.rim_point(ellipse->centre_px + ellipse->semi_minor_px * minor).distance_px, 0.0, 1e-6);
    const RimPoint beyond = model.rim_point(ellipse->centre_px + (ellipse->semi_major_px + 1.5) * major);
    ASSERT_NEAR(beyond.distance_px, 1.5, 1e-5);
    ASSERT_NEAR(beyond.normal.dot(major), 1.0, 1e-9);
  }
}

TEST(OutlineModel, ColumnsOfARowAreThoseWithinTheLevel) {
  const OutlineModel model({}, {830.3, 611.7}, 21.4);
  for (int row = 580; row < 645; ++row) {
    for (const double level : {0.5, 1.0, 1.2}) {
      const ColumnSpan columns = model.columns_within(level, row);
      for (int x = 795; x < 870; ++x) {
        const bool inside = model.level(Eigen::Vector2d(x, row)) <= level;
        ASSERT_EQ(inside, x >= columns.first && x <= columns.last) << x << ", " << row;
      }
    }
  }
}

// Mutations: the left span as far as the inner one's end; the inner ellipse's columns for the outer's.
TEST(OutlineModel, RingsAreVisitedOncePixelByPixel) {
  const cv::Size image(120, 90);
  for (const Eigen::Vector2d& centre : {Eigen::Vector2d(60.2, 45.7), Eigen::Vector2d(8.4, 80.1)}) {
    const OutlineModel model({.cx_px = 700.0}, centre, 21.4);
    for (const double innermost : {-0.2, 0.0, 0.6, 0.98}) {
      cv::Mat visits(image, CV_8U, cv::Scalar(0));
      visit_ring(model, innermost, 1.1, image, 1, [&](const ColumnSpan& columns, int y) {
        ASSERT_LE(columns.first, columns.last);
        for (int x = columns.first; x <= columns.last; ++x) ++visits.at<std::uint8_t>(y, x);
      });
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
          const double level = model.level(Eigen::Vector2d(x, y));
          const int visited = visits.at<std::uint8_t>(y, x);
          ASSERT_LE(visited, level <= 1.1 ? 1 : 0) << x << ", " << y;
          ASSERT_GE(visited, level > innermost && level <= 1.1 ? 1 : 0) << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace stereobench::vision
