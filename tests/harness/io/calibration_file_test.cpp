#include "harness/io/calibration_file.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "slam/math/random.h"
#include "tests/complaint.h"
#include "tests/test_folder.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// Law: a rig is read as it was written. Mutations: the pitch looks up; the right camera's turn about the axes
// in another order.
TEST(CalibrationFile, IsReadAsItWasWritten) {
  const TestFolder folder;
  slam::RandomStream random(3, slam::Stream::kWorld);
  for (int i = 0; i < 40; ++i) {
    vision::StereoRig rig{
        {640, 480, 500.0 + random.normal(), 319.5 + random.normal(), 239.5 + random.normal()},
        0.1 + 0.1 * random.uniform(),
        0.5 * random.uniform(),
        0.3 * random.normal()};
    if (i % 2 == 1)
      rig.right_turn_rad = 0.1 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    rig.distortion = {
        .k1 = 0.1 * random.uniform(), .p1 = 1e-3 * random.normal(), .k3 = 0.01 * random.uniform()};
    if (i % 4 > 1) rig.distortion.pixel_aspect = 0.5 + random.uniform();
    folder.write("rig.yaml", calibration_yaml(rig));
    const vision::StereoRig read = read_calibration(folder.path() / "rig.yaml");
    EXPECT_EQ(read.intrinsics.width_px, 640);
    EXPECT_EQ(read.intrinsics.height_px, 480);
    EXPECT_EQ(read.intrinsics.focal_px, rig.intrinsics.focal_px);
    EXPECT_EQ(read.intrinsics.cx_px, rig.intrinsics.cx_px);
    EXPECT_EQ(read.intrinsics.cy_px, rig.intrinsics.cy_px);
    EXPECT_EQ(read.baseline_m, rig.baseline_m);
    EXPECT_EQ(read.height_m, rig.height_m);
    EXPECT_NEAR(read.distortion.pixel_aspect, rig.distortion.pixel_aspect, 1e-15);
    rig.distortion.pixel_aspect = read.distortion.pixel_aspect;
    EXPECT_EQ(read.distortion, rig.distortion);
    EXPECT_NEAR(read.pitch_down_rad, rig.pitch_down_rad, 1e-15);
    EXPECT_LT((read.right_turn_rad - rig.right_turn_rad).norm(), 1e-14);
    EXPECT_EQ(read.right_turn_rad.isZero(0.0), i % 2 == 0);
  }
}

vision::CameraPair two_cameras() {
  vision::CameraPair cameras;
  cameras[0] = {{640, 480, 534.0, 342.0, 235.0}, {.k1 = -0.29, .k2 = 0.1}};
  cameras[1] = {{640, 480, 537.0, 326.0, 250.0}, {.k1 = -0.28, .k2 = 0.09, .p2 = 1e-3}};
  cameras[0].rectified_from_camera = Eigen::AngleAxisd(0.01, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  cameras[1].rectified_from_camera = Eigen::AngleAxisd(0.02, Eigen::Vector3d(-3, 1, 1).normalized()).matrix();
  return cameras;
}

// Law: two different cameras are read as they were written. Mutation: the cameras exchanged.
TEST(CalibrationFile, TwoCamerasAreReadAsTheyWereWritten) {
  const TestFolder folder;
  const vision::CameraPair cameras = two_cameras();
  const vision::StereoRig rig{{640, 480, 535.5, 334.0, 242.5}, 0.083, 0.0, 0.0};
  folder.write("rig.yaml", calibration_yaml(rig, cameras));
  const RigCalibration read = read_rig_calibration(folder.path() / "rig.yaml");
  EXPECT_EQ(read.rig.baseline_m, rig.baseline_m);
  ASSERT_TRUE(read.cameras);
  for (std::size_t side = 0; side < 2; ++side) {
    EXPECT_EQ((*read.cameras)[side].intrinsics.width_px, 640);
    EXPECT_EQ((*read.cameras)[side].intrinsics.focal_px, cameras[side].intrinsics.focal_px);
    EXPECT_EQ((*read.cameras)[side].intrinsics.cy_px, cameras[side].intrinsics.cy_px);
    EXPECT_EQ((*read.cameras)[side].lens, cameras[side].lens);
    EXPECT_EQ((*read.cameras)[side].rectified_from_camera, cameras[side].rectified_from_camera);
  }
  EXPECT_THAT([&] { read_calibration(folder.path() / "rig.yaml"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("expected one camera twice")));
}

// Mutation: a turn that is no rotation let through.
TEST(CalibrationFile, RefusesCamerasThatAreNone) {
  const TestFolder folder;
  const auto complaint = [&](const vision::CameraPair& cameras, const std::string& from,
                             const std::string& to) {
    std::string text = calibration_yaml({{640, 480, 535.5, 334.0, 242.5}, 0.083, 0.0, 0.0}, cameras);
    text.replace(text.rfind(from), from.size(), to);
    folder.write("rig.yaml", text);
    return complaint_of([&] { read_rig_calibration(folder.path() / "rig.yaml"); });
  };
  vision::CameraPair stretched = two_cameras();
  stretched[1].rectified_from_camera *= 1.1;
  vision::CameraPair folded = two_cameras();
  folded[0].lens = {.k1 = -2.0};
  EXPECT_THAT(complaint(stretched, "K", "K"), HasSubstr("right_eye: expected cameras"));
  EXPECT_THAT(complaint(folded, "K", "K"), HasSubstr("expected cameras"));
  EXPECT_THAT(complaint(two_cameras(), "right_eye:", "third_eye:"), HasSubstr("expected both"));
  EXPECT_THAT(complaint(two_cameras(), "K:", "L:"), HasSubstr("K: this key is missing"));
  EXPECT_EQ(complaint(two_cameras(), "K", "K"), "no complaint");
}

TEST(CalibrationFile, RefusesWhatItCannotComputeWith) {
  const TestFolder folder;
  const auto complaint = [&](const std::string& from, const std::string& to) {
    std::string text = calibration_yaml({{640, 480, 500.0, 319.5, 239.5}, 0.12, 0.3, 0.0});
    text.replace(text.find(from), from.size(), to);
    folder.write("rig.yaml", text);
    return complaint_of([&] { read_calibration(folder.path() / "rig.yaml"); });
  };
  EXPECT_THAT(complaint("baseline_m:", "base:"), HasSubstr("rig.yaml: baseline_m: expected a number"));
  EXPECT_THAT(complaint("1.2000000000000000e-01", "-1."), HasSubstr("positive sizes and baseline"));
  EXPECT_THAT(complaint("image_width: 640", "image_width: 0"), HasSubstr("positive sizes"));
  EXPECT_THAT(complaint("data: [ 0., 0.,", "data: [ -3., 0.,"), HasSubstr("D: expected a lens"));
  EXPECT_THAT(complaint("data: [ 500.", "data: [ .Nan"), testing::Not(HasSubstr("no complaint")));
  EXPECT_THAT(complaint("data: [ 500.", "data: [ 1100."), HasSubstr("K: expected focal lengths"));
  EXPECT_THAT(complaint("rows: 3", "rows: 2000000000"), HasSubstr("K: expected a matrix of 3 x 3"));
  EXPECT_THAT(complaint("K: !!opencv-matrix", "K: 3 #"), HasSubstr("rig.yaml: "));
}

}  // namespace
}  // namespace stereobench::harness
