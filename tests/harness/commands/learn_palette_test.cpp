/// `stereobench learn-palette` and `detect --palette`, on pictures that are drawn and on a real one.
#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/dataset/palette_file.h"
#include "tests/complaint.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

/// A ball that a person sees in a picture.
struct SeenBall {
  double x_px, y_px, radius_px;
  const char* colour;
};

/// Debian's opencv-doc, or where STEREOBENCH_OPENCV_DOC says it is.
std::filesystem::path smarties() {
  const char* set = std::getenv("STEREOBENCH_OPENCV_DOC");
  return std::filesystem::path(set != nullptr ? set : "/usr/share/doc/opencv-doc") /
         "examples/data/smarties.png";
}

constexpr const char* kSmartiesMarks = R"({"marks": [
  {"picture": "smarties.png", "colour": "red", "circle_px": [33.7, 228.6, 22]},
  {"picture": "smarties.png", "colour": "green", "circle_px": [269, 117.7, 22]},
  {"picture": "smarties.png", "colour": "orange", "circle_px": [205.5, 211.4, 22]},
  {"picture": "smarties.png", "colour": "blue", "box_px": [332, 222, 32, 32]}]})";

// Four are marked, all twelve are found, neither of the brown ones is. Mutation: the gate left out.
TEST(Smarties, TheTwelveColouredOnesAreFound) {
  if (!std::filesystem::exists(smarties())) GTEST_SKIP() << "no opencv-doc";
  constexpr SeenBall kSeen[] = {
      {377.5, 81.5, 26.5, "blue"},    {269.0, 117.7, 26.5, "green"}, {387.4, 170.3, 26.5, "green"},
      {205.5, 211.4, 26.5, "orange"}, {288.0, 213.5, 26.5, "red"},   {347.7, 238.1, 26.5, "blue"},
      {33.7, 228.6, 26.0, "red"},     {98.7, 259.2, 27.0, "red"},    {219.9, 306.2, 28.0, "red"},
      {134.9, 327.3, 27.0, "orange"}, {294.3, 320.3, 27.6, "blue"},  {8.8, 355.4, 26.5, "green"}};
  const TestFolder scratch;
  const std::string marks = scratch.write("marks.json", kSmartiesMarks);
  std::filesystem::copy(smarties(), scratch.path() / "smarties.png");
  const std::string palette = (scratch.path() / "palette.json").string();
  const Outcome learned = run_stereobench({"learn-palette", marks, "--out", palette});
  ASSERT_EQ(learned.exit_code, 0) << learned.err;
  const Outcome found = run_stereobench({"detect", (scratch.path() / "smarties.png").string(), "--palette",
                                         palette, "--draw", (scratch.path() / "drawn").string()});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const auto balls = nlohmann::json::parse(found.out)["balls"];
  EXPECT_EQ(balls.size(), 12U) << balls.dump(1);
  for (const SeenBall& seen : kSeen) {
    int here = 0;
    for (const auto& ball : balls) {
      const double x = ball["left_px"][0].get<double>() - seen.x_px;
      const double y = ball["left_px"][1].get<double>() - seen.y_px;
      if (x * x + y * y > 25.0) continue;
      ++here;
      EXPECT_EQ(ball["name"], seen.colour);
      EXPECT_NEAR(ball["left_radius_px"].get<double>(), seen.radius_px,
                  ball.contains("truncated") ? 4.0 : 1.2);
    }
    EXPECT_EQ(here, 1) << seen.colour << " at " << seen.x_px << ", " << seen.y_px;
  }
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "drawn/smarties.png"));
}

/// A picture of three discs, and marks for two of their colours.
std::string draw_discs(const TestFolder& scratch) {
  cv::Mat picture(120, 200, CV_8UC3, cv::Scalar(210, 205, 200));
  cv::circle(picture, {40, 60}, 25, {40, 60, 220}, cv::FILLED, cv::LINE_AA);
  cv::circle(picture, {100, 60}, 25, {40, 190, 50}, cv::FILLED, cv::LINE_AA);
  cv::circle(picture, {160, 60}, 25, {200, 60, 190}, cv::FILLED, cv::LINE_AA);
  const std::string file = (scratch.path() / "discs.png").string();
  cv::imwrite(file, picture);
  return file;
}

constexpr const char* kDiscMarks = R"({"marks": [
  {"picture": "discs.png", "colour": "red", "circle_px": [40, 60, 20]},
  {"picture": "discs.png", "colour": "green", "box_px": [90, 50, 20, 20]}]})";

TEST(LearnPalette, FindsWhatWasMarkedAndNothingElse) {
  const TestFolder scratch;
  const std::string picture = draw_discs(scratch);
  const std::string marks = scratch.write("marks.json", kDiscMarks);
  const std::string palette = (scratch.path() / "palette.json").string();
  const Outcome learned = run_stereobench({"learn-palette", marks, "-o", palette, "--encoding", "srgb"});
  ASSERT_EQ(learned.exit_code, 0) << learned.err;
  EXPECT_THAT(learned.out, HasSubstr("red"));
  EXPECT_EQ(read_palette(palette).encoding, worlds::Encoding::kSrgb);
  const Outcome found = run_stereobench({"detect", picture, "--palette", palette});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const auto balls = nlohmann::json::parse(found.out)["balls"];
  ASSERT_EQ(balls.size(), 2U);
  for (const auto& ball : balls)
    EXPECT_NEAR(ball["left_px"][0].get<double>(), ball["name"] == "red" ? 40.0 : 100.0, 0.2);
  EXPECT_EQ(run_stereobench({"detect", picture, "--palette", palette, "--encoding", "linear"}).exit_code, 2);
}

// JPEGs are sRGB, and what learned from them says so; both at once are refused. Mutation: the first picture's
// alone looked at.
TEST(LearnPalette, FindsTheEncodingInTheFiles) {
  const TestFolder scratch;
  const std::string png = draw_discs(scratch);
  cv::imwrite((scratch.path() / "discs.jpg").string(), cv::imread(png), {cv::IMWRITE_JPEG_QUALITY, 95});
  std::string text = kDiscMarks;
  const auto replace = [&](std::size_t from) { text.replace(text.find("discs.png", from), 9, "discs.jpg"); };
  const std::string palette = (scratch.path() / "palette.json").string();
  replace(text.rfind("{\"picture\""));
  const Outcome both = run_stereobench({"learn-palette", scratch.write("marks.json", text), "-o", palette});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("contradict each other"));
  replace(0);
  const Outcome learned =
      run_stereobench({"learn-palette", scratch.write("marks.json", text), "-o", palette});
  ASSERT_EQ(learned.exit_code, 0) << learned.err;
  EXPECT_THAT(learned.out, HasSubstr("levels are taken for sRGB"));
  EXPECT_EQ(read_palette(palette).encoding, worlds::Encoding::kSrgb);
  const Outcome found =
      run_stereobench({"detect", (scratch.path() / "discs.jpg").string(), "--palette", palette});
  EXPECT_EQ(nlohmann::json::parse(found.out)["balls"].size(), 2U);
}

TEST(LearnPalette, WarnsOfColoursThatAreTakenForEachOther) {
  const TestFolder scratch;
  draw_discs(scratch);
  const std::string marks = scratch.write("marks.json", R"({"marks": [
    {"picture": "discs.png", "colour": "red", "circle_px": [33, 60, 10]},
    {"picture": "discs.png", "colour": "crimson", "circle_px": [50, 60, 10]}]})");
  const Outcome learned =
      run_stereobench({"learn-palette", marks, "-o", (scratch.path() / "palette.json").string()});
  EXPECT_EQ(learned.exit_code, 0) << learned.err;
  EXPECT_THAT(learned.out, HasSubstr("red may be taken for crimson"));
}

// Every odd input is one line and exit 2, and leaves no palette.
TEST(LearnPalette, RefusesMarksThatAreNotRight) {
  const TestFolder scratch;
  draw_discs(scratch);
  const auto complaint = [&](const std::string& marks) {
    const std::string file = scratch.write("odd.json", marks);
    const Outcome outcome =
        run_stereobench({"learn-palette", file, "-o", (scratch.path() / "p.json").string()});
    EXPECT_EQ(outcome.exit_code, 2) << marks;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "p.json"));
    return outcome.err;
  };
  const auto mark = [](const std::string& inside) { return "{\"marks\": [{" + inside + "}]}"; };
  const std::string red = R"("picture": "discs.png", "colour": "red", )";
  EXPECT_THAT(complaint(""), HasSubstr("odd.json: expected a line of JSON"));
  EXPECT_THAT(complaint("{\"marks\": []}"), HasSubstr("marks: expected a list"));
  EXPECT_THAT(complaint(mark(red + "\"circle_px\": [1, 2]")),
              HasSubstr("marks[0].circle_px: expected a list"));
  EXPECT_THAT(complaint(mark(red + "\"circle_px\": [1, 2, -3]")),
              HasSubstr("circle_px[2]: expected a number"));
  EXPECT_THAT(complaint(mark(R"("picture": "discs.png", "colour": "red")")),
              HasSubstr("either circle_px or box_px"));
  EXPECT_THAT(complaint(mark(red + "\"circle_px\": [900, 900, 9]")),
              HasSubstr("holds no pixel of discs.png"));
  EXPECT_THAT(complaint(mark(red + "\"circle_px\": [100, 8, 3]")),
              HasSubstr("red: the samples have no colour"));
  EXPECT_THAT(complaint(mark(red + "\"box_px\": [40, 60, 1, 1]")), HasSubstr("at least 20 pixels"));
  EXPECT_THAT(complaint(mark(R"("picture": "no.png", "colour": "red", "box_px": [0, 0, 9, 9])")),
              HasSubstr("no.png: no such file"));
}

// Mutation: names that are there twice.
TEST(PaletteFile, RefusesWhatIsNone) {
  const TestFolder scratch;
  vision::LearnedColour red{"red", {0.9, 0.05}, 4e-4 * Eigen::Matrix2d::Identity(), 60.0, {10, 5, 220}};
  const std::string good = palette_json({{red}});
  const auto complaint = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return complaint_of([&] { parse_palette(text, "palette.json"); });
  };
  EXPECT_EQ(complaint("", ""), "no complaint");
  EXPECT_THAT(complaint("\"red\"", "\"\""), HasSubstr("name: expected a name"));
  EXPECT_THAT(complaint("0.9", "1.9"), HasSubstr("chromaticity_rg[0]: expected a number"));
  EXPECT_THAT(complaint("0.0004", "-0.4"), HasSubstr("covariance: expected a symmetric, positive matrix"));
  EXPECT_THAT(complaint("\"version\": 2", "\"version\": 3"), HasSubstr("version: expected"));
  EXPECT_EQ(complaint("\"version\": 2", "\"version\": 1"), "no complaint") << "of light, as they were";
  std::string old = palette_json({{red}, worlds::Encoding::kSrgb});
  old.replace(old.find("\"version\": 2"), 12, "\"version\": 1");
  EXPECT_THAT([&] { parse_palette(old, "palette.json"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("learn them again")));
  EXPECT_THAT(complaint("linear", "log"), HasSubstr("encoding: expected"));
  EXPECT_THAT(palette_json({{red, red}}), HasSubstr("red"));
  EXPECT_THROW(parse_palette(palette_json({{red, red}}), "palette.json"), std::runtime_error);
}

}  // namespace
}  // namespace stereobench::harness
