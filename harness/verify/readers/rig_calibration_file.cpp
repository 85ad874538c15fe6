#include "harness/verify/readers/rig_calibration_file.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/io/calibration_file.h"
#include "harness/verify/readers/yaml_numbers.h"

namespace stereobench::harness {
namespace {

/// A matrix that follows from what the file says of the rig.
struct DerivedMatrix {
  const char* key;
  std::size_t count;
  const char* from;
};

constexpr std::array kDerived = {
    DerivedMatrix{"P1", 12, "K"}, DerivedMatrix{"P2", 12, "K and baseline_m"},
    DerivedMatrix{"robot_from_left_camera", 16, "a camera that looks ahead and down"},
    DerivedMatrix{"robot_from_right_camera", 16, "baseline_m and the left camera"}};

void compare(DatasetView& view, const std::string& file, const YAML::Node& said, const YAML::Node& derived) {
  constexpr double kRounding = 1e-7;
  for (const DerivedMatrix& matrix : kDerived) {
    if (!said[matrix.key].IsDefined()) continue;
    const std::vector<double> one = numbers_in(view.folder / file, said, matrix.key, matrix.count);
    const std::vector<double> other = numbers_in(view.folder / file, derived, matrix.key, matrix.count);
    for (std::size_t i = 0; i < one.size(); ++i)
      if (std::abs(one[i] - other[i]) > kRounding * (1.0 + std::abs(other[i]))) {
        view.faults.push_back({file, "",
                               fmt::format("{}: its number {} is {:.9g}, and {:.9g} by {}", matrix.key, i + 1,
                                           one[i], other[i], matrix.from)});
        break;
      }
  }
}

}  // namespace

std::array<ViewCamera, 2> read_rig_cameras(DatasetView& view, const std::string& file) {
  const std::filesystem::path path = view.folder / file;
  const vision::StereoRig rig = read_calibration(path);
  const YAML::Node said = yaml_in(path);
  compare(view, file, said, yaml_of(calibration_yaml(rig), path));
  std::array<ViewCamera, 2> cameras;
  for (ViewCamera& camera : cameras) camera.pinhole = rig.intrinsics, camera.lens = rig.distortion;
  constexpr std::array kKeys = {"robot_from_left_camera", "robot_from_right_camera"};
  for (std::size_t side = 0; side < 2; ++side)
    if (said[kKeys[side]].IsDefined()) cameras[side].body_from_camera = transform_in(path, said, kKeys[side]);
  if (!said[kKeys[1]].IsDefined()) {
    cameras[1].body_from_camera = cameras[0].body_from_camera;
    cameras[1].body_from_camera.translate(Eigen::Vector3d(rig.baseline_m, 0.0, 0.0));
  }
  view.checked.push_back(fmt::format("{} against itself", file));
  return cameras;
}

}  // namespace stereobench::harness
