/// Two golden frames side by side.
#include "harness/golden/golden_picture.h"

#include <gtest/gtest.h>

#include "tests/harness/golden/painted_frame.h"
#include "tests/harness/report/pixels.h"

namespace stereobench::harness {
namespace {

constexpr int kPanelHeight_px = 352;  // of pictures of 160 x 110 pixels, 512 wide

/// The picture's pixel that shows a pixel of a golden picture. @param column before, after or difference
cv::Vec3b shown_at(const cv::Mat& sheet, int column, bool is_left, int u, int v) {
  const int top = sheet.rows - (is_left ? 2 : 1) * (kPanelHeight_px + 8);
  const int x = 8 + column * (512 + 8) + static_cast<int>((u + 0.5) * 512.0 / 160.0);
  const int y = top + static_cast<int>((v + 0.5) * kPanelHeight_px / 110.0);
  return sheet.at<cv::Vec3b>(y, x);
}

// Mutations: before for after; the right camera above; no amplification; levels that are shown as they are.
TEST(GoldenPicture, ShowsBeforeAfterAndDifference) {
  const GoldenFrame before = painted_frame();
  GoldenFrame after = painted_frame();
  after.right.colour.at<cv::Vec3b>(80, 60)[2] += 12;
  const GoldenDifference difference = compare_golden(before, after, golden_limits("rounding"));
  const cv::Mat sheet = decoded(draw_golden_difference("office", before, after, difference));
  EXPECT_EQ(sheet.cols, 3 * 512 + 4 * 8);
  EXPECT_GT(shown_at(sheet, 1, false, 60, 80)[2], shown_at(sheet, 0, false, 60, 80)[2] + 10);
  EXPECT_EQ(shown_at(sheet, 1, true, 60, 80), shown_at(sheet, 0, true, 60, 80));
  EXPECT_GT(shown_at(sheet, 2, false, 60, 80)[2], 200);
  EXPECT_LT(shown_at(sheet, 2, false, 62, 80)[2], 70);
  EXPECT_LT(shown_at(sheet, 2, true, 60, 80)[2], 70);
  const int level = before.left.colour.at<cv::Vec3b>(90, 20)[1];
  EXPECT_GT(shown_at(sheet, 0, true, 20, 90)[1], level + 40);  // linear 100 is sRGB 169
}

// Law: equal frames give equal bytes, with a line that says that nothing changed.
TEST(GoldenPicture, IsTheSameEachTime) {
  const GoldenFrame frame = painted_frame();
  const GoldenDifference none = compare_golden(frame, frame, golden_limits("exact"));
  EXPECT_EQ(draw_golden_difference("a", frame, frame, none), draw_golden_difference("a", frame, frame, none));
  GoldenFrame smaller = frame;
  smaller.left.colour = smaller.left.colour(cv::Rect(0, 0, 80, 60));
  EXPECT_THROW(draw_golden_difference("a", frame, smaller, none), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
