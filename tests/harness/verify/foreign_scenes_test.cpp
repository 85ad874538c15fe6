// Folders as other programs write them: keys that ours has not, other orders, no optional files.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/io/picture_file.h"
#include "harness/verify/readers/scene/picture_pairs.h"
#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;

std::string grey_png(int width, int height) {
  return encoded(".png", cv::Mat(height, width, CV_8UC1, cv::Scalar(90)));
}

/// A mask of a rectangle.
cv::Mat rectangle(const cv::Rect& box) {
  cv::Mat mask = cv::Mat::zeros(48, 64, CV_8UC1);
  mask(box).setTo(255);
  return mask;
}

/// Reconstructed from photographs: points are seen half a pixel beside where they are, some corners are of no
/// point, one picture shows none, and one picture of the folder was not used.
class ReconstructedScene {
 public:
  ReconstructedScene() {
    folder_.write("sparse/0/cameras.txt",
                  "# Camera list\n# Number of cameras: 2\n7 SIMPLE_RADIAL 640 480 500 320 240 -0.05\n"
                  "3 FULL_OPENCV 640 480 500 501 320 240 0 0 0 0 0 0 0 0\n");
    std::string images = fmt::format(
        "# Image list\n12 1 0 0 0 0 0 0 7 first photo.JPG\n{}\n4 1 0 0 0 -0.5 0 0 3 "
        "night/b.JPG\n{}\n9 1 0 0 0 -300 0 0 3 far.JPG\n\n",
        points(0.0, -0.05), points(0.5, 0.0));
    for (int i = 0; i < 4; ++i)  // near the others: the one that is far off is no leap
      images += fmt::format("{} 1 0 0 0 -0.{} 0 0 3 near_{}.JPG\n\n", 20 + i, i + 1, i);
    folder_.write("sparse/0/images.txt", images);
    std::string text = "# 3D point list\n";
    for (int i = 0; i < 25; ++i)
      text += fmt::format("{} {} {} 4 200 100 0 0.6 4 {} 12 {}\n", i + 100, x_of(i), y_of(i), 2 * i, 2 * i);
    folder_.write("sparse/0/points3D.txt", text);
    folder_.write("sparse/0/cameras.bin", "bytes");
    for (const char* name : {"first photo.JPG", "night/b.JPG", "far.JPG", "near_0.JPG", "near_1.JPG",
                             "near_2.JPG", "near_3.JPG", "unused.JPG"})
      folder_.write(std::string("images/") + name, grey_png(640, 480));
  }
  const std::filesystem::path& path() const { return folder_.path(); }
  const TestFolder& folder() const { return folder_; }

 private:
  static double x_of(int i) { return 0.4 * (i % 5) - 0.8; }
  static double y_of(int i) { return 0.4 * (i / 5) - 0.8; }

  static std::string points(double camera_x, double k1) {
    std::string text;
    for (int i = 0; i < 25; ++i) {
      const double u = (x_of(i) - camera_x) / 4.0, v = y_of(i) / 4.0, bend = 1.0 + k1 * (u * u + v * v);
      const double beside_px = i % 2 == 0 ? 0.5 : -0.5;
      text += fmt::format("{} {} {} 3.5 7.25 -1 ", 500.0 * bend * u + 320.0 + beside_px,
                          (k1 == 0.0 ? 501.0 : 500.0) * bend * v + 240.0 - beside_px, i + 100);
    }
    text.pop_back();
    return text;
  }

  TestFolder folder_;
};

// Mutations tried: readers that take a pose for its inverse, the first pixel's corner for its centre, errors
// of points for none, corners of no point for points, photographs for a way, or an object that is there twice
// for one; places of objects without an error; packed runs whose differences begin one late, or in rows.
TEST(ColmapOfOthers, IsReadWithItsErrorsAndWithoutFaults) {
  const ReconstructedScene scene;
  EXPECT_EQ(reader_of(scene.path()).format, "colmap");
  EXPECT_EQ(faults_of(scene.path(), "colmap"), "");
  const Verification result = verify_dataset(scene.path(), dataset_reader("colmap"), [](double) {});
  EXPECT_THAT(result.checked, testing::Contains(HasSubstr("points of the world in pictures")));
}

TEST(ColmapOfOthers, IsSaidNotToBeReadWhereItIs) {
  const ReconstructedScene fisheye;
  fisheye.folder().write(
      "sparse/0/cameras.txt",
      "7 OPENCV_FISHEYE 640 480 500 500 320 240 0 0 0 0\n3 THIN_PRISM_FISHEYE 640 480 1\n");
  const Verification result = verify_dataset(fisheye.path(), dataset_reader("colmap"), [](double) {});
  EXPECT_TRUE(result.faults.empty());
  EXPECT_THAT(result.cannot, testing::Contains(HasSubstr("the camera model OPENCV_FISHEYE is not read")));
  TestFolder binary;
  for (const char* name : {"sparse/0/cameras.bin", "sparse/0/images.bin"}) binary.write(name, "bytes");
  EXPECT_EQ(reader_of(binary.path()).format, "colmap");
  EXPECT_THAT([&] { faults_of(binary.path(), "colmap"); },
              testing::ThrowsMessage<std::runtime_error>(
                  HasSubstr("sparse/0: expected a model as text, cameras.txt and images.txt")));
}

// Errors of a focal length that is 2 % off are larger than what the model says that they are.
TEST(ColmapOfOthers, HasAFaultWhereItsErrorsAreLargerThanItSays) {
  const ReconstructedScene scene;
  scene.folder().write("sparse/0/cameras.txt",
                       "7 SIMPLE_RADIAL 640 480 600 320 240 -0.05\n"
                       "3 FULL_OPENCV 640 480 600 601 320 240 0 0 0 0 0 0 0 0\n");
  EXPECT_THAT(faults_of(scene.path(), "colmap"), HasSubstr("focal length too long by 2"));
}

// Mutation: halves missed although most pictures have none.
TEST(PicturePairs, MissAHalfWhereMostAreWhole) {
  const std::vector<std::string> pairs = {"left/a.png", "right/a.png", "left/b.png", "right/b.png",
                                          "x/right/c.png"};
  const auto missing = missing_halves(picture_pairs(pairs), pairs);
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_EQ(missing.front(), std::pair(std::string("x/left/c.png"), std::string("x/right/c.png")));
  const std::vector<std::string> single = {"left/a.png", "right/a.png", "left/b.png", "left/c.png",
                                           "front/d.png"};
  EXPECT_TRUE(missing_halves(picture_pairs(single), single).empty());
  EXPECT_EQ(picture_pairs(single).size(), 4U);
}

TEST(CocoOfOthers, HasPolygonsCrowdsAndNoPictures) {
  TestFolder set;
  // The runs 1158, 8, 40, 8, 40, 8, 1810 of 48 rows, as pycocotools packs them: a box of 3 x 8 pixels.
  set.write("annotations/instances_val2017.json", R"({
    "annotations": [
      {"segmentation": [[10.5, 5.25, 30, 5.25, 30, 20.5, 10.5, 20.5], [12, 22, 20, 22, 20, 30.75]], "area": 301.4,
       "iscrowd": 0, "image_id": 139, "bbox": [10.5, 5.25, 19.5, 25.5], "category_id": 90, "id": 900100000001},
      {"segmentation": {"counts": "VT18X1000Zg1", "size": [48, 64]}, "area": 24, "iscrowd": 1, "image_id": 139,
       "bbox": [24, 6, 3, 8], "category_id": 1, "id": 77},
      {"segmentation": [], "image_id": 785, "bbox": [0, 0, 63.99, 48], "category_id": 1, "id": 78,
       "keypoints": [1, 2, 2], "num_keypoints": 1, "score": 0.5}],
    "licenses": [{"url": "none", "id": 1, "name": "x"}],
    "images": [{"license": 4, "file_name": "000000000785.jpg", "coco_url": "u", "height": 48, "width": 64,
                "date_captured": "2013-11-19 21:22:42", "flickr_url": "f", "id": 785},
               {"file_name": "000000000139.jpg", "height": 48, "width": 64, "id": 139}],
    "categories": [{"supercategory": "person", "id": 1, "name": "person"}, {"id": 90, "name": "toothbrush"}]})");
  set.write("annotations/captions_val2017.json",
            R"({"images": [], "annotations": [{"id": 1, "caption": "x"}]})");
  EXPECT_EQ(reader_of(set.path()).format, "coco");
  EXPECT_EQ(faults_of(set.path(), "coco"), "");
  for (const char* name : {"val2017/000000000785.jpg", "val2017/000000000139.jpg"})
    set.write(name, grey_png(64, 48));
  EXPECT_EQ(faults_of(set.path(), "coco"), "");
  std::filesystem::remove(set.path() / "val2017/000000000139.jpg");
  EXPECT_THAT(faults_of(set.path(), "coco"),
              HasSubstr("val2017/000000000139.jpg: frame 000000000139: missing frame"));
  set.write("annotations/instances_val2017.json", "{\"images\": []}");
  EXPECT_THAT([&] { faults_of(set.path(), "coco"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("instances_val2017.json: ")));
}

/// Scanned objects before a sensor: grey pictures, two of the same object, annotations that are a millimetre
/// off, boxes whose last column does not count.
class ScannedScene {
 public:
  ScannedScene() {
    std::string cameras, poses, infos;
    for (int picture = 0; picture < 3; ++picture) {
      const char* comma = picture == 0 ? "" : ", ";
      cameras += fmt::format(
          R"({}"{}": {{"elev": 45, "mode": 0, "depth_scale": 0.1, "cam_R_w2c": [1, 0, 0, 0, 1, 0, 0, 0, 1],
              "cam_t_w2c": [{}, 0, 0], "cam_K": [300, 0, 32, 0, 301, 24, 0, 0, 1]}})",
          comma, 10 * picture, -50.0 * picture);
      poses += fmt::format(R"({}"{}": [{}, {}, {}, {}])", comma, 10 * picture,
                           object(5, -20 - 50 * picture, picture), object(5, 40 - 50 * picture, 0),
                           object(2, 10 - 50 * picture, -picture), object(8, 60 - 50 * picture, 0));
      std::string list;
      for (int i = 0; i < 4; ++i) {
        list += fmt::format(
            R"({}{{"bbox_obj": [10, 5, 19, 9], "bbox_visib": [{}, 5, {}, 9], "px_count_all": 210,
                "px_count_valid": 180, "px_count_visib": {}, "visib_fract": {}}})",
            i == 0 ? "" : ", ", i == 3 ? -1 : 10, i == 3 ? -1 : 19, i == 3 ? 0 : 200,
            i == 3 ? 0.0 : 0.952381);
        const std::string name = fmt::format("{:06}_{:06}.png", 10 * picture, i);
        const cv::Rect box(10, 5, 20, 10);
        set_.write("test_primesense/000004/mask/" + name, encoded(".png", rectangle(box)));
        set_.write("test_primesense/000004/mask_visib/" + name,
                   encoded(".png", i == 3 ? rectangle({}) : rectangle(box)));
      }
      infos += fmt::format(R"({}"{}": [{}])", comma, 10 * picture, list);
      set_.write(fmt::format("test_primesense/000004/gray/{:06}.tif", 10 * picture), grey_png(64, 48));
    }
    set_.write("test_primesense/000004/scene_camera.json", "{" + cameras + "}");
    set_.write("test_primesense/000004/scene_gt.json", "{" + poses + "}");
    set_.write("models/models_info.json", R"({"2": {"diameter": 80.5, "min_x": -1}, "5": {"diameter": 30}})");
    set_.write("models_eval/models_info.json", "{}");
    set_.write("test_primesense/000007/scene_camera.json",
               R"({"0": {"cam_K": [300, 0, 32, 0, 301, 24, 0, 0, 1], "depth_scale": 1}})");
    infos_ = infos;
  }
  void write_infos() const { set_.write("test_primesense/000004/scene_gt_info.json", "{" + infos_ + "}"); }
  const std::filesystem::path& path() const { return set_.path(); }

 private:
  static std::string object(int number, int x_mm, int off_mm) {
    return fmt::format(
        R"({{"obj_id": {}, "cam_R_m2c": [1, 0, 0, 0, 1, 0, 0, 0, 1], "cam_t_m2c": [{}, {}, 400], "extra": null}})",
        number, x_mm, off_mm);
  }
  TestFolder set_;
  std::string infos_;
};

TEST(BopOfOthers, IsReadWithItsErrorsAndWithoutFaults) {
  const ScannedScene scene;
  EXPECT_EQ(reader_of(scene.path()).format, "bop");
  EXPECT_EQ(faults_of(scene.path(), "bop"), "") << "without scene_gt_info.json";
  scene.write_infos();
  EXPECT_EQ(faults_of(scene.path(), "bop"), "");
  const Verification result = verify_dataset(scene.path(), dataset_reader("bop"), [](double) {});
  EXPECT_THAT(result.checked,
              testing::Contains(HasSubstr("places of objects in both cameras and in the next frame, "
                                          "against poses (4 points)")));
}

TEST(NerfstudioOfOthers, HasCamerasOfItsOwnAndNoDepth) {
  TestFolder set;
  const auto frame = [](const char* file, const char* more) {
    return fmt::format(
        R"({{"transform_matrix": [[1, 0, 0, 0.5], [0, 0, -1, 2], [0, 1, 0, 3], [0, 0, 0, 1]], "file_path": "{}"{}}})",
        file, more);
  };
  const std::string own =
      R"(, "fl_x": 400, "fl_y": 401, "cx": 32, "cy": 24, "w": 64, "h": 48, "colmap_im_id": 3)";
  set.write("transforms.json", fmt::format(R"({{"aabb_scale": 16, "applied_transform": [[1, 0, 0, 0]],
    "ply_file_path": "sparse_pc.ply", "train_filenames": [], "frames": [{}, {}]}})",
                                           frame("images/frame_00002.JPG", own.c_str()),
                                           frame("./images/frame_00001.JPG", own.c_str())));
  for (const char* name : {"images/frame_00001.JPG", "images/frame_00002.JPG"})
    set.write(name, grey_png(64, 48));
  EXPECT_EQ(reader_of(set.path()).format, "nerfstudio");
  EXPECT_EQ(faults_of(set.path(), "nerfstudio"), "");
  set.write("transforms.json", fmt::format(R"({{"camera_angle_x": 0.69, "frames": [{}]}})",
                                           frame("./train/r_0", R"(, "rotation": 0.01, "time": 0.0)")));
  set.write("train/r_0.png", grey_png(80, 80));
  EXPECT_EQ(faults_of(set.path(), "nerfstudio"), "");
  set.write(
      "transforms.json",
      fmt::format(R"({{"camera_model": "OPENCV_FISHEYE", "fl_x": 400, "w": 80, "h": 80, "frames": [{}]}})",
                  frame("train/r_0.png", "")));
  EXPECT_EQ(faults_of(set.path(), "nerfstudio"), "");
  const Verification result = verify_dataset(set.path(), dataset_reader("nerfstudio"), [](double) {});
  EXPECT_THAT(result.cannot, testing::Contains(HasSubstr("or of a model that is not read")));
  set.write("transforms.json", "{\"frames\": []}");
  EXPECT_THAT(
      [&] { faults_of(set.path(), "nerfstudio"); },
      testing::ThrowsMessage<std::runtime_error>(HasSubstr("transforms.json: frames: expected a list")));
}

}  // namespace
}  // namespace stereobench::harness
