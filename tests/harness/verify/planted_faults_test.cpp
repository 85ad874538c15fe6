#include <gmock/gmock.h>

#include "tests/harness/verify/planted_set.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using Path = PlantedSet::Path;
using Plant = void (*)(const PlantedSet&);

/// A fault in a format, and what the message says of it.
struct PlantedCase {
  const char* name;
  const char* format;
  Plant plant;
  const char* cause;
};

void PrintTo(const PlantedCase& planted, std::ostream* out) {
  *out << planted.name << " in " << planted.format;
}

void turn_to_gl(const PlantedSet& set) {
  set.change_poses([](Path& path) {
    for (Eigen::Matrix4d& pose : path) pose = pose * Eigen::Vector4d(1.0, -1.0, -1.0, 1.0).asDiagonal();
  });
}
void mount_in_gl(const PlantedSet& set) {
  set.change_calibration({.has_axes_of_gl = true});
}
void invert(const PlantedSet& set) {
  set.change_poses([](Path& path) {
    for (Eigen::Matrix4d& pose : path) pose = Eigen::Matrix4d(pose.inverse());
  });
}
void to_centimetres(const PlantedSet& set) {
  set.change_poses([](Path& path) {
    for (Eigen::Matrix4d& pose : path) pose.topRightCorner<3, 1>() *= 100.0;
  });
}
void deepen_to_centimetres(const PlantedSet& set) {
  set.change_depth([](double) { return 100.0; });
}
void swap_cameras_of(const PlantedSet& set) {
  set.swap_pictures();
}
void lengthen_baseline(const PlantedSet& set) {
  set.change_calibration({.baseline = 1.01});
}
void lengthen_focal(const PlantedSet& set) {
  set.change_calibration({.focal = 1.01});
}
void delay_poses(const PlantedSet& set) {
  set.change_poses([](Path& path) {
    path.insert(path.begin(), path.front());
    path.pop_back();
  });
}
void delay_pictures_of(const PlantedSet& set) {
  set.delay_pictures();
}
void shift_half_a_pixel(const PlantedSet& set) {
  set.change_calibration({.right_px = 0.5, .down_px = 0.5});
}
void measure_along_rays(const PlantedSet& set) {
  set.change_depth([](double ray) { return ray; });
}

class Planted : public testing::TestWithParam<PlantedCase> {};

// Law: a fault that the format has redundancy for is found, and called what it is.
TEST_P(Planted, IsFoundAndNamed) {
  const PlantedSet set(GetParam().format);
  GetParam().plant(set);
  EXPECT_THAT(set.faults(), HasSubstr(GetParam().cause));
}

constexpr PlantedCase kCases[] = {
    {"axes", "plain", mount_in_gl, "OpenGL"},
    {"axes", "tum", turn_to_gl, "OpenGL"},
    {"axes", "sceneflow", turn_to_gl, "OpenGL"},
    {"axes", "vslamlab", turn_to_gl, "OpenGL"},
    {"axes", "kitti-odometry", turn_to_gl, "OpenGL"},
    {"axes", "euroc", mount_in_gl, "OpenGL"},
    {"inverse", "plain", invert, "inverse poses"},
    {"inverse", "tum", invert, "inverse poses"},
    {"inverse", "sceneflow", invert, "inverse poses"},
    {"inverse", "euroc", invert, "inverse poses"},
    {"inverse", "vslamlab", invert, "inverse poses"},
    {"inverse", "kitti-odometry", invert, "inverse poses"},
    {"centimetres", "plain", to_centimetres, "centimetres"},
    {"centimetres", "tum", to_centimetres, "centimetres"},
    {"centimetres", "sceneflow", to_centimetres, "centimetres"},
    {"centimetres", "euroc", to_centimetres, "centimetres"},
    {"centimetres", "vslamlab", to_centimetres, "centimetres"},
    {"centimetres", "kitti-odometry", to_centimetres, "centimetres"},
    {"centimetres_of_depth", "plain", deepen_to_centimetres, "depth in centimetres"},
    {"swapped", "plain", swap_cameras_of, "swapped cameras"},
    {"swapped", "euroc", swap_cameras_of, "swapped cameras"},
    {"swapped", "vslamlab", swap_cameras_of, "swapped cameras"},
    {"swapped", "kitti-odometry", swap_cameras_of, "swapped cameras"},
    {"swapped", "kitti-stereo", swap_cameras_of, "swapped cameras"},
    {"swapped", "kitti-stereo-2012", swap_cameras_of, "swapped cameras"},
    {"swapped", "kitti-scene-flow", swap_cameras_of, "swapped cameras"},
    {"swapped", "middlebury", swap_cameras_of, "swapped cameras"},
    {"swapped", "eth3d", swap_cameras_of, "swapped cameras"},
    {"swapped", "sceneflow", swap_cameras_of, "swapped cameras"},
    {"baseline", "plain", lengthen_baseline, "baseline too long by 1 %"},
    {"baseline", "sceneflow", lengthen_baseline, "+1 %"},
    {"baseline", "kitti-stereo", lengthen_baseline, "+1 %"},
    {"baseline", "kitti-scene-flow", lengthen_baseline, "+1 %"},
    {"focal", "plain", lengthen_focal, "focal length too long by 1 %"},
    {"focal", "sceneflow", lengthen_focal, "focal length too long by 1 %"},
    {"focal", "tum", lengthen_focal, "focal length too long by"},
    {"focal", "kitti-stereo", lengthen_focal, "focal length"},
    {"focal", "middlebury", lengthen_focal, "focal length"},
    {"late_poses", "plain", delay_poses, "poses are a frame late"},
    {"late_poses", "sceneflow", delay_poses, "poses are a frame late"},
    {"late_poses", "tum", delay_poses, "poses are a frame late"},
    {"late_pictures", "plain", delay_pictures_of, "pictures are a frame late"},
    {"late_pictures", "middlebury", delay_pictures_of, "pictures are a frame late"},
    {"late_pictures", "eth3d", delay_pictures_of, "pictures are a frame late"},
    {"late_pictures", "kitti-stereo", delay_pictures_of, "pictures are a frame late"},
    {"late_pictures", "euroc", delay_pictures_of, "pictures are a frame late"},
    {"late_pictures", "vslamlab", delay_pictures_of, "pictures are a frame late"},
    {"late_pictures", "kitti-odometry", delay_pictures_of, "pictures are a frame late"},
    {"late_pictures", "sceneflow", delay_pictures_of, "pictures are a frame late"},
    {"half_a_pixel", "plain", shift_half_a_pixel, "principal point too far right"},
    {"half_a_pixel", "sceneflow", shift_half_a_pixel, "principal point too far right"},
    {"half_a_pixel", "middlebury", shift_half_a_pixel, "principal point"},
    {"half_a_pixel", "eth3d", shift_half_a_pixel, "principal point"},
    {"along_rays", "plain", measure_along_rays, "depth along the ray"},
    {"along_rays", "tum", measure_along_rays, "depth along the ray"},
};

INSTANTIATE_TEST_SUITE_P(Faults, Planted, testing::ValuesIn(kCases), [](const auto& test) {
  std::string name = std::string(test.param.name) + "_" + test.param.format;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace stereobench::harness
