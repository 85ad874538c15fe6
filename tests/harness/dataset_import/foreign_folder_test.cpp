/// Folders that other people's programs wrote.
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "harness/io/picture_file.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/dataset_import/painted_euroc.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Outcome import_from(const TestFolder& folder, const TestFolder& scratch,
                    const std::vector<std::string>& more = {}) {
  return run_stereobench(
      with({"import", folder.path().string(), "--out", (scratch.path() / "in").string()}, more));
}

std::vector<std::string> lines_of_text(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A robot between the cameras of the painted set: its rows along the baseline, looking as both cameras do.
Eigen::Isometry3d robot_of(const PaintedEuroc& set, std::int64_t stamp_ns) {
  const Eigen::Isometry3d body = PaintedEuroc::world_from_body(stamp_ns);
  const Eigen::Isometry3d left = body * set.cameras[0].body_from_camera;
  const Eigen::Isometry3d right = body * set.cameras[1].body_from_camera;
  const Eigen::Vector3d to_left = (left.translation() - right.translation()).normalized();
  const Eigen::Vector3d looks = left.linear().col(2) + right.linear().col(2);
  Eigen::Isometry3d robot = Eigen::Isometry3d::Identity();
  robot.linear().col(0) = (looks - looks.dot(to_left) * to_left).normalized();
  robot.linear().col(1) = to_left;
  robot.linear().col(2) = robot.linear().col(0).cross(to_left);
  robot.translation() = 0.5 * (left.translation() + right.translation());
  return robot;
}

class ForeignEuroc : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TestFolder>();
    PaintedEuroc().write(*folder_);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::unique_ptr<TestFolder> folder_;
};
std::unique_ptr<TestFolder> ForeignEuroc::folder_;

// Law: where the balls are, painted by hand through two lenses, is where `detect` finds them from the robot
// between the cameras. Mutation: the lens left out.
TEST_F(ForeignEuroc, BallsAreFoundWhereTheyWerePainted) {
  const PaintedEuroc set;
  const TestFolder scratch;
  const Outcome imported = import_from(*folder_, scratch);
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("3 pairs (1 frames left out)"));
  EXPECT_THAT(imported.out, HasSubstr("two different cameras, which `detect` rectifies"));
  const Outcome found = run_stereobench({"detect", (scratch.path() / "in").string(), "--ball-radius-m",
                                         "0.08", "--ball-radius-sd-m", "0.0001"});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const auto lines = lines_of_text(found.out);
  ASSERT_EQ(lines.size(), 3U);
  for (int frame = 0; frame < 3; ++frame) {
    const auto balls = nlohmann::json::parse(lines[static_cast<std::size_t>(frame)])["balls"];
    ASSERT_EQ(balls.size(), set.balls.size()) << lines[static_cast<std::size_t>(frame)];
    const Eigen::Isometry3d robot = robot_of(set, PaintedEuroc::stamp_ns(frame));
    for (const PaintedBall& ball : set.balls) {
      const Eigen::Vector3d place_m = robot.inverse() * ball.centre_m;
      const auto& seen = balls[0]["colour"] == ball.colour ? balls[0] : balls[1];
      EXPECT_EQ(seen["colour"], ball.colour);
      EXPECT_NEAR(seen["range_m"].get<double>(), place_m.head<2>().norm(), 0.004) << frame;
      EXPECT_NEAR(seen["bearing_rad"].get<double>(), std::atan2(place_m.y(), place_m.x()), 0.0003) << frame;
    }
  }
}

// The first picture was taken before the truth begins. Mutation: the robot at the left camera.
TEST_F(ForeignEuroc, TruthIsThatOfTheRobotBetweenTheCameras) {
  const PaintedEuroc set;
  const TestFolder scratch;
  const Outcome imported = import_from(*folder_, scratch, {"--odometry-from-truth"});
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("2 pairs (2 frames left out)"));
  const auto lines = lines_of_text(scratch.read("in/groundtruth.csv"));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1].substr(0, 21), "1403636579.813555584,");
  for (int frame = 1; frame < 3; ++frame) {
    double time_s = 0.0, x_m = 0.0, y_m = 0.0, theta_rad = 0.0;
    ASSERT_EQ(std::sscanf(lines[static_cast<std::size_t>(frame)].c_str(), "%lf,%lf,%lf,%lf", &time_s, &x_m,
                          &y_m, &theta_rad),
              4);
    const Eigen::Isometry3d robot = robot_of(set, PaintedEuroc::stamp_ns(frame));
    EXPECT_NEAR(x_m, robot.translation().x(), 1e-9);
    EXPECT_NEAR(y_m, robot.translation().y(), 1e-9);
    EXPECT_NEAR(theta_rad, std::atan2(robot(1, 0), robot(0, 0)), 1e-5);
  }
  EXPECT_THAT(scratch.read("in/pictures.csv"),
              HasSubstr("\n0,1403636579.813555584,mav0/cam0/data/1403636579813555584.png,mav0/cam1/data/"));
  const Outcome slam = run_stereobench({"slam", (scratch.path() / "in").string(), "--filters", "ekf", "--out",
                                        (scratch.path() / "out").string()});
  EXPECT_EQ(slam.exit_code, 0) << slam.err;
}

// Mutation: the model of a lens is not looked at.
TEST_F(ForeignEuroc, OtherModelsAreRefused) {
  const TestFolder copy, scratch;
  fs::copy(folder_->path(), copy.path(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  std::string sensor = copy.read("mav0/cam1/sensor.yaml");
  sensor.replace(sensor.find("radial-tangential"), 17, "equidistant");
  copy.write("mav0/cam1/sensor.yaml", sensor);
  const Outcome refused = import_from(copy, scratch);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("mav0/cam1/sensor.yaml: distortion_model: expected radial-tangential (got "
                        "equidistant)"));
  EXPECT_FALSE(fs::exists(scratch.path() / "in"));
}

TEST(Import, TakesNoLayoutWithoutCameras) {
  const TestFolder folder, scratch;
  folder.write("annotations/instances_val.json", "{}");
  const Outcome refused = import_from(folder, scratch);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("the format coco says nothing of cameras"));
  EXPECT_FALSE(fs::exists(scratch.path() / "in"));
}

// KITTI odometry as the download of grey pictures has it; numbers as it prints them.
class ForeignKitti : public testing::Test {
 protected:
  ForeignKitti() {
    for (const std::string sequence : {"04", "07"}) {
      const std::string folder = fmt::format("sequences/{}/", sequence);
      folder_.write(folder + "calib.txt",
                    "P0: 7.070912000000e+02 0.0 6.018873000000e+02 0.0 0.0 7.070912000000e+02 "
                    "1.831104000000e+02 0.0 0.0 0.0 1.0 0.0\n"
                    "P1: 7.070912000000e+02 0.0 6.018873000000e+02 -3.798145000000e+02 0.0 "
                    "7.070912000000e+02 1.831104000000e+02 0.0 0.0 0.0 1.0 0.0\n");
      folder_.write(folder + "times.txt", "0.000000e+00\n1.037224e-01\n2.073732e-01\n");
      for (int frame = 0; frame < 3; ++frame)
        for (int camera = 0; camera < 2; ++camera)
          folder_.write(fmt::format("{}image_{}/{:06}.png", folder, camera, frame),
                        encoded(".png", cv::Mat(376, 1241, CV_8UC1, cv::Scalar(90 + frame))));
      // Ahead by 1 m, then 1 m more and 0.2 rad to the left.
      folder_.write(fmt::format("poses/{}.txt", sequence),
                    "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n"
                    "0.980066577841 0 -0.198669330795 0 0 1 0 0 0.198669330795 0 0.980066577841 2\n");
    }
  }
  TestFolder folder_;
};

// Mutation: the left camera in place of the robot.
TEST_F(ForeignKitti, GreySequenceIsImportedByItsName) {
  const TestFolder scratch;
  const Outcome imported = import_from(folder_, scratch, {"--only", "04"});
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("3 pairs in"));
  EXPECT_THAT(imported.out, HasSubstr("1241 x 376 px, focal length 707.09 px, baseline 0.5372 m"));
  EXPECT_THAT(imported.out, HasSubstr("warning: the pictures have no colour"));
  EXPECT_EQ(scratch.read("in/left/000002.png"), folder_.read("sequences/04/image_0/000002.png"));
  const auto lines = lines_of_text(scratch.read("in/groundtruth.csv"));
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[1], "0.000000000,0,0,0");
  double x_m = 0.0, y_m = 0.0, theta_rad = 0.0;
  ASSERT_EQ(std::sscanf(lines[3].c_str(), "0.207373200,%lf,%lf,%lf", &x_m, &y_m, &theta_rad), 3) << lines[3];
  const double half_m = 0.5 * 379.8145 / 707.0912;  // the robot is right of the left camera
  EXPECT_NEAR(theta_rad, 0.2, 1e-9);
  EXPECT_NEAR(x_m, 2.0 + half_m * std::sin(0.2), 1e-9);
  EXPECT_NEAR(y_m, half_m - half_m * std::cos(0.2), 1e-9);
}

TEST_F(ForeignKitti, SeveralDrivesAreRefused) {
  const TestFolder scratch;
  const Outcome refused = import_from(folder_, scratch);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("sequences/04/image_0/000002.png and sequences/07/image_0/000000.png are "
                        "of two drives; import one by --only"));
  EXPECT_FALSE(fs::exists(scratch.path() / "in"));
}

// Middlebury's scenes have names, principal points of their own, and each its own calibration.
TEST(ForeignMiddlebury, SceneIsImportedByItsName) {
  const TestFolder folder, scratch;
  for (const auto& [scene, focal] : {std::pair{"Piano", "281.3"}, {"Pipes", "290.25"}}) {
    folder.write(
        fmt::format("{}/calib.txt", scene),
        fmt::format("cam0=[{0} 0 95.5; 0 {0} 60.25; 0 0 1]\ncam1=[{0} 0 101.25; 0 {0} 60.25; 0 0 1]\n"
                    "doffs=5.75\nbaseline=178.232\nwidth=192\nheight=128\nndisp=64\nisint=0\nvmin=5\n"
                    "vmax=60\ndyavg=0\ndymax=0\n",
                    focal));
    for (int camera = 0; camera < 2; ++camera)
      folder.write(fmt::format("{}/im{}.png", scene, camera),
                   encoded(".png", cv::Mat(128, 192, CV_8UC3, cv::Scalar(20, 30, 40))));
  }
  const Outcome both = import_from(folder, scratch);
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("Piano/im0.png and Pipes/im0.png are of two rigs"));
  const Outcome one = import_from(folder, scratch, {"--only", "Pipes"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("192 x 128 px, focal length 290.25 px, baseline 0.1782 m"));
  EXPECT_THAT(one.out, HasSubstr("two different cameras"));  // doffs is not 0
  EXPECT_EQ(scratch.read("in/pictures.csv"), "frame,t_s,left,right\n0,,Pipes/im0.png,Pipes/im1.png\n");
  EXPECT_EQ(run_stereobench({"detect", (scratch.path() / "in").string()}).exit_code, 0);
}

// Mutation: a picture's size is not looked at.
TEST_F(ForeignEuroc, PicturesOfAnotherSizeAreRefused) {
  const TestFolder copy, scratch;
  fs::copy(folder_->path(), copy.path(), fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  std::string sensor = copy.read("mav0/cam0/sensor.yaml");
  sensor.replace(sensor.find("[376, 240]"), 10, "[752, 480]");
  copy.write("mav0/cam0/sensor.yaml", sensor);
  const Outcome refused = import_from(copy, scratch);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("376 x 240 pixels, and 752 x 480 by mav0/cam0/sensor.yaml"));
}

}  // namespace
}  // namespace stereobench::harness
