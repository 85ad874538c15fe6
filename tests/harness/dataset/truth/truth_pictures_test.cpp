#include "harness/dataset/truth/truth_pictures.h"

#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "harness/dataset/truth/truth_request.h"
#include "harness/io/picture_file.h"

namespace stereobench::harness {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

// Mutations: truncation for rounding; no zero for what does not fit.
TEST(TruthPictures, KittisDisparityIs256TimesAsLargeAndZeroForNone) {
  const cv::Mat disparity = (cv::Mat_<float>(1, 7) << kNone, 1.0F, 10.3F, 0.001F, -4.0F, 255.995F, 300.0F);
  const cv::Mat expected = (cv::Mat_<std::uint16_t>(1, 7) << 0, 256, 2637, 0, 0, 65535, 0);
  EXPECT_EQ(cv::countNonZero(kitti_disparity(disparity) != expected), 0) << kitti_disparity(disparity);
}

renderer::Correspondence three_pixels() {
  const cv::Mat shifts = (cv::Mat_<float>(1, 6) << 1.5F, -2.0F, kNone, kNone, 600.0F, 0.0F);
  const cv::Mat outcomes = (cv::Mat_<std::uint8_t>(1, 3) << 255, 0, 85);
  return {shifts.reshape(2), outcomes};
}

// The file's order is red, green, blue: u, v, valid. Mutations: channels in OpenCV's order; no offset.
TEST(TruthPictures, KittisFlowIsUVAndValidInThisOrder) {
  const cv::Mat picture = kitti_shift(three_pixels());
  EXPECT_EQ(picture.at<cv::Vec3w>(0, 0), cv::Vec3w(1, 32768 - 128, 32768 + 96));
  EXPECT_EQ(picture.at<cv::Vec3w>(0, 1), cv::Vec3w(0, 0, 0));
  EXPECT_EQ(picture.at<cv::Vec3w>(0, 2), cv::Vec3w(0, 0, 0));
}

// A PFM file holds its rows from the bottom up, each pixel's x, y, z as red, green, blue. Mutation: OpenCV's
// order.
TEST(TruthPictures, FilesHoldXYZInThisOrder) {
  const cv::Mat normals(1, 1, CV_32FC3, cv::Scalar(0.25, 0.5, -1.0));
  const std::string file = encoded(".pfm", normal_picture(normals));
  float xyz[3];
  std::memcpy(xyz, file.data() + file.size() - sizeof xyz, sizeof xyz);
  EXPECT_EQ(xyz[0], 0.25F);
  EXPECT_EQ(xyz[1], 0.5F);
  EXPECT_EQ(xyz[2], -1.0F);
  const std::string shifts = encoded(".pfm", exact_shift(three_pixels()));
  std::memcpy(xyz, shifts.data() + shifts.size() - 3 * sizeof xyz, sizeof xyz);
  EXPECT_EQ(xyz[0], 1.5F);
  EXPECT_EQ(xyz[1], -2.0F);
  EXPECT_EQ(xyz[2], 1.0F);
}

TEST(TruthRequest, ReadsListsAndAll) {
  EXPECT_EQ(parse_truth("flow,balls,flow"), (std::vector{TruthKind::kBalls, TruthKind::kFlow}));
  EXPECT_EQ(parse_truth("all").size(), 7U);
  for (const char* text : {"", "flow,", "floww", "all,flow"})
    EXPECT_THROW(parse_truth(text), std::runtime_error) << text;
  EXPECT_EQ(parse_truth_format("kitti"), TruthFormat::kKitti);
  EXPECT_THROW(parse_truth_format("tum"), std::runtime_error);
}

}  // namespace
}  // namespace stereobench::harness
