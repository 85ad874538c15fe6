/// Golden frames as files.
#include "harness/golden/golden_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/picture_file.h"
#include "tests/harness/golden/painted_frame.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;

bool is_same_picture(const cv::Mat& a, const cv::Mat& b) {
  return a.type() == b.type() && a.size() == b.size() && pixels_sha256(a) == pixels_sha256(b);
}

class GoldenFiles : public testing::Test {
 protected:
  GoldenFiles() { write_golden(folder_.path(), painted_frame()); }

  GoldenFrame read() const { return read_golden(folder_.path(), {3, 12}); }
  std::string refusal() const {
    try {
      read();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  TestFolder folder_;
};

// Law: what is written is read, and what is read is written as the same bytes. Mutations: surfaces of 8 bits;
// left for right; red for green.
TEST_F(GoldenFiles, AreReadBack) {
  const GoldenFrame written = painted_frame(), back = read();
  EXPECT_TRUE(is_same_picture(back.left.colour, written.left.colour));
  EXPECT_TRUE(is_same_picture(back.left.shown, written.left.shown));
  EXPECT_TRUE(is_same_picture(back.right.colour, written.right.colour));
  EXPECT_TRUE(is_same_picture(back.right.shown, written.right.shown));
  EXPECT_EQ(back.left.seen_sha256, written.left.seen_sha256);
  EXPECT_EQ(back.smaller, 4);
  EXPECT_EQ(back.first_mesh, kPaintedMesh);
  EXPECT_TRUE(compare_golden(written, back, golden_limits("exact")).is_none());
  const TestFolder again;
  write_golden(again.path(), back);
  for (const std::string& name : golden_file_names({3, 12})) {
    EXPECT_EQ(again.read(name), folder_.read(name)) << name;
    EXPECT_NE(folder_.read(name), "") << name;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 5);
}

TEST_F(GoldenFiles, KeepPicturesThatShowNothing) {
  GoldenFrame empty = painted_frame();
  empty.left.shown = 0;
  empty.left.colour = cv::Scalar::all(0);
  write_golden(folder_.path(), empty);
  EXPECT_TRUE(is_same_picture(read().left.shown, empty.left.shown));
  EXPECT_TRUE(is_same_picture(read().left.colour, empty.left.colour));
}

// Mutations: pictures read although their hashes are equal; hashes of one side.
TEST_F(GoldenFiles, AreNotReadWhereHashesAreEqual) {
  GoldenFrame now = painted_frame();
  for (const char* name : {"seed3_step0012_left.png", "seed3_step0012_right_shown.png"})
    fs::remove(folder_.path() / name);
  const GoldenCheck check = check_golden(folder_.path(), now, golden_limits("exact"));
  EXPECT_TRUE(check.difference.passes);
  EXPECT_FALSE(check.before);
  see_something_else(now.right);
  EXPECT_THROW(check_golden(folder_.path(), now, golden_limits("exact")), std::runtime_error);
}

TEST_F(GoldenFiles, AreComparedWhereHashesDiffer) {
  GoldenFrame now = painted_frame();
  now.right.colour.at<cv::Vec3b>(80, 60)[1] += 2;
  const GoldenCheck check = check_golden(folder_.path(), now, golden_limits("rounding"));
  EXPECT_FALSE(check.difference.passes);
  EXPECT_EQ(check.difference.right.beyond, 1);
  ASSERT_TRUE(check.before);
  EXPECT_TRUE(is_same_picture(check.before->right.colour, painted_frame().right.colour));
}

// Mutations: sizes or hashes that are not checked.
TEST_F(GoldenFiles, SayWhatIsWrongWithThem) {
  const std::string left = "seed3_step0012_left.png", png = folder_.read(left);
  folder_.write(left, png.substr(0, png.size() / 2));
  EXPECT_THAT(refusal(), AllOf(HasSubstr(left + ": "), HasSubstr("cut short")));
  folder_.write(left, "hello");
  EXPECT_THAT(refusal(), HasSubstr(left + ": "));
  folder_.write(left, encoded(".png", painted_frame().left.colour(cv::Rect(0, 0, 100, 50))));
  EXPECT_THAT(refusal(), HasSubstr(left + ": expected 160 x 110 pixels (got 100 x 50)"));
  folder_.write(left, folder_.read("seed3_step0012_left_shown.png"));
  EXPECT_THAT(refusal(), HasSubstr(left + ": is not the golden picture that was written"));
  fs::remove(folder_.path() / left);
  EXPECT_THAT(refusal(), HasSubstr(left + ": no such file"));
}

TEST_F(GoldenFiles, SayWhatIsWrongWithHashes) {
  const std::string name = "seed3_step0012.json", good = folder_.read(name);
  const auto spoilt = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    folder_.write(name, text);
    return refusal();
  };
  EXPECT_THAT(spoilt("[160, 110]", "[160]"), HasSubstr(name + ": size_px: expected a list of 2"));
  EXPECT_THAT(spoilt("\"smaller\": 4", "\"smaller\": 0"), HasSubstr(name + ": smaller: expected"));
  EXPECT_THAT(spoilt(std::string(64, '0'), "x"),
              HasSubstr("left.seen_sha256: expected 64 hexadecimal digits"));
  EXPECT_THAT(spoilt("\"linear\"", "\"liner\""), HasSubstr(name + ": "));
  fs::remove(folder_.path() / name);
  EXPECT_THAT(refusal(), HasSubstr(name + ": no such file"));
}

}  // namespace
}  // namespace stereobench::harness
