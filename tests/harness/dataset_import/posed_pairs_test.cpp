/// Folders that say a pose of each picture, and not how two cameras are mounted.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "harness/io/calibration_file.h"
#include "harness/io/picture_file.h"
#include "tests/harness/commands/program.h"
#include "tests/harness/dataset_import/carried.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kFocal_px = 400.0;

Isometry3d place(const Vector3d& at_m, double angle_rad, const Vector3d& axis) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
  pose.translation() = at_m;
  return pose;
}

/// A folder of Nerfstudio's layout, written by hand: four pairs on a way that turns and climbs.
struct PosedScene {
  std::array<double, 2> focal_px = {kFocal_px, kFocal_px};
  std::array<Isometry3d, 4> left_from_right;
  Vector3d from_m = {30.1, -7.3, 1.7};
  std::string left = "images/left/", right = "images/right/";

  explicit PosedScene(const Isometry3d& rig) { left_from_right.fill(rig); }

  void write(const TestFolder& folder) const {
    nlohmann::json json = {{"w", 64}, {"h", 48}, {"cx", 32.2}, {"cy", 24.1}};
    for (int i = 0; i < 4; ++i) {
      const Isometry3d world_from_left =
          place(from_m + i * Vector3d(0.9, 0.31, 0.07), 0.3 + 0.4 * i, {1.0, 0.2 * i, -0.5});
      add(json, left, i, 0, world_from_left);
      add(json, right, i, 1, world_from_left * left_from_right[static_cast<std::size_t>(i)]);
      for (const std::string& side : {left, right})
        folder.write(name(side, i), encoded(".png", cv::Mat(48, 64, CV_8UC3, cv::Scalar(10, 20, 30 + i))));
    }
    folder.write("transforms.json", json.dump());
  }

 private:
  static std::string name(const std::string& side, int i) {
    return fmt::format("{}{:06}.png", side, 3 * i + 2);
  }
  void add(nlohmann::json& json, const std::string& side, int i, std::size_t camera,
           const Isometry3d& world_from_camera) const {
    // OpenGL's axes: y up, z backward.
    const Eigen::Matrix4d pose = world_from_camera.matrix() * Eigen::Vector4d(1, -1, -1, 1).asDiagonal();
    nlohmann::json rows = nlohmann::json::array();
    for (int row = 0; row < 4; ++row)
      rows.push_back({pose(row, 0), pose(row, 1), pose(row, 2), pose(row, 3)});
    json["frames"].push_back(
        {{"file_path", name(side, i)}, {"fl_x", focal_px[camera]}, {"transform_matrix", rows}});
  }
};

struct PosedImport {
  TestFolder folder, scratch;
  Outcome outcome;

  explicit PosedImport(const PosedScene& scene) {
    scene.write(folder);
    run();
  }
  void run(const std::vector<std::string>& more = {}) {
    outcome = run_stereobench(with({"import", folder.path().string(), "--out", out().string()}, more));
  }
  fs::path out() const { return scratch.path() / "in"; }
  RigCalibration calibration() const { return read_rig_calibration(out() / "calibration.yaml"); }
  /// Nothing is written, and one line says why.
  void expect_refusal(const std::string& why) const {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(why));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_FALSE(fs::exists(out()));
  }
};

// Law: the rig is where the poses of each pair have the right camera, and numbers that were short are so
// again, far from the origin, too. Mutations: right in left for left in right; numbers are not shortened;
// frames are numbered from 0.
TEST(PosedPairs, AreThoseOfOneRig) {
  const PosedImport done(PosedScene(place({0.1201, 0.0, 0.0}, 0.5 * M_PI / 180.0, Vector3d::UnitY())));
  ASSERT_EQ(done.outcome.exit_code, 0) << done.outcome.err;
  EXPECT_THAT(done.outcome.out, HasSubstr("4 pairs in"));
  EXPECT_THAT(done.outcome.out, HasSubstr("no times, so that there is no log"));
  const RigCalibration found = done.calibration();
  EXPECT_FALSE(found.cameras);
  EXPECT_EQ(found.rig.baseline_m, 0.1201);
  EXPECT_EQ(found.rig.intrinsics.focal_px, kFocal_px);
  EXPECT_EQ(found.rig.intrinsics.cx_px, 31.7);
  EXPECT_EQ(found.rig.intrinsics.cy_px, 23.6);
  EXPECT_EQ(found.rig.height_m, 0.0);
  EXPECT_EQ(found.rig.pitch_down_rad, 0.0);
  EXPECT_LE((found.rig.right_turn_rad - Vector3d(0.0, 0.5 * M_PI / 180.0, 0.0)).norm(), 1e-15);
  for (const char* picture : {"000002", "000005", "000008", "000011"})
    EXPECT_EQ(bytes_of(done.out() / "right" / fmt::format("{}.png", picture)),
              done.folder.read(fmt::format("images/right/{}.png", picture)));
}

// Cameras that are not turned are not made to be so by rounding, which `detect` would undo pixel by pixel.
TEST(PosedPairs, OfALevelRigAreNotTurned) {
  const PosedImport done(PosedScene(place({0.25, 0.0, 0.0}, 0.0, Vector3d::UnitY())));
  ASSERT_EQ(done.outcome.exit_code, 0) << done.outcome.err;
  EXPECT_TRUE(done.calibration().rig.right_turn_rad.isZero(0.0));
}

TEST(PosedPairs, OfTwoCamerasHaveTwoModels) {
  PosedScene scene(place({0.25, 0.01, -0.02}, 0.01, Vector3d::UnitX()));
  scene.focal_px[1] = 410.0;
  const PosedImport done(scene);
  ASSERT_EQ(done.outcome.exit_code, 0) << done.outcome.err;
  EXPECT_THAT(done.outcome.out, HasSubstr("two different cameras, which `detect` rectifies"));
  const RigCalibration found = done.calibration();
  ASSERT_TRUE(found.cameras);
  EXPECT_EQ(found.cameras->back().intrinsics.focal_px, 410.0);
  EXPECT_NEAR(found.rig.baseline_m, Vector3d(0.25, 0.01, -0.02).norm(), 1e-12);
}

// Somebody adjusted the poses of pictures one by one: each is a little off. Mutation: the first pair alone.
TEST(PosedPairs, ThatDifferLittleGiveTheirMean) {
  PosedScene scene(place({0.25, 0.0, 0.0}, 0.0, Vector3d::UnitX()));
  for (std::size_t i = 0; i < 4; ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    scene.left_from_right[i] =
        place({0.25 + sign * 0.0002, 0.0, 0.0}, sign * 0.09 / kFocal_px, Vector3d::UnitX());
  }
  const PosedImport done(scene);
  ASSERT_EQ(done.outcome.exit_code, 0) << done.outcome.err;
  EXPECT_THAT(done.outcome.out,
              HasSubstr("; pairs are off it by up to 0.090 px and 0.080 % of the baseline"));
  EXPECT_NEAR(done.calibration().rig.baseline_m, 0.25, 1e-9);
  EXPECT_LE(done.calibration().rig.right_turn_rad.norm(), 1e-9);
}

// Mutations: a limit on the turn alone, or on the shift alone.
TEST(PosedPairs, OfCamerasThatAreNotFixedAreRefused) {
  PosedScene turned(place({0.25, 0.0, 0.0}, 0.0, Vector3d::UnitX()));
  turned.left_from_right[2] = place({0.25, 0.0, 0.0}, 0.16 / kFocal_px, Vector3d::UnitX());
  PosedImport(turned).expect_refusal(
      "transforms.json: expected two cameras that are fixed to each other (frame images/000008: turned by "
      "0.12 px");
  PosedScene moved(place({0.25, 0.0, 0.0}, 0.0, Vector3d::UnitX()));
  moved.left_from_right[2].translation().z() += 0.0005;
  PosedImport(moved).expect_refusal("moved by 0.15 % of the baseline");
}

TEST(PosedPairs, AreAskedFor) {
  PosedScene single(place({0.25, 0.0, 0.0}, 0.0, Vector3d::UnitX()));
  single.left = "images/a_", single.right = "images/b_";
  PosedImport(single).expect_refusal(
      "transforms.json: expected pairs, which say how two cameras are mounted");
  PosedScene fisheye(place({0.25, 0.0, 0.0}, 0.0, Vector3d::UnitX()));
  PosedImport done(fisheye);
  fs::remove_all(done.out());
  nlohmann::json json = nlohmann::json::parse(done.folder.read("transforms.json"));
  json["camera_model"] = "OPENCV_FISHEYE";
  done.folder.write("transforms.json", json.dump());
  done.run();
  done.expect_refusal("transforms.json: expected pinhole cameras, with radial-tangential lenses or none");
}

/// Two scenes of BOP; those of others need not say poses in the world.
void write_bop(const TestFolder& folder, bool with_poses) {
  for (const char* scene : {"000003", "000004"})
    for (const char* split : {"test_left", "test_right"}) {
      const double shift_mm = std::string(split) == "test_left" ? 0.0 : -120.0;
      nlohmann::json json;
      for (const char* picture : {"4", "17"}) {
        json[picture] = {{"cam_K", {300, 0, 32, 0, 300, 24, 0, 0, 1}}};
        if (with_poses)
          json[picture].update({{"cam_R_w2c", {1, 0, 0, 0, 1, 0, 0, 0, 1}}, {"cam_t_w2c", {shift_mm, 0, 0}}});
        folder.write(fmt::format("{}/{}/rgb/{:0>6}.png", split, scene, picture),
                     encoded(".png", cv::Mat(48, 64, CV_8UC3, cv::Scalar(10, 20, 30))));
      }
      folder.write(fmt::format("{}/{}/scene_camera.json", split, scene), json.dump());
    }
}

// Mutation: numbers of pictures behind a scene's name are not read.
TEST(PosedPairs, OfASceneOfBopKeepTheirNumbers) {
  const TestFolder folder, scratch;
  write_bop(folder, true);
  const std::vector<std::string> import = {"import", folder.path().string(), "--out",
                                           (scratch.path() / "in").string()};
  const Outcome both = run_stereobench(import);
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("are of two drives; import one by --only"));
  const Outcome one = run_stereobench(with(import, {"--only", "000004"}));
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("64 x 48 px, focal length 300.00 px, baseline 0.1200 m"));
  EXPECT_EQ(scratch.read("in/pictures.csv"),
            "frame,t_s,left,right\n"
            "4,,test_left/000004/rgb/000004.png,test_right/000004/rgb/000004.png\n"
            "17,,test_left/000004/rgb/000017.png,test_right/000004/rgb/000017.png\n");
}

TEST(PosedPairs, OfBopNeedPosesInTheWorld) {
  const TestFolder folder, scratch;
  write_bop(folder, false);
  const Outcome refused = run_stereobench(
      {"import", folder.path().string(), "--only", "000003", "--out", (scratch.path() / "in").string()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("expected a pose of each picture (frame 000003/000004)"));
}

// A right camera that looks later is elsewhere by then: by how much changes with the robot's speed.
TEST(PosedPairs, OfALateRightCameraAreRefused) {
  const fs::path sets = rendered(kBend, "plain,colmap", {"--set", "shutter.right_delay_s=0.004"});
  const TestFolder scratch;
  const Outcome refused =
      run_stereobench({"import", (sets / "colmap").string(), "--out", (scratch.path() / "in").string()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("sparse/0/images.txt: expected two cameras that are fixed"));
}

}  // namespace
}  // namespace stereobench::harness
