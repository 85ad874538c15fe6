#include "harness/preview/contact_sheet.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>

#include "harness/preview/film.h"
#include "tests/complaint.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ChannelFile held(const cv::Mat& picture) {
  return {.file = "held", .read = [picture] { return picture; }};
}

/// Frames of one colour each, with a ball in the middle and disparities that grow to the right.
DatasetView view_of(int frames, const cv::Size& size = {64, 48}) {
  DatasetView view = {.format = "plain", .folder = "nowhere"};
  for (int i = 0; i < frames; ++i) {
    ViewFrame frame = {.name = fmt::format("{:06}", i)};
    cv::Mat ids(size, CV_8UC1, cv::Scalar(0)), disparity_px(size, CV_32FC1);
    ids(cv::Rect(size.width / 4, size.height / 4, size.width / 2, size.height / 2)) = 1 + i;
    for (int column = 0; column < size.width; ++column)
      disparity_px.col(column) =
          column == 0 ? std::numeric_limits<float>::infinity() : static_cast<float>(column);
    frame.channels[0][Channel::kPicture] = held({size, CV_8UC3, cv::Scalar(16, 160, 40)});
    frame.channels[1][Channel::kPicture] = held({size, CV_8UC3, cv::Scalar(200, 16, 16)});
    frame.channels[0][Channel::kBallId] = held(ids);
    frame.channels[0][Channel::kDisparity] = held(disparity_px);
    view.frames.push_back(frame);
  }
  return view;
}

cv::Mat decoded(const std::string& png) {
  return cv::imdecode(std::vector<std::uint8_t>(png.begin(), png.end()), cv::IMREAD_COLOR);
}

TEST(ContactSheet, TakesPairsEvenly) {
  EXPECT_THAT(evenly_spaced(10, 4), ElementsAre(0, 3, 6, 9));
  EXPECT_THAT(evenly_spaced(72, 2), ElementsAre(0, 71));
  EXPECT_THAT(evenly_spaced(3, 6), ElementsAre(0, 1, 2));
  EXPECT_THAT(evenly_spaced(7, 1), ElementsAre(0));
  for (std::size_t all = 1; all < 40; ++all)
    for (std::size_t count = 1; count < 40; ++count) {
      const auto indices = evenly_spaced(all, count);
      ASSERT_EQ(indices.size(), std::min(all, count));
      EXPECT_EQ(std::ranges::adjacent_find(indices, std::greater_equal<>()), indices.end());
      EXPECT_LT(indices.back(), all);
    }
}

// Columns are left, right, disparity, balls: 320 px each where that weighs little.
TEST(ContactSheet, ShowsWhatTheSetHas) {
  const cv::Mat sheet = decoded(contact_sheet(view_of(2), {0, 1}, "test"));
  ASSERT_EQ(sheet.cols, 8 + 4 * 328);
  ASSERT_EQ(sheet.rows, 44 + 2 * (20 + 240) + 8);
  const auto at = [&](int column, int row, int x, int y) {
    return sheet.at<cv::Vec3b>(64 + row * 260 + y, 8 + column * 328 + x);
  };
  EXPECT_EQ(at(0, 0, 160, 120), cv::Vec3b(16, 160, 40));
  EXPECT_EQ(at(1, 0, 160, 120), cv::Vec3b(200, 16, 16));
  EXPECT_EQ(at(2, 0, 1, 120), cv::Vec3b(0, 0, 0));
  EXPECT_GT(at(2, 0, 315, 120)[2], at(2, 0, 315, 120)[0]);  // near is red
  EXPECT_GT(at(2, 0, 20, 120)[0], at(2, 0, 20, 120)[2]);
  const cv::Vec3b one = at(3, 0, 160, 120), other = at(3, 1, 160, 120);
  EXPECT_GT(cv::norm(one, other), 100.0);
  const cv::Vec3b beside = at(3, 0, 10, 10);
  EXPECT_EQ(beside[0], beside[2]);
}

// What a set has not leaves no column; without disparity, depth takes its place.
TEST(ContactSheet, LeavesOutWhatTheSetHasNot) {
  DatasetView view = view_of(1);
  view.frames[0].channels[0].erase(Channel::kDisparity);
  view.frames[0].channels[0].erase(Channel::kBallId);
  view.frames[0].channels[1].clear();
  EXPECT_EQ(decoded(contact_sheet(view, {0}, "test")).cols, 8 + 328);
  view.frames[0].channels[0][Channel::kDepth] = held({48, 64, CV_32FC1, cv::Scalar(2.0)});
  EXPECT_EQ(decoded(contact_sheet(view, {0}, "test")).cols, 8 + 2 * 328);
  view.frames[0].channels[0].clear();
  EXPECT_EQ(complaint_of([&] { contact_sheet(view, {0}, "test"); }), "frame 000000: has no left picture");
}

// Law: a sheet weighs less than it may, however noisy its pictures.
TEST(ContactSheet, WeighsLessThanAMegabyte) {
  DatasetView view = view_of(12, {640, 480});
  cv::Mat noise(480, 640, CV_8UC3);
  cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 256);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < view.frames.size(); ++i) {
    for (auto& channels : view.frames[i].channels) channels[Channel::kPicture] = held(noise);
    all.push_back(i);
  }
  const std::string png = contact_sheet(view, all, "noise");
  EXPECT_LE(png.size(), kMostSheetBytes);
  EXPECT_GT(decoded(png).cols, 300);
}

}  // namespace
}  // namespace stereobench::harness
