#include <fmt/format.h>
#include <gmock/gmock.h>

#include "harness/io/picture_file.h"
#include "harness/io/picture_reader.h"
#include "tests/harness/verify/planted_scene.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::Matrix4d;
using nlohmann::ordered_json;
using testing::HasSubstr;

constexpr double kBaseline_m = 0.12;
constexpr std::array kBopScenes = {"test_left/000000/", "test_right/000000/"};
const Eigen::Vector4d kGl = {1.0, -1.0, -1.0, 1.0};

/// A pose as the format writes it; of millimetres in BOP.
using ChangePose = std::function<void(Matrix4d&, bool is_right)>;

void change_colmap_poses(const PlantedSet& set, const ChangePose& change) {
  std::istringstream lines(set.text("sparse/0/images.txt"));
  std::string text;
  for (std::string line; std::getline(lines, line); text += line + "\n") {
    if (!line.ends_with(".png")) continue;
    std::istringstream words(line);
    std::string number, camera, name;
    std::array<double, 7> n{};
    words >> number;
    for (double& value : n) words >> value;
    words >> camera >> name;
    Matrix4d pose = Matrix4d::Identity();
    pose.topLeftCorner<3, 3>() = Eigen::Quaterniond(n[0], n[1], n[2], n[3]).toRotationMatrix();
    pose.topRightCorner<3, 1>() << n[4], n[5], n[6];
    change(pose, camera == "2");
    const Eigen::Quaterniond q(Eigen::Matrix3d(pose.topLeftCorner<3, 3>()));
    line = fmt::format("{} {} {} {} {} {} {} {} {} {}", number, q.w(), q.x(), q.y(), q.z(), pose(0, 3),
                       pose(1, 3), pose(2, 3), camera, name);
  }
  set.write("sparse/0/images.txt", text);
}

void change_nerfstudio_poses(const PlantedSet& set, const ChangePose& change) {
  change_json(set, "transforms.json", [&](ordered_json& json) {
    for (auto& frame : json["frames"]) {
      Matrix4d pose;
      auto& rows = frame["transform_matrix"];
      for (std::size_t i = 0; i < 16; ++i) pose(Index(i / 4), Index(i % 4)) = rows[i / 4][i % 4];
      change(pose, frame["file_path"].get<std::string>().find("right") != std::string::npos);
      for (std::size_t i = 0; i < 16; ++i) rows[i / 4][i % 4] = pose(Index(i / 4), Index(i % 4));
    }
  });
}

void change_bop_poses(const PlantedSet& set, const ChangePose& change) {
  for (std::size_t side = 0; side < 2; ++side)
    change_json(set, std::string(kBopScenes[side]) + "scene_camera.json", [&](ordered_json& json) {
      for (auto& camera : json) {
        Matrix4d pose = Matrix4d::Identity();
        for (std::size_t i = 0; i < 9; ++i) pose(Index(i / 3), Index(i % 3)) = camera["cam_R_w2c"][i];
        for (std::size_t i = 0; i < 3; ++i) pose(Index(i), 3) = camera["cam_t_w2c"][i];
        change(pose, side == 1);
        for (std::size_t i = 0; i < 9; ++i) camera["cam_R_w2c"][i] = pose(Index(i / 3), Index(i % 3));
        for (std::size_t i = 0; i < 3; ++i) camera["cam_t_w2c"][i] = pose(Index(i), 3);
      }
    });
}

void change_scene_poses(const PlantedSet& set, const ChangePose& change) {
  if (set.format() == "colmap") return change_colmap_poses(set, change);
  if (set.format() == "bop") return change_bop_poses(set, change);
  change_nerfstudio_poses(set, change);
}

void invert_poses(const PlantedSet& set) {
  change_scene_poses(set, [](Matrix4d& pose, bool) { pose = Matrix4d(pose.inverse()); });
}
/// Those of Nerfstudio are in OpenGL's axes, and should be: the fault is the other way round.
void mix_axes_up(const PlantedSet& set) {
  change_scene_poses(set, [&](Matrix4d& pose, bool) {
    pose =
        set.format() == "nerfstudio" ? Matrix4d(pose * kGl.asDiagonal()) : Matrix4d(kGl.asDiagonal() * pose);
  });
}
void write_centimetres(const PlantedSet& set) {
  change_scene_poses(set, [](Matrix4d& pose, bool) { pose.topRightCorner<3, 1>() *= 100.0; });
}
void move_right_cameras(const PlantedSet& set) {
  change_scene_poses(set, [&](Matrix4d& pose, bool is_right) {
    const double by = (set.format() == "bop" ? 1000.0 : 1.0) * 0.01 * kBaseline_m;
    if (!is_right) return;
    if (set.format() == "nerfstudio")
      pose.topRightCorner<3, 1>() += by * pose.topLeftCorner<3, 1>();
    else
      pose(0, 3) -= by;
  });
}
void exchange_poses(const PlantedSet& set) {
  change_scene_poses(
      set, [](Matrix4d& pose, bool is_right) { pose(0, 3) += is_right ? kBaseline_m : -kBaseline_m; });
}

/// Multiplies focal lengths, and moves principal points right and down.
void change_cameras(const PlantedSet& set, double focal, double by_px) {
  if (set.format() == "bop") {
    for (const char* scene : kBopScenes)
      change_json(set, std::string(scene) + "scene_camera.json", [&](ordered_json& json) {
        for (auto& camera : json)
          for (std::size_t i = 0; i < 6; ++i)
            camera["cam_K"][i] = i % 4 == 0         ? focal * camera["cam_K"][i].get<double>()
                                 : i == 2 || i == 5 ? camera["cam_K"][i].get<double>() + by_px
                                                    : 0.0;
      });
  } else if (set.format() == "colmap") {
    std::string text;
    for (const int camera : {1, 2})
      text += fmt::format("{} PINHOLE 320 240 {} {} {} {}\n", camera, 280 * focal, 280 * focal, 160 + by_px,
                          120 + by_px);
    set.write("sparse/0/cameras.txt", text);
  } else {
    change_json(set, "transforms.json", [&](ordered_json& json) {
      for (const char* key : {"fl_x", "fl_y"}) json[key] = focal * json[key].get<double>();
      for (const char* key : {"cx", "cy"}) json[key] = json[key].get<double>() + by_px;
    });
  }
}
void shorten_by_half_a_pixel(const PlantedSet& set) {
  change_cameras(set, 1.0, -0.5);
}
void add_half_a_pixel(const PlantedSet& set) {
  change_cameras(set, 1.0, 0.5);
}
void lengthen_focals(const PlantedSet& set) {
  change_cameras(set, 1.01, 0.0);
}

std::vector<fs::path> pngs_in(const PlantedSet& set, const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(set.path(folder))) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}
void exchange_pictures(const PlantedSet& set) {
  const std::string left = set.format() == "bop" ? "test_left/000000/rgb" : "images/left";
  const std::string right = set.format() == "bop" ? "test_right/000000/rgb" : "images/right";
  for (const fs::path& file : pngs_in(set, left)) {
    const std::string one = left + "/" + file.filename().string(),
                      other = right + "/" + file.filename().string();
    const std::string kept = set.text(one);
    set.write(one, set.text(other));
    set.write(other, kept);
  }
}
void change_levels(const PlantedSet& set, const std::string& folder,
                   const std::function<double(double)>& factor) {
  for (const fs::path& file : pngs_in(set, folder)) {
    cv::Mat depth;
    read_exact_png(file).convertTo(depth, CV_64F);
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u)
        depth.at<double>(v, u) *= factor(std::hypot((u - 159.5) / 280.0, (v - 119.5) / 280.0, 1.0));
    depth.convertTo(depth, CV_16U);
    set.write(folder + "/" + file.filename().string(), encoded(".png", depth));
  }
}
void measure_along_the_ray(const PlantedSet& set) {
  for (const char* folder : {"depth/left", "depth/right"})
    change_levels(set, folder, [](double ray) { return ray; });
}
void write_other_levels(const PlantedSet& set) {
  if (set.format() == "nerfstudio")
    for (const char* folder : {"depth/left", "depth/right"})
      change_levels(set, folder, [](double) { return 5.0; });
  else
    for (const char* scene : kBopScenes)
      change_json(set, std::string(scene) + "scene_camera.json", [](ordered_json& json) {
        for (auto& camera : json) camera["depth_scale"] = 1.0;
      });
}
void delay_all_pictures(const PlantedSet& set) {
  for (const char* folder : {"images/left", "images/right"}) {
    const std::vector<fs::path> files = pngs_in(set, folder);
    for (std::size_t i = files.size(); i-- > 1;)
      set.write(std::string(folder) + "/" + files[i].filename().string(),
                set.text(std::string(folder) + "/" + files[i - 1].filename().string()));
  }
}
/// A picture's two lines, and nothing else that speaks of it.
void forget_a_picture(const PlantedSet& set) {
  std::string text = set.text("sparse/0/images.txt");
  const std::size_t begin = text.rfind("\n", text.find("right/000004.png")) + 1;
  text.erase(begin, text.find('\n', text.find('\n', begin) + 1) + 1 - begin);
  set.write("sparse/0/images.txt", text);
}
void misnumber_a_point(const PlantedSet& set) {
  std::string text = set.text("sparse/0/images.txt");
  const std::size_t line = text.find('\n', text.find("right/000004.png")) + 1;
  std::string points = text.substr(line, text.find('\n', line) - line);
  points.replace(points.rfind(' ') + 1, std::string::npos, "77");
  text.replace(line, text.find('\n', line) - line, points);
  set.write("sparse/0/images.txt", text);
}
template <int Number>
void delete_file(const PlantedSet& set) {
  constexpr std::array kFiles = {"images/right/000004.png", "depth/left/000004.png",
                                 "test_right/000000/rgb/000004.png",
                                 "test_left/000000/mask_visib/000004_000000.png"};
  ASSERT_TRUE(fs::remove(set.path(kFiles.at(Number))));
}

void write_metres(const PlantedSet& set) {
  for (const char* scene : kBopScenes)
    change_json(set, std::string(scene) + "scene_camera.json", [](ordered_json& json) {
      for (auto& camera : json)
        for (auto& number : camera["cam_t_w2c"]) number = 1e-3 * number.get<double>();
    });
}

class PlantedInScene : public testing::TestWithParam<SceneCase> {};

// Mutations tried: poses of each camera taken for those of a body, balls looked for in the world, missing
// pictures and wrong points of tracks let be. Law: a fault that the format has redundancy for is found, and
// called what it is.
TEST_P(PlantedInScene, IsFoundAndNamed) {
  const PlantedSet set(GetParam().format);
  GetParam().plant(set);
  EXPECT_THAT(set.faults(), HasSubstr(GetParam().cause));
}

constexpr SceneCase kSceneCases[] = {
    {"inverse", "colmap", invert_poses, "inverse poses"},
    {"inverse", "bop", invert_poses, "inverse poses"},
    {"inverse", "nerfstudio", invert_poses, "inverse poses"},
    {"axes", "colmap", mix_axes_up, "camera axes are mixed up"},
    {"axes", "bop", mix_axes_up, "camera axes are mixed up"},
    {"axes", "nerfstudio", mix_axes_up, "camera axes are mixed up"},
    {"centimetres", "colmap", write_centimetres, "places of poses in centimetres"},
    {"centimetres", "bop", write_centimetres, "places of poses in centimetres"},
    {"centimetres", "nerfstudio", write_centimetres, "places of poses in centimetres"},
    {"metres", "bop", write_metres, "places of poses in metres instead of millimetres"},
    {"swapped_pictures", "colmap", exchange_pictures, "swapped cameras"},
    {"swapped_pictures", "bop", exchange_pictures, "swapped cameras"},
    {"swapped_pictures", "nerfstudio", exchange_pictures, "swapped cameras"},
    {"swapped_poses", "colmap", exchange_poses, "swapped cameras: left is right"},
    {"baseline", "colmap", move_right_cameras, "baseline too long by 1 %"},
    {"baseline", "bop", move_right_cameras, "baseline too long by 1 %"},
    {"focal", "colmap", lengthen_focals, "focal length too long by 1 %"},
    {"focal", "bop", lengthen_focals, "focal length too long by 1"},
    {"focal", "nerfstudio", lengthen_focals, "focal length too long by"},
    {"half_a_pixel", "colmap", shorten_by_half_a_pixel, "principal point too far right and down by -0.5 px"},
    {"half_a_pixel", "bop", add_half_a_pixel, "principal point too far right"},
    {"depth_scale", "bop", write_other_levels, "depth too large by 400 %"},
    {"depth_scale", "nerfstudio", write_other_levels, "depth too large by 400 %"},
    {"along_rays", "nerfstudio", measure_along_the_ray, "depth along the ray"},
    {"late_pictures", "nerfstudio", delay_all_pictures, "pictures are a frame late"},
    {"lost_file", "colmap", delete_file<0>, "images/right/000004.png: frame 000004: missing frame"},
    {"lost_file", "coco", delete_file<0>, "images/right/000004.png: frame 000004: missing frame"},
    {"lost_file", "nerfstudio", delete_file<0>,
     "images/right/000004.png: frame images/000004: missing frame"},
    {"lost_depth", "nerfstudio", delete_file<1>, "depth/left/000004.png: frame images/000004: missing frame"},
    {"lost_file", "bop", delete_file<2>,
     "test_right/000000/rgb/000004.png: frame 000000/000004: missing frame"},
    {"lost_mask", "bop", delete_file<3>, "mask_visib/000004_000000.png: frame 000004: missing mask"},
    {"lost_picture", "colmap", forget_a_picture, "missing frame: line"},
    {"point", "colmap", misnumber_a_point, "is not number"},
};

INSTANTIATE_TEST_SUITE_P(Faults, PlantedInScene, testing::ValuesIn(kSceneCases), [](const auto& test) {
  return std::string(test.param.name) + "_in_" + test.param.format;
});

TEST(FilesOfAScene, AreReadToTheirEnds) {
  for (const auto& [format, file] :
       {std::pair("colmap", "images/left/000003.png"), std::pair("coco", "images/left/000003.png"),
        std::pair("nerfstudio", "depth/right/000003.png"),
        std::pair("bop", "test_left/000000/depth/000003.png"),
        std::pair("bop", "test_left/000000/mask_visib/000003_000000.png")}) {
    const PlantedSet set(format);
    EXPECT_EQ(set.faults(), "") << format;
    std::string bytes = set.text(file);
    bytes.at(bytes.size() / 2) = static_cast<char>(bytes.at(bytes.size() / 2) ^ 4);
    set.write(file, bytes);
    EXPECT_THAT(set.faults(), HasSubstr(file)) << format;
  }
}

}  // namespace
}  // namespace stereobench::harness
