#include "harness/dataset/rendered_dataset.h"

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "harness/io/calibration_file.h"
#include "harness/io/file_list.h"
#include "slam/math/random.h"
#include "tests/harness/logs/log_folder.h"
#include "vision/camera/rig.h"
#include "vision/palette.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const vision::StereoRig kRig{{320, 240, 300.0, 150.0, 125.0}, 0.12, 0.5, 0.3};

cv::Mat matrix_of(const vision::StereoRig& rig, const std::string& key) {
  const cv::FileStorage file(calibration_yaml(rig), cv::FileStorage::READ | cv::FileStorage::MEMORY);
  return file[key].mat();
}

Eigen::Vector2d projected(const cv::Mat& projection, const Eigen::Vector3d& point) {
  const cv::Mat pixel = projection * cv::Mat(cv::Vec4d(point.x(), point.y(), point.z(), 1.0));
  return Eigen::Vector2d(pixel.at<double>(0), pixel.at<double>(1)) / pixel.at<double>(2);
}

// Property: P1 and P2 take points of the left camera's frame to the pixels at which the rig's cameras have
// them. Mutations: P2[3] = +f B, a P2 that knows of no turn.
class Calibration : public testing::TestWithParam<double> {};

TEST_P(Calibration, ProjectsWhereTheCamerasOfTheRigDo) {
  vision::StereoRig rig = kRig;
  rig.right_turn_rad = GetParam() * Eigen::Vector3d(0.01, -0.02, 0.03);
  const cv::Mat p1 = matrix_of(rig, "P1");
  const cv::Mat p2 = matrix_of(rig, "P2");
  slam::RandomStream random(4, slam::Stream::kWorld);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d point(random.normal(), random.normal(), 1.0 + 4.0 * random.uniform());
    const Eigen::Vector2d left = vision::project(rig.intrinsics, point);
    const Eigen::Vector2d right =
        vision::project(rig.intrinsics, vision::camera_point(rig, point, vision::Side::kRight));
    EXPECT_LT((projected(p1, point) - left).norm(), 1e-9);
    EXPECT_LT((projected(p2, point) - right).norm(), 1e-9);
  }
  EXPECT_LT(p2.at<double>(0, 3), 0.0);  // as OpenCV has it: -f B
}
INSTANTIATE_TEST_SUITE_P(Turns, Calibration, testing::Values(0.0, 1.0));

// Mutation: the left camera twice.
TEST(CalibrationFile, HasTheCamerasABaselineApart) {
  const cv::Mat left = matrix_of(kRig, "robot_from_left_camera");
  const cv::Mat right = matrix_of(kRig, "robot_from_right_camera");
  EXPECT_NEAR(left.at<double>(1, 3) - right.at<double>(1, 3), kRig.baseline_m, 1e-12);  // y is left
  EXPECT_NEAR(left.at<double>(2, 3), kRig.height_m, 1e-12);
  EXPECT_EQ(cv::norm(matrix_of(kRig, "D")), 0.0);
  EXPECT_EQ(matrix_of(kRig, "K").size(), cv::Size(3, 3));
}

// Mutation: blue, green, red.
TEST(BallsCsv, NamesEachBallByItsPlaceInTheWorld) {
  worlds::World world;
  world.balls = {{{1.5, -2.0, 0.3}, 0.05, 4}, {{0.1, 0.2, 0.25}, 0.125, 0}};
  const auto rgb = vision::kPalette[4];
  EXPECT_THAT(balls_csv(world), HasSubstr("\n0,4," + std::to_string(rgb.r) + "," + std::to_string(rgb.g) +
                                          "," + std::to_string(rgb.b) + ",1.5,-2,0.3,0.05\n1,0,"));
  EXPECT_THAT(balls_csv(world), testing::EndsWith(",0.1,0.2,0.25,0.125\n"));
}

const nlohmann::ordered_json kOne = {{"seed", 1}};
const MeasurementLog kOneStep{.start = {}, .steps = {{.truth = slam::Pose{}}}, .landmarks = {}};

/// A look at a picture of one grey level.
void write_look(const RenderedDataset& dataset, std::size_t step, int level) {
  const renderer::RenderedImage image{cv::Mat(4, 6, CV_8UC3, cv::Scalar::all(level)),
                                      cv::Mat(4, 6, CV_8UC1, level),
                                      cv::Mat(4, 6, CV_32FC1, cv::Scalar(level))};
  dataset.write({.step = step,
                 .frame = {image, image},
                 .pair = {image.colour, image.colour},
                 .observations = {},
                 .match = {}});
}

// Mutation: writing frames over again.
TEST(RenderedDataset, TakesUpWhatWasInterruptedAndLeavesItsFramesAlone) {
  const TestFolder folder;
  write_look(RenderedDataset(folder.path(), kOne), 0, 10);
  const std::string left = folder.read("left/000000.png");
  const std::string depth = folder.read("right_depth/000000.pfm");
  ASSERT_FALSE(left.empty());
  std::filesystem::remove(folder.path() / "right_depth/000000.pfm");
  const RenderedDataset again(folder.path(), kOne);
  write_look(again, 0, 20);  // another picture, to see which one is kept
  EXPECT_EQ(folder.read("left/000000.png"), left);
  EXPECT_NE(folder.read("right_depth/000000.pfm"), depth);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "dataset.json"));
  again.finish({}, kRig, kRig, kOneStep, {});
  EXPECT_EQ(nlohmann::json::parse(folder.read("dataset.json"))["seed"], 1);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "dataset.unfinished.json"));
}

// Law: whatever file loses a part, all of it, or a bit, it is found, made again, and all others stay.
// Mutations: sizes alone compared; files that are missing not looked for; frames alone listed.
TEST(RenderedDataset, FindsWhatIsNotAsItWasWritten) {
  const TestFolder folder;
  const auto finish = [&](const RenderedDataset& dataset) {
    for (const std::size_t step : {0U, 1U}) write_look(dataset, step, 10 + static_cast<int>(step));
    dataset.finish({}, kRig, kRig, kOneStep, {});
  };
  finish(RenderedDataset(folder.path(), kOne));
  const std::string marker = folder.read("dataset.json");
  const auto names = product_names(folder.path());
  EXPECT_GE(names.size(), 17U);
  EXPECT_TRUE(RenderedDataset(folder.path(), kOne).spoilt().empty());
  for (const std::string& name : names) {
    const std::string bytes = folder.read(name);
    std::string flipped = bytes;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    for (const std::string& spoilt : {bytes.substr(0, bytes.size() / 2), flipped, std::string()}) {
      folder.write(name, spoilt);
      if (spoilt.empty()) std::filesystem::remove(folder.path() / name);
      const RenderedDataset again(folder.path(), kOne);
      EXPECT_EQ(again.spoilt(), std::vector<std::string>{name});
      EXPECT_FALSE(std::filesystem::exists(folder.path() / "dataset.json"));
      finish(again);
      EXPECT_EQ(folder.read(name), bytes) << name;
      EXPECT_EQ(folder.read("dataset.json"), marker) << name;
    }
  }
}

// Whoever lists a file of somebody else's removes it. Mutation: names not looked at.
TEST(RenderedDataset, ListsAndRemovesItsOwnFilesAlone) {
  const TestFolder folder;
  const RenderedDataset dataset(folder.path(), kOne);
  write_look(dataset, 0, 10);
  folder.write("notes.csv", "mine");
  folder.write("left/notes.txt", "mine");
  dataset.finish({}, kRig, kRig, kOneStep, {});
  EXPECT_THAT(folder.read("dataset.json"), testing::Not(HasSubstr("notes")));
  auto marker = nlohmann::json::parse(folder.read("dataset.json"));
  marker["files"]["../victim"] = {{"bytes", 1}, {"sha256", ""}};
  folder.write("dataset.json", marker.dump());
  EXPECT_THAT([&] { RenderedDataset(folder.path(), kOne); },
              ThrowsMessage<std::runtime_error>(HasSubstr("files.../victim: expected the name of a file")));
}

// Mutations: no check of the identity; none while the data set is unfinished.
TEST(RenderedDataset, RefusesAFolderOfAnotherIdentityFinishedOrNot) {
  const TestFolder folder;
  const RenderedDataset dataset(folder.path(), kOne);
  write_look(dataset, 0, 10);
  const auto take_up = [&] { RenderedDataset(folder.path(), {{"seed", 2}}); };
  EXPECT_THAT(take_up, ThrowsMessage<std::runtime_error>(HasSubstr("a data set of another seed; choose")));
  dataset.finish({}, kRig, kRig, kOneStep, {});
  EXPECT_THAT(take_up, ThrowsMessage<std::runtime_error>(HasSubstr("holds a data set of another")));
}

// What failed before its first frame is in nobody's way. Mutations: the marker written at once, or looked at
// where nothing else is.
TEST(RenderedDataset, LeavesNothingBeforeItsFirstFrame) {
  const TestFolder folder;
  const auto place = folder.path() / "data";
  { const RenderedDataset begun(place, kOne); }
  EXPECT_FALSE(std::filesystem::exists(place));
  write_look(RenderedDataset(place, kOne), 0, 10);
  const auto take_up = [&] { RenderedDataset(place, {{"seed", 2}}); };
  EXPECT_THAT(take_up, testing::Throws<std::runtime_error>());
  for (const std::string& name : product_names(place)) std::filesystem::remove(place / name);
  take_up();
  write_look(RenderedDataset(place, {{"seed", 2}}), 0, 10);
  EXPECT_THAT([&] { RenderedDataset(place, kOne); }, testing::Throws<std::runtime_error>());
}

}  // namespace
}  // namespace stereobench::harness
