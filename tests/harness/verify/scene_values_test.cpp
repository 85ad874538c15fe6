// What readers of scenes make of numbers, by folders that are written by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/io/picture_file.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

// The camera of Nerfstudio looks along its -z, with y up: ours along +z, with y down. Without cx and cy the
// middle of the picture is meant, which is between the pixels 31 and 32 of 64.
// Mutations tried: y not turned; half a pixel not taken off; the width's half for the height's.
TEST(NerfstudioValues, HaveOurAxesAndTheMiddleOfThePicture) {
  const TestFolder set;
  set.write("images/a.png", encoded(".png", cv::Mat::zeros(48, 64, CV_8UC3)));
  set.write("transforms.json", R"({"fl_x": 400, "w": 64, "h": 48, "frames": [{"file_path": "images/a.png",
    "transform_matrix": [[1, 0, 0, 7], [0, 0, -1, 2], [0, 1, 0, 3], [0, 0, 0, 1]]}]})");
  const DatasetView view = dataset_reader("nerfstudio").read(set.path());
  ASSERT_EQ(view.frames.size(), 1U);
  const ViewFrame& frame = view.frames.front();
  Eigen::Matrix4d expected;
  expected << 1, 0, 0, 7, 0, 0, 1, 2, 0, -1, 0, 3, 0, 0, 0, 1;
  EXPECT_EQ(frame.world_from_body[0]->matrix(), expected);
  EXPECT_EQ(frame.cameras[0].pinhole.cx_px, 31.5);
  EXPECT_EQ(frame.cameras[0].pinhole.cy_px, 23.5);
}

// depth_scale is mm a level; 1 where it is not said.
// Mutations tried: depth_scale left out; another one than 1 where it is not said.
TEST(BopValues, HaveDepthInLevelsOfDepthScale) {
  const TestFolder set;
  const std::string scene = "test/000001/";
  set.write(scene + "scene_camera.json",
            R"({"0": {"cam_K": [300, 0, 32, 0, 300, 24, 0, 0, 1], "depth_scale": 0.1},
                                             "1": {"cam_K": [300, 0, 32, 0, 300, 24, 0, 0, 1]}})");
  for (int picture = 0; picture < 2; ++picture) {
    set.write(fmt::format("{}rgb/{:06}.png", scene, picture),
              encoded(".png", cv::Mat::zeros(48, 64, CV_8UC3)));
    set.write(fmt::format("{}depth/{:06}.png", scene, picture),
              encoded(".png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(12000))));
  }
  const DatasetView view = dataset_reader("bop").read(set.path());
  ASSERT_EQ(view.frames.size(), 2U);
  for (const auto& [frame, depth_m] : {std::pair(0U, 1.2F), std::pair(1U, 12.0F)}) {
    const ChannelFile* depth = find_channel(view.frames[frame], vision::Side::kLeft, Channel::kDepth);
    ASSERT_NE(depth, nullptr);
    EXPECT_FLOAT_EQ(depth->read().at<float>(7, 5), depth_m);
  }
}

// Runs must fill the picture: 5 x 4 pixels here, of which 3 are the object's.
// Mutations tried: the sum not compared, or that of the object's pixels.
TEST(CocoValues, HaveRunsThatFillThePicture) {
  const TestFolder set;
  const auto write = [&](const char* runs) {
    set.write("annotations/instances_x.json", fmt::format(R"({{"images": [{{"id": 1, "file_name": "a.png",
      "width": 5, "height": 4}}], "categories": [{{"id": 1, "name": "x"}}], "annotations": [{{"id": 1,
      "image_id": 1, "category_id": 1, "iscrowd": 0, "bbox": [1, 0, 1, 3], "area": 3,
      "segmentation": {{"size": [4, 5], "counts": {}}}}}]}})",
                                                          runs));
    return faults_of(set.path(), "coco");
  };
  EXPECT_EQ(write("[4, 3, 13]"), "");
  EXPECT_THAT(write("[4, 3, 12]"),
              HasSubstr("the runs of its segmentation have 19 pixels: expected 20 (5 x 4)"));
}

}  // namespace
}  // namespace stereobench::harness
