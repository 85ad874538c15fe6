/// `stereobench detect` on pictures from anywhere, and `slam --detections` on what it and others write.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A short data set, rendered once for all tests of this file.
class Dataset : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TestFolder>();
    const Outcome outcome = run_stereobench({"render", scenario_path("ball_circle"), "--set", "path.laps=0.1",
                                             "--set", "shutter.drop_probability=0.2", "--set",
                                             "believed_rig={baseline_m: 0.1205, pitch_down_deg: 0.2}",
                                             "--set", "gates=[]", "--seed", "2", "--out", data()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_EQ(run_stereobench({"detect", data(), "--out", detections()}).exit_code, 0);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::string data() { return (folder_->path() / "data").string(); }
  static std::string detections() { return (folder_->path() / "ours.jsonl").string(); }
  static std::vector<std::string> lines() {
    std::ifstream file(detections());
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }
  static std::string first_left() {
    return data() + "/left/" + nlohmann::json::parse(lines().at(0))["left"].get<std::string>();
  }
  static Outcome slam(const TestFolder& scratch, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "slam", data(), "--seeds", "0", "--particles", "10", "--out", (scratch.path() / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_stereobench(arguments);
  }
  static std::unique_ptr<TestFolder> folder_;
};
std::unique_ptr<TestFolder> Dataset::folder_;

nlohmann::json result_in(const TestFolder& scratch) {
  return nlohmann::json::parse(bytes_of(scratch.path() / "out/run.json"));
}

// Law: what our detector finds in a data set's pictures, put in by hand, gives the filters what the run that
// rendered them gave, and vision the score of that run. Mutations: frames counted in place of named; the
// believed rig for the true one in the score.
TEST_F(Dataset, DetectionsOfOursGiveTheScoresOfTheRun) {
  const TestFolder scratch;
  ASSERT_EQ(slam(scratch, {}).exit_code, 0);
  const auto recorded = result_in(scratch);
  const Outcome outcome = slam(scratch, {"--detections", detections()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto detected = result_in(scratch);
  EXPECT_EQ(detected["detector"], "file");
  for (const char* filter : {"dead_reckoning", "fastslam2_iterated", "ufastslam_iterated"})
    for (const char* metric : {"ate_rms_m", "heading_rms_rad", "landmark_rms_m", "anees"})
      EXPECT_EQ(detected["filters"][filter][metric], recorded["filters"][filter][metric]) << filter << metric;
  EXPECT_GT(detected["filters"]["ufastslam_iterated"]["association"]["correct"].get<int>(), 5);

  const TestFolder run;
  ASSERT_EQ(
      run_stereobench({"run", scenario_path("ball_circle"), "--set", "path.laps=0.1", "--set",
                       "shutter.drop_probability=0.2", "--set",
                       "believed_rig={baseline_m: 0.1205, pitch_down_deg: 0.2}", "--set", "gates=[]",
                       "--seeds", "2", "--filters", "dead_reckoning", "--out", (run.path() / "out").string()})
          .exit_code,
      0);
  const auto vision = result_in(run)["vision"];
  const auto of_detections = detected["vision"].flatten();
  const auto of_run = vision.flatten();
  for (const auto& [key, value] : of_run.items())
    EXPECT_NEAR(of_detections[key].get<double>(), value.get<double>(), 1e-9) << key;
  EXPECT_GT(vision["found"].get<int>(), 5);
}

// A file without the balls of one frame, beside the whole one: `compare` says which balls are gone.
// Mutations: detections of a file that are not kept; the command of a replay that cannot be.
TEST_F(Dataset, DetectionsOfTwoFilesAreCompared) {
  const TestFolder whole, poorer;
  ASSERT_EQ(slam(whole, {"--detections", detections()}).exit_code, 0);
  std::vector<std::string> changed = lines();
  auto line = nlohmann::json::parse(changed[1]);
  line["balls"] = nlohmann::json::array();
  changed[1] = line.dump();
  std::string text;
  for (const std::string& one : changed) text += one + "\n";
  ASSERT_EQ(slam(poorer, {"--detections", poorer.write("poorer.jsonl", text)}).exit_code, 0);
  const Outcome compared =
      run_stereobench({"compare", (whole.path() / "out").string(), (poorer.path() / "out").string()});
  EXPECT_THAT(compared.out,
              AllOf(ContainsRegex("A alone found [1-9] and B alone 0"), HasSubstr("vision.recall"),
                    Not(HasSubstr("stereobench replay"))));  // there is no scenario
}

TEST_F(Dataset, HowLandmarksAreToldApartCanBeChosen) {
  const TestFolder scratch;
  for (const auto& [identity, code] :
       {std::pair{"none", 0}, {"colour_class", 0}, {"known", 0}, {"guessed", 2}})
    EXPECT_EQ(slam(scratch, {"--detections", detections(), "--identity", identity}).exit_code, code)
        << identity;
  EXPECT_EQ(slam(scratch, {"--identity", "none"}).exit_code, 2);
}

// Mutation: lines beyond the last frame are passed over.
TEST_F(Dataset, FilesOfDetectionsThatAreNotRightAreBadInput) {
  const TestFolder scratch;
  const std::vector<std::string> good = lines();
  ASSERT_GT(good.size(), 2U);
  const auto complaint = [&](const std::vector<std::string>& changed) {
    std::string text;
    for (const std::string& line : changed) text += line + "\n";
    const Outcome outcome = slam(scratch, {"--detections", scratch.write("bad.jsonl", text)});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  };
  const std::string next = std::to_string(good.size() + 1);
  EXPECT_THAT(complaint({}), HasSubstr("bad.jsonl:1: expected the line of frame"));
  auto changed = good;
  changed.pop_back();
  EXPECT_THAT(complaint(changed), HasSubstr("expected the line of frame"));
  changed = good;
  changed.push_back(good.back());
  EXPECT_THAT(complaint(changed), HasSubstr("bad.jsonl:" + next + ": expected no more lines"));
  changed = good;
  std::swap(changed[0], changed[1]);
  EXPECT_THAT(complaint(changed), HasSubstr("bad.jsonl:1: frame: expected"));
  changed = good;
  changed[1] = "rubbish";
  EXPECT_THAT(complaint(changed), HasSubstr("bad.jsonl:2: expected a line of JSON (got 'rubbish')"));
  EXPECT_THAT(slam(scratch, {"--detections", "/nowhere.jsonl"}).err,
              HasSubstr("/nowhere.jsonl: no such file"));
  std::filesystem::create_directory(scratch.path() / "log");
  scratch.write("log/odometry.csv", "t_s,v_mps,w_radps\n0,1,0\n1,1,0\n");
  scratch.write("log/observations.csv", "t_s,landmark_id,range_m,bearing_rad\n0.5,1,2,0.1\n");
  const Outcome no_pictures =
      run_stereobench({"slam", (scratch.path() / "log").string(), "--detections", detections()});
  EXPECT_EQ(no_pictures.exit_code, 2);
  EXPECT_THAT(no_pictures.err, HasSubstr("expected a whole data set"));
}

// A pair, the same alone, and with its picture drawn.
// A turn of 1.2 degrees about x moves rows by 19 px. Mutations: the scenario's rows not told to vision, not
// kept in dataset.json, or not read there; the option not looked at.
TEST(DetectRows, AreThoseOfTheDataSetOrOfTheCommandLine) {
  const TestFolder scratch;
  const std::string data = (scratch.path() / "data").string();
  const Outcome rendered = run_stereobench({"render", scenario_path("ball_circle"), "--set", "path.laps=0.04",
                                            "--set", "rig.right_turn_deg=[1.2,0,0]", "--set",
                                            "believed_rig={right_turn_deg: [0, 0, 0], rows_within_px: 25}",
                                            "--set", "gates=[]", "--out", data});
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  const auto found = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"detect", data};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_stereobench(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    std::size_t balls = 0;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) balls += nlohmann::json::parse(line)["balls"].size();
    return balls;
  };
  const std::string trusted = bytes_of(scratch.path() / "data/observations.csv");
  EXPECT_GT(std::count(trusted.begin(), trusted.end(), '\n'), 3);
  EXPECT_GE(found({}), 3U);
  EXPECT_EQ(found({"--rows-within-px", "12"}), 0U);
  const Outcome refused = run_stereobench({"detect", data, "--rows-within-px", "400"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--rows-within-px: expected at most half a picture, 384 (got 400)"));
}

TEST_F(Dataset, OnePictureIsMeasuredAsInItsPair) {
  const TestFolder scratch;
  const std::string left = first_left();
  const Outcome one = run_stereobench(
      {"detect", left, "--rig", data() + "/calibration.yaml", "--draw", scratch.path().string()});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  const auto alone = nlohmann::json::parse(one.out)["balls"];
  const auto both = nlohmann::json::parse(lines().at(0))["balls"];
  ASSERT_GT(both.size(), 0U);
  for (const auto& ball : both) {
    const bool is_there = std::any_of(alone.begin(), alone.end(), [&](const auto& other) {
      return other["colour"] == ball["colour"] && other["left_px"] == ball["left_px"] &&
             other["left_radius_px"] == ball["left_radius_px"];
    });
    EXPECT_TRUE(is_there) << ball;
  }
  const cv::Mat drawn = cv::imread((scratch.path() / std::filesystem::path(left).filename()).string());
  EXPECT_EQ(drawn.size(), cv::Size(1024, 768));
  EXPECT_GT(cv::norm(drawn, cv::imread(left), cv::NORM_L1), 1e5);
}

// Mutation: 16 bits cut off at 255.
TEST_F(Dataset, SixteenBitsAndTransparencyChangeNothing) {
  const TestFolder scratch;
  const cv::Mat picture = cv::imread(first_left());
  cv::Mat deep, clear;
  picture.convertTo(deep, CV_16U, 257.0);
  cv::cvtColor(picture, clear, cv::COLOR_BGR2BGRA);
  const auto found_in = [&](const cv::Mat& as) {
    const std::string file = (scratch.path() / "picture.png").string();
    cv::imwrite(file, as);
    return run_stereobench({"detect", file}).out;
  };
  const std::string plain = found_in(picture);
  EXPECT_THAT(plain, HasSubstr("\"colour\":"));
  EXPECT_EQ(found_in(deep), plain);
  EXPECT_EQ(found_in(clear), plain);
  EXPECT_THAT(found_in(cv::Mat(1, 1, CV_8UC3, cv::Scalar(0, 0, 200))), HasSubstr("\"balls\":[]"));
}

struct OddCall {
  std::string kind;
  std::vector<std::string> arguments;  ///< {data} and {odd} stand for folders
  std::string message;
};

// Every odd input is one line and exit 2. Mutations: a truncated picture taken for a whole one (JPEG),
// libpng's own line let through.
TEST_F(Dataset, OddInputsAreOneLine) {
  const TestFolder odd;
  const std::string png = bytes_of(first_left());
  odd.write("empty.png", "");
  odd.write("text.png", "no picture");
  odd.write("truncated.png", png.substr(0, png.size() / 2));
  odd.write("header.png", png.substr(0, 40));
  const cv::Mat picture = cv::imread(first_left());
  cv::imwrite((odd.path() / "whole.jpg").string(), picture);
  const std::string jpeg = bytes_of(odd.path() / "whole.jpg");
  odd.write("truncated.jpg", jpeg.substr(0, jpeg.size() / 2));
  cv::imwrite((odd.path() / "grey.png").string(), cv::Mat(768, 1024, CV_8U, cv::Scalar(7)));
  cv::imwrite((odd.path() / "tiny.png").string(), cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(7)));
  odd.write("empty.yaml", "");
  odd.write("text.yaml", "hello");
  std::string nan = bytes_of(data() + "/calibration.yaml");
  nan.replace(nan.find("baseline_m: "), 12, "baseline_m: .Nan #");
  odd.write("nan.yaml", nan);
  odd.write("part.yaml", "%YAML:1.0\n---\nimage_width: 4\nimage_height: 4\n");
  std::filesystem::create_directory(odd.path() / "nothing");
  const std::string rig = data() + "/calibration.yaml";
  const std::string place = odd.path().string() + "/";
  const OddCall calls[] = {
      {"NoPicture", {}, "expected LEFT"},
      {"Missing", {place + "none.png"}, "none.png: no such file"},
      {"Empty", {place + "empty.png"}, "empty.png: is empty"},
      {"Text", {place + "text.png"}, "is no picture that can be read (PNG, JPEG, TIFF, BMP, PNM, TGA)"},
      {"Truncated", {place + "truncated.png"}, "is no whole picture"},
      {"HeaderAlone", {place + "header.png"}, "is no whole picture"},
      {"TruncatedJpeg", {place + "truncated.jpg"}, "is no whole picture"},
      {"Grey", {place + "grey.png"}, "has no colour"},
      {"TinyForTheRig", {place + "tiny.png", "--rig", rig}, "1 x 1 pixels, the rig's have 1024 x 768"},
      {"PairWithoutRig", {first_left(), first_left()}, "--rig: two cameras need"},
      {"PairOfTwoSizes", {first_left(), place + "tiny.png", "--rig", rig}, "tiny.png: 1 x 1 pixels"},
      {"ThreePictures", {first_left(), first_left(), first_left()}, "pictures"},
      {"EmptyFolder", {place + "nothing"}, "holds no picture"},
      {"MissingRig", {first_left(), "--rig", place + "none.yaml"}, "none.yaml: no such file"},
      {"EmptyRig", {first_left(), "--rig", place + "empty.yaml"}, "empty.yaml: expected a calibration"},
      {"TextForARig", {first_left(), "--rig", place + "text.yaml"}, "text.yaml: "},
      {"FolderForARig", {first_left(), "--rig", place + "nothing"}, "expected a file (got a folder)"},
      {"PartOfARig", {first_left(), "--rig", place + "part.yaml"}, "part.yaml: K: this key is missing"},
      {"NotANumberInARig", {first_left(), "--rig", place + "nan.yaml"}, "nan.yaml: expected finite numbers"},
      {"MissingPalette", {first_left(), "--palette", place + "none.json"}, "none.json: no such file"},
      {"TextForAPalette", {first_left(), "--palette", place + "text.yaml"}, "text.yaml: expected a line"},
      {"NegativeRadius", {first_left(), "--ball-radius-m", "-1"}, "--ball-radius-m"},
      {"OutInAMissingFolder", {first_left(), "--out", place + "no/where.jsonl"}, "no/where.jsonl"},
  };
  for (const OddCall& call : calls) {
    std::vector<std::string> arguments = {"detect"};
    arguments.insert(arguments.end(), call.arguments.begin(), call.arguments.end());
    const Outcome outcome = run_stereobench(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << call.kind << outcome.out;
    EXPECT_THAT(outcome.err, HasSubstr(call.message)) << call.kind;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1)
        << call.kind << ": " << outcome.err;
  }
}

// Mutation: not looked for.
TEST_F(Dataset, SwappedPicturesAreSaidToBe) {
  const std::string right =
      data() + "/right/" + nlohmann::json::parse(lines().at(0))["right"].get<std::string>();
  ASSERT_GE(nlohmann::json::parse(lines().at(0))["balls"].size(), 2U);
  const Outcome outcome = run_stereobench(
      {"detect", right, first_left(), "--rig", data() + "/calibration.yaml", "--ball-radius-m", "0.06"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("left and right are swapped"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
}

// A ball that fills half the picture is measured; one that is cut in half as well is found as cut, or not.
TEST_F(Dataset, ABallMayFillHalfThePicture) {
  const TestFolder scratch;
  for (const int centre : {512, 0}) {
    cv::Mat picture(768, 1024, CV_8UC3, cv::Scalar(140, 140, 140));
    cv::circle(picture, {centre, 384}, 354, {0, 0, 229}, cv::FILLED, cv::LINE_AA);
    const std::string file = (scratch.path() / "large.png").string();
    cv::imwrite(file, picture);
    const Outcome one = run_stereobench({"detect", file});
    ASSERT_EQ(one.exit_code, 0) << one.err;
    const auto balls = nlohmann::json::parse(one.out)["balls"];
    EXPECT_TRUE(balls.size() == 1 || (centre == 0 && balls.empty())) << balls;
    for (const auto& ball : balls) {
      EXPECT_EQ(ball.contains("truncated"), centre == 0);
      EXPECT_NEAR(ball["left_px"][0].get<double>(), centre, 1.0);
      EXPECT_NEAR(ball["left_radius_px"].get<double>(), 354.0, 1.0);
    }
    EXPECT_EQ(run_stereobench({"detect", file, file, "--rig", data() + "/calibration.yaml"}).exit_code, 0);
  }
}

TEST_F(Dataset, AFolderOfPicturesIsLookedAtInOrderOfNames) {
  const Outcome outcome = run_stereobench({"detect", data() + "/right"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(static_cast<std::size_t>(std::count(outcome.out.begin(), outcome.out.end(), '\n')),
            lines().size());
  EXPECT_EQ(nlohmann::json::parse(outcome.out.substr(0, outcome.out.find('\n')))["frame"],
            nlohmann::json::parse(lines().at(0))["frame"]);
}

}  // namespace
}  // namespace stereobench::harness
