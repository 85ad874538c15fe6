/// Calibration from pictures of a board: rendered ones, whose rig is known, and real ones.
#include "harness/rig_calibration/rig_calibration.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "harness/rig_calibration/calibration_report.h"
#include "harness/rig_calibration/calibration_warnings.h"
#include "renderer/camera/expose.h"
#include "renderer/renderer.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/rig_calibration/board_views.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr Board kBoard{9, 6, 0.03};
constexpr std::size_t kViews = 9;

/// A chessboard as a mesh: (right, down) of the board are its x and y, and a rim of white squares is around.
void write_board_mesh(const TestFolder& folder) {
  const int across = kBoard.columns + 3;
  const int down = kBoard.rows + 3;
  std::string vertices, white, black;
  for (int row = 0; row <= down; ++row)
    for (int column = 0; column <= across; ++column)
      vertices += "v " + std::to_string(kBoard.square_m * (column - 2)) + " " +
                  std::to_string(kBoard.square_m * (row - 2)) + " 0\n";
  for (int row = 0; row < down; ++row) {
    for (int column = 0; column < across; ++column) {
      const int corner = row * (across + 1) + column + 1;
      const bool rim = row == 0 || column == 0 || row == down - 1 || column == across - 1;
      (rim || (row + column) % 2 == 1 ? white : black) +=
          "f " + std::to_string(corner) + " " + std::to_string(corner + 1) + " " +
          std::to_string(corner + across + 2) + " " + std::to_string(corner + across + 1) + "\n";
    }
  }
  folder.write("board.mtl", "newmtl white\nKd 0.85 0.85 0.85\nnewmtl black\nKd 0.08 0.08 0.08\n");
  folder.write("board.obj",
               "mtllib board.mtl\n" + vertices + "usemtl white\n" + white + "usemtl black\n" + black);
}

/// The board held somewhere in the world of a robot at the origin.
worlds::World world_with_board(const TestFolder& folder, const vision::StereoRig& rig,
                               const Eigen::Isometry3d& left_from_board) {
  const Eigen::Isometry3d world_from_board = vision::robot_from_camera(rig) * left_from_board;
  const Eigen::Vector3d turns = world_from_board.linear().eulerAngles(2, 1, 0);
  worlds::World world;
  world.light.ambient = 1.0;
  world.light.diffuse = 0.0;
  world.meshes.push_back({.file = (folder.path() / "board.obj").string(),
                          .position_m = world_from_board.translation(),
                          .heading_rad = turns[0],
                          .material = worlds::Material::kFile,
                          .roll_rad = turns[2],
                          .pitch_rad = turns[1]});
  return world;
}

/// Pictures of the board through a rig, rendered once for all tests of this file.
class RenderedBoards : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TestFolder>();
    write_board_mesh(*folder_);
    rig_ = test::faulty_rig();
    rig_.height_m = 1.0;
    fs::create_directories(folder_->path() / "left");
    fs::create_directories(folder_->path() / "right");
    std::uint64_t frame = 0;
    for (const Eigen::Isometry3d& place : test::board_places(kBoard, kViews, 4)) {
      renderer::Renderer renderer(world_with_board(*folder_, rig_, place), rig_);
      const vision::StereoPair pair =
          renderer::expose(renderer.render({}), {.noise_sd_levels = 2.0, .defocus_sd_px = 0.5}, 1, frame);
      const std::string name = std::to_string(frame++) + ".png";
      cv::imwrite((folder_->path() / "left" / name).string(), pair.left);
      cv::imwrite((folder_->path() / "right" / name).string(), pair.right);
    }
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static std::vector<ViewFiles> files() { return find_view_files(folder_->path(), {}); }

  static std::unique_ptr<TestFolder> folder_;
  static vision::StereoRig rig_;
};
std::unique_ptr<TestFolder> RenderedBoards::folder_;
vision::StereoRig RenderedBoards::rig_;

// The rig that rendered the pictures is found again, within what the fit says of itself. Mutations:
// corners half a pixel off (by which the centre is); corners not refined; a window as wide as two squares.
TEST_F(RenderedBoards, GiveBackTheRigThatTookThem) {
  for (const RigModel model : {RigModel::kOneCamera, RigModel::kTwoCameras}) {
    const BoardCalibration found = calibrate_rig(files(), {.board = kBoard, .model = model});
    EXPECT_EQ(found.used.size(), kViews);
    EXPECT_LT(found.fit.rms_px, 0.06);
    EXPECT_LT(found.row_rms_px, 0.055);
    for (const double deviation : test::deviations(found.fit, rig_, model))
      EXPECT_LT(std::abs(deviation), 4.0) << calibration_text(found, {.board = kBoard, .model = model});
    EXPECT_NEAR(found.square_mean_m, kBoard.square_m, 1e-5);
    EXPECT_EQ(found.rig.cameras.has_value(), model == RigModel::kTwoCameras);
  }
}

/// The same pictures, made lower: what a picture shows is as before, and its pixels are no longer square.
class StretchedBoards : public RenderedBoards {
 protected:
  static constexpr int kRows = 614;

  void SetUp() override {
    for (const ViewFiles& view : files()) {
      for (const fs::path& file : {view.left, view.right}) {
        cv::Mat lower;
        cv::resize(cv::imread(file.string()), lower, {rig_.intrinsics.width_px, kRows}, 0.0, 0.0,
                   cv::INTER_AREA);
        const fs::path folder = stretched_.path() / file.parent_path().filename();
        fs::create_directories(folder);
        cv::imwrite((folder / file.filename()).string(), lower);
      }
    }
  }

  TestFolder stretched_;
};

// Pixels are found to be as wide as they are, and nothing is warned of; as square ones they explain nothing
// and the turn of the right camera is off. Mutations: the simplest model always; the aspect not written.
TEST_F(StretchedBoards, AreMeasuredByPixelsThatAreNotSquare) {
  const double aspect = static_cast<double>(kRows) / rig_.intrinsics.height_px;
  const auto files = find_view_files(stretched_.path(), {});
  const BoardSettings settings{.board = kBoard, .model = RigModel::kOneCamera};
  const BoardCalibration found = calibrate_rig(files, settings);
  EXPECT_NEAR(found.rig.rig.distortion.pixel_aspect, aspect, 4.0 * found.fit.cameras_sd[0][kAspect]);
  EXPECT_LT(found.fit.rms_px, 0.06);
  EXPECT_LT(found.row_rms_px, 0.066);
  EXPECT_NEAR(found.square_mean_m, kBoard.square_m, 1e-5);
  EXPECT_THAT(warnings_of(found, settings), testing::IsEmpty());
  BoardSettings square = settings;
  square.compared.aspect = false;
  const BoardCalibration taken_for_square = calibrate_rig(files, square);
  EXPECT_GT(taken_for_square.fit.rms_px, 3.0 * found.fit.rms_px);
  EXPECT_THAT(warnings_of(taken_for_square, square),
              testing::Contains(HasSubstr("leave out --pixels square")));
}

// The rig that is found is drawn through: a board seen through it has its squares' size, as measured above.
TEST_F(StretchedBoards, TheCommandComparesModelsAndDetectReadsTheRig) {
  const std::string folder = stretched_.path().string();
  for (const std::string model : {"one", "two"}) {
    const std::string out = folder + "/" + model;
    const Outcome found = run_stereobench(
        {"calibrate-rig", folder, "--corners", "9x6", "--square-m", "0.03", "--model", model, "--out", out});
    ASSERT_EQ(found.exit_code, 0) << found.err;
    EXPECT_THAT(found.out, testing::ContainsRegex("fx = fy, k1 k2 p1 p2 .*(rejected|refused)"));
    EXPECT_THAT(found.out, testing::ContainsRegex("fx, fy, .* taken"));
    const Outcome detected = run_stereobench(
        {"detect", folder + "/left/0.png", folder + "/right/0.png", "--rig", out + "/calibration.yaml"});
    EXPECT_EQ(detected.exit_code, 0) << detected.err;
  }
  const Outcome square =
      run_stereobench({"calibrate-rig", folder, "--corners", "9x6", "--square-m", "0.03", "--model", "one",
                       "--pixels", "square", "--out", folder + "/square"});
  EXPECT_EQ(square.exit_code, 0);
  EXPECT_THAT(square.err, HasSubstr("warning: corners are"));
}

std::string dropped(const BoardCalibration& calibration, const std::string& view) {
  for (const ViewOutcome& outcome : calibration.outcomes)
    if (outcome.name == view) return outcome.dropped;
  return "no such view";
}

// Mutations: an outlier that stays; cameras exchanged in the reason.
TEST_F(RenderedBoards, ViewsThatDoNotSuitAreDroppedWithTheReason) {
  const TestFolder odd;
  cv::imwrite((odd.path() / "blank.png").string(), cv::Mat(768, 1024, CV_8UC3, cv::Scalar::all(90)));
  cv::imwrite((odd.path() / "small.png").string(), cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(90)));
  auto views = files();
  views[0].right = odd.path() / "blank.png";
  views[1].left = odd.path() / "blank.png";
  views[2].right = odd.path() / "small.png";
  views[3].right = views[4].right;  // taken at another time
  const BoardCalibration found = calibrate_rig(views, {.board = kBoard});
  EXPECT_EQ(found.used.size(), kViews - 4);
  EXPECT_THAT(dropped(found, "0"), HasSubstr("no board of 9 x 6 inner corners in the right picture"));
  EXPECT_THAT(dropped(found, "1"), HasSubstr("in the left picture"));
  EXPECT_THAT(dropped(found, "2"), HasSubstr("the right picture has 64 x 48 pixels, most have 1024 x 768"));
  EXPECT_THAT(dropped(found, "3"), HasSubstr("px off, those of the other views"));
  EXPECT_EQ(dropped(found, "4"), "");
  views.resize(6);
  for (std::size_t i = 3; i < 6; ++i) views[i].left = odd.path() / "blank.png";
  EXPECT_THAT([&] { calibrate_rig(views, {.board = kBoard}); },
              ThrowsMessage<std::runtime_error>(HasSubstr(
                  "expected at least 3 views in which both cameras see the board (got 0); 0: no board")));
}

TEST_F(RenderedBoards, SwappedPicturesAreSaidToBe) {
  auto views = files();
  for (ViewFiles& view : views) std::swap(view.left, view.right);
  EXPECT_THAT([&] { calibrate_rig(views, {.board = kBoard}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("left and right are swapped")));
}

// What the command writes is read by `detect`; both cameras see the same (nothing), through their own lenses.
TEST_F(RenderedBoards, TheCommandWritesWhatDetectReads) {
  const std::string folder = folder_->path().string();
  for (const std::string model : {"one", "two"}) {
    const std::string out = folder + "/" + model;
    const Outcome found = run_stereobench(
        {"calibrate-rig", folder, "--corners", "9x6", "--square-m", "0.03", "--model", model, "--out", out});
    ASSERT_EQ(found.exit_code, 0) << found.err;
    EXPECT_THAT(found.out, HasSubstr("9 of 9 views"));
    EXPECT_FALSE(cv::imread(out + "/rectified.png").empty());
    EXPECT_THAT(bytes_of(out + "/calibration.json"), HasSubstr("\"row_rms_px\""));
    const Outcome detected = run_stereobench(
        {"detect", folder + "/left/0.png", folder + "/right/0.png", "--rig", out + "/calibration.yaml"});
    EXPECT_EQ(detected.exit_code, 0) << detected.err;
    EXPECT_THAT(detected.out, HasSubstr("\"balls\":[]"));
  }
}

TEST_F(RenderedBoards, OddCallsAreOneLine) {
  const std::string folder = folder_->path().string();
  const auto complaint = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"calibrate-rig"});
    arguments.insert(arguments.end(), {"--out", folder + "/odd"});
    const Outcome outcome = run_stereobench(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(folder + "/odd"));
    return outcome.err;
  };
  EXPECT_THAT(complaint({folder}), HasSubstr("--square-m"));
  EXPECT_THAT(complaint({folder, "--square-m", "0"}), HasSubstr("--square-m"));
  EXPECT_THAT(complaint({folder, "--square-m", "0.03", "--corners", "9by6"}),
              HasSubstr("--corners: expected"));
  EXPECT_THAT(complaint({folder, "--square-m", "0.03", "--corners", "2x6"}), HasSubstr("from 3x3 on"));
  EXPECT_THAT(complaint({folder, "--square-m", "0.03", "--lens", "k4"}), HasSubstr("--lens: expected"));
  EXPECT_THAT(complaint({folder, "--square-m", "0.03", "--left", "left/*"}), HasSubstr("both patterns"));
  EXPECT_THAT(complaint({folder + "/none", "--square-m", "0.03"}), HasSubstr("no such folder"));
  EXPECT_THAT(complaint({folder + "/left", "--square-m", "0.03"}), HasSubstr("no pairs of pictures"));
}

TEST(BoardFiles, ArePairedByWhatTheStarStandsFor) {
  const TestFolder folder;
  for (const char* name : {"left01.jpg", "right01.jpg", "left02.jpg", "right03.jpg", "left.yml", "right.yml"})
    folder.write(name, "");
  const auto views = find_view_files(folder.path(), {});
  ASSERT_EQ(views.size(), 1U);
  EXPECT_EQ(views[0].name, "left01");
  EXPECT_EQ(views[0].right, folder.path() / "right01.jpg");
  for (const char* name : {"cam0/b.png", "cam1/b.png", "cam0/a.png", "cam1/a.png"}) folder.write(name, "");
  const auto cams = find_view_files(folder.path(), {"cam0/*.png", "cam1/*.png"});
  ASSERT_EQ(cams.size(), 2U);
  EXPECT_EQ(cams[0].name, "a");
  EXPECT_THROW(find_view_files(folder.path(), {"cam0/*.png", "cam1/a.png"}), std::runtime_error);
  EXPECT_THROW(find_view_files(folder.path(), {"cam0/*.png", "cam2/*.png"}), std::runtime_error);
  EXPECT_THROW(find_view_files(folder.path(), {"left*.png", "right*.png"}), std::runtime_error);
}

/// The 13 pairs of a board that OpenCV's samples come with; STEREOBENCH_OPENCV_DOC says where they are if not
/// where Debian's opencv-doc puts them.
fs::path opencv_pictures() {
  const char* set = std::getenv("STEREOBENCH_OPENCV_DOC");
  return fs::path(set != nullptr ? set : "/usr/share/doc/opencv-doc") / "examples/data";
}

TEST(RealBoards, AreExplainedToAFifthOfAPixel) {
  if (!fs::exists(opencv_pictures() / "left01.jpg")) GTEST_SKIP() << "no opencv-doc";
  const BoardCalibration found = calibrate_rig(
      find_view_files(opencv_pictures(), {"left*.jpg", "right*.jpg"}), {.board = {9, 6, 0.025}});
  EXPECT_EQ(found.used.size(), 13U);
  EXPECT_LT(found.fit.rms_px, 0.21);
  EXPECT_LT(found.row_rms_px, 0.15);
  EXPECT_THAT(dropped(found, "left"), HasSubstr("612 x 459 pixels"));  // another pair, of something else
}

// The same, made lower by a fifth: explained as well, and the right camera is turned as it was.
TEST(RealBoards, AreExplainedAsWellWhenStretched) {
  if (!fs::exists(opencv_pictures() / "left01.jpg")) GTEST_SKIP() << "no opencv-doc";
  const TestFolder folder;
  for (const ViewFiles& view : find_view_files(opencv_pictures(), {"left*.jpg", "right*.jpg"}))
    for (const fs::path& file : {view.left, view.right}) {
      cv::Mat lower;
      cv::resize(cv::imread(file.string()), lower, {}, 1.0, 0.8, cv::INTER_AREA);
      cv::imwrite((folder.path() / file.filename().replace_extension(".png")).string(), lower);
    }
  const BoardSettings settings{.board = {9, 6, 0.025}};
  const BoardCalibration found = calibrate_rig(find_view_files(folder.path(), {}), settings);
  EXPECT_LT(found.fit.rms_px, 0.21);
  EXPECT_NEAR(found.fit.cameras[0][kAspect], 0.8, 0.002);
  BoardSettings square = settings;
  square.compared.aspect = false;
  EXPECT_GT(calibrate_rig(find_view_files(folder.path(), {}), square).fit.rms_px, 0.5);
}

}  // namespace
}  // namespace stereobench::harness
