#include "harness/dataset/pictures/picture_change.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/dataset/pictures/area_mean.h"
#include "tests/complaint.h"
#include "tests/harness/dataset/step_writer.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

/// Any picture: no two rows or channels alike.
cv::Mat speckled(int type, int rows = 48, int columns = 60) {
  cv::Mat picture(rows, columns, type);
  cv::RNG(7).fill(picture, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_8U ? 256 : 65536);
  return picture;
}

DatasetDrive room_of(const TruthRequest& truth = {}) {
  const worlds::Scenario scenario = room_drive();
  return drive_of(scenario, scenario.world, 0, {}, truth);
}

// Law: where a changed camera shows a point is where the whole picture's pixel went that shows it; pixel c
// covers what lies around N (c + 0.5) - 0.5. Mutations: cx / N; focal length not
// divided.
TEST(PictureChange, MovesPixelsAndCameraAlike) {
  vision::StereoRig rig;
  rig.intrinsics = {640, 480, 500.0, 311.25, 250.5};
  rig.distortion = {.k1 = -0.2, .p1 = 0.01, .pixel_aspect = 1.1};
  const PictureChange change = {.crop = cv::Rect(31, 17, 600, 450), .divide = 3};
  const vision::StereoRig small = changed(rig, change);
  EXPECT_EQ(small.intrinsics.width_px, 200);
  EXPECT_EQ(small.intrinsics.height_px, 150);
  for (const Eigen::Vector3d& point :
       {Eigen::Vector3d(0.0, 0.0, 1.0), Eigen::Vector3d(0.4, -0.3, 1.7), Eigen::Vector3d(-1.0, 0.5, 3.0)}) {
    const Eigen::Vector2d whole = vision::image_point(rig, point), now = vision::image_point(small, point);
    EXPECT_NEAR(now.x(), (whole.x() - 31 + 0.5) / 3 - 0.5, 1e-9);
    EXPECT_NEAR(now.y(), (whole.y() - 17 + 0.5) / 3 - 0.5, 1e-9);
  }
  EXPECT_EQ(changed(rig, {.crop = cv::Rect(31, 17, 600, 450)}).intrinsics.cx_px, 311.25 - 31);
}

// Mutations: the K-th in place of the first; steps counted where frames are lost.
TEST(PictureChange, LeavesEachSoManiethPair) {
  DatasetDrive drive = room_of();
  EXPECT_THAT(steps_with_pictures(changed(drive, {.every = 2})), testing::ElementsAre(0, 2));
  drive.steps[0].pictures.reset();
  EXPECT_THAT(steps_with_pictures(changed(drive, {.every = 2})), testing::ElementsAre(1));
  EXPECT_EQ(changed(drive, {.every = 2}).steps.size(), 3U);
}

// Law: the mean of a picture stays, within what halves rounded to even numbers leave. Mutations: halves
// rounded up (0.13 levels more at N = 2); one of the N x N left out.
TEST(AreaMean, KeepsTheMean) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC3})
    for (const int divide : {1, 2, 3, 4}) {
      const cv::Mat picture = speckled(type, 240, 240), small = area_mean(picture, divide);
      EXPECT_EQ(small.size(), cv::Size(240 / divide, 240 / divide));
      const cv::Scalar was = cv::mean(picture), is = cv::mean(small);
      for (int channel = 0; channel < CV_MAT_CN(type); ++channel)
        EXPECT_NEAR(is[channel], was[channel], 0.02) << type << " " << divide;
    }
}

// A pixel is the mean of its own pixels.
TEST(AreaMean, IsOfThePixelsThatAPixelCovers) {
  const cv::Mat picture = speckled(CV_8UC3);
  const cv::Mat small = area_mean(picture, 4);
  for (const cv::Point pixel : {cv::Point(0, 0), cv::Point(5, 2), cv::Point(14, 11)}) {
    const cv::Scalar mean = cv::mean(picture(cv::Rect(4 * pixel.x, 4 * pixel.y, 4, 4)));
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(small.at<cv::Vec3b>(pixel)[channel], mean[channel], 0.5);
  }
}

// Mutations: blue first; columns and rows swapped in the greens' place cannot show: they are one channel.
TEST(PictureKinds, MosaicTakesRedFirstAndGreyIsBt601) {
  const cv::Mat picture = speckled(CV_8UC3);
  const cv::Mat mosaic = in_kind(picture, PictureKind::kBayer);
  const cv::Mat grey = in_kind(picture, PictureKind::kGrey);
  ASSERT_EQ(mosaic.type(), type_of(PictureKind::kBayer));
  ASSERT_EQ(grey.type(), type_of(PictureKind::kGrey));
  const auto at = [&](int row, int column) { return picture.at<cv::Vec3b>(row, column); };
  for (const int row : {0, 10, 46})
    for (const int column : {0, 4, 58}) {
      EXPECT_EQ(mosaic.at<std::uint8_t>(row, column), at(row, column)[2]);
      EXPECT_EQ(mosaic.at<std::uint8_t>(row, column + 1), at(row, column + 1)[1]);
      EXPECT_EQ(mosaic.at<std::uint8_t>(row + 1, column), at(row + 1, column)[1]);
      EXPECT_EQ(mosaic.at<std::uint8_t>(row + 1, column + 1), at(row + 1, column + 1)[0]);
      const cv::Vec3b bgr = at(row, column);
      EXPECT_NEAR(grey.at<std::uint8_t>(row, column), 0.299 * bgr[2] + 0.587 * bgr[1] + 0.114 * bgr[0], 0.51);
    }
}

TEST(PictureChange, RefusesWordsThatItDoesNotKnow) {
  for (const char* text : {"", "0", "-1", "2.5", "3x", "1,2"})
    EXPECT_EQ(complaint_of([&] { parse_every(text); }),
              fmt::format("--every: expected a whole number from 1 on, as 10 for each tenth pair (got '{}')",
                          text));
  for (const char* text : {"1,2,3", "1,2,3,0", "-1,0,3,4", "1,2,3,4,5", "1;2;3;4"})
    EXPECT_EQ(complaint_of([&] { parse_crop(text); }),
              fmt::format("--crop: expected X,Y,W,H in pixels, as 128,96,640,480 (got '{}')", text));
  for (const char* text : {"0.5", "1/0", "2/3", "1/", "1/2x", "2"})
    EXPECT_EQ(complaint_of([&] { parse_scale(text); }),
              fmt::format("--scale: expected 1/N, as 1/2 (got '{}')", text));
  EXPECT_EQ(complaint_of([] { parse_picture_kind("gray"); }),
            "--picture: expected colour, grey, bayer-rggb, linear16 (got 'gray')");
  EXPECT_EQ(parse_every("12"), 12U);
  EXPECT_EQ(parse_crop("1,2,3,4"), cv::Rect(1, 2, 3, 4));
  EXPECT_EQ(parse_scale("1/3"), 3);
}

TEST(PictureChange, RefusesWhatADriveHasNotTheTruthOf) {
  const auto of = [](const DatasetDrive& drive, const PictureChange& change) {
    return complaint_of([&] { changed(drive, change); });
  };
  DatasetDrive drive = room_of({.kinds = {TruthKind::kFlow}});  // 160 x 120 px
  EXPECT_EQ(of(drive, {.crop = cv::Rect(100, 0, 61, 60)}),
            "--crop: 100,0,61,60 reaches out of the pictures, which are 160 x 120 px");
  EXPECT_EQ(of(drive, {.divide = 7}),
            "--scale: 160 x 120 px are no multiple of 7; cut them with --crop 0,0,154,119");
  EXPECT_EQ(of(drive, {.crop = cv::Rect(3, 5, 81, 60), .divide = 2}),
            "--scale: 81 x 60 px are no multiple of 2; cut them with --crop 3,5,80,60");
  EXPECT_EQ(of(drive, {.divide = 200}), "--scale: 1/200 of 160 x 120 px is less than a pixel");
  drive.shutter.right_delay_s = 0.01;
  EXPECT_EQ(of(drive, {.crop = cv::Rect(0, 0, 80, 60)}), "no complaint");
  EXPECT_EQ(
      of(drive, {.divide = 2}),
      "--scale: the flow of a right camera that looks late (shutter.right_delay_s) is not known between "
      "pixels; leave --scale or --truth flow out");
  drive = room_of();
  drive.shutter.readout_s = 0.01;
  EXPECT_EQ(of(drive, {.every = 2, .kind = PictureKind::kGrey}), "no complaint");
  EXPECT_EQ(
      of(drive, {.crop = cv::Rect(0, 0, 80, 60)}),
      "--crop: rows of a rolling shutter (shutter.readout_s) look one after another, and poses hold for "
      "the middle row of the whole picture; leave it out");
}

}  // namespace
}  // namespace stereobench::harness
