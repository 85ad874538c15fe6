#include <cmath>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/text_file.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/rig_calibration_file.h"
#include "harness/verify/readers/stereo_readers.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr std::array kSideNames = {"left", "right"};

/// Both cameras of a frame in the world, in axes as the field's.
struct CameraPoses {
  std::array<Eigen::Matrix4d, 2> world_from_camera;
  long line = 0;
};

/// camera_data.txt: "Frame 7", then "L" and "R", each with sixteen numbers in Blender's axes.
std::map<int, CameraPoses> camera_data_in(const fs::path& file) {
  std::istringstream lines(read_text(file));
  std::map<int, CameraPoses> all;
  CameraPoses* frame = nullptr;
  long number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string word;
    if (!(words >> word)) continue;
    if (word == "Frame") {
      int name = 0;
      words >> name;
      frame = &all[name];
      frame->line = number;
      continue;
    }
    Eigen::Matrix4d matrix;
    for (int i = 0; i < 16; ++i) words >> matrix(i / 4, i % 4);
    if (frame == nullptr || words.fail() || (word != "L" && word != "R"))
      throw std::runtime_error(
          fmt::format("{}: line {}: expected Frame, or L or R and 16 numbers", file.string(), number));
    matrix.col(1) *= -1.0;
    matrix.col(2) *= -1.0;
    frame->world_from_camera[word == "L" ? 0 : 1] = matrix;
  }
  return all;
}

void compare_baselines(DatasetView& view, const std::string& file, const std::array<ViewCamera, 2>& cameras,
                       const std::map<int, CameraPoses>& poses) {
  constexpr double kRounding = 1e-6;
  const double wanted_m =
      (cameras[0].body_from_camera.inverse() * cameras[1].body_from_camera).translation().norm();
  for (const auto& [name, frame] : poses) {
    const auto& [left, right] = frame.world_from_camera;
    const double got_m = (right - left).topRightCorner<3, 1>().norm();
    if (std::abs(got_m - wanted_m) <= kRounding * wanted_m) continue;
    view.faults.push_back(
        {view.calibration_file, fmt::format("{:04}", name),
         fmt::format("baseline: {:.6g} m, and {:.6g} m between the cameras of {}: {:+.3g} %", wanted_m, got_m,
                     file, 100.0 * (wanted_m / got_m - 1.0))});
    return;  // one for all frames
  }
}

void add_files(DatasetView& view, const std::string& scene, ViewFrame& frame, const std::string& pictures,
               const std::string& name) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const char* const side_name = kSideNames[index_of(side)];
    add_channel(view, frame, side, Channel::kPicture,
                fmt::format("{}/{}/{}/{}.png", pictures, scene, side_name, name));
    add_channel(view, frame, side, Channel::kDisparity,
                fmt::format("disparity/{}/{}/{}.pfm", scene, side_name, name));
    add_channel(view, frame, side, Channel::kFlow,
                fmt::format("optical_flow/{}/into_future/{}/OpticalFlowIntoFuture_{}_{}.pfm", scene,
                            side_name, name, side == Side::kLeft ? "L" : "R"));
  }
}

void read_scene(DatasetView& view, const std::string& pictures, const std::string& scene) {
  const std::string data = fmt::format("camera_data/{}/camera_data.txt", scene);
  const std::string rig = fmt::format("camera_data/{}/calibration.yaml", scene);
  std::array<ViewCamera, 2> cameras;
  std::map<int, CameraPoses> poses;
  if (fs::exists(view.folder / data))
    read_or_blame(view, data, [&] { poses = camera_data_in(view.folder / data); });
  view.calibration_file = rig;
  view.poses_file = data;
  view.has_calibration = fs::exists(view.folder / rig);
  if (view.has_calibration)
    read_or_blame(view, rig, [&] {
      cameras = read_rig_cameras(view, rig);
      compare_baselines(view, data, cameras, poses);
      cameras[1].body_from_camera = cameras[0].body_from_camera.inverse() * cameras[1].body_from_camera;
      cameras[0].body_from_camera = Eigen::Isometry3d::Identity();
    });
  else
    view.cannot.push_back(fmt::format("disparity and flow of {} against poses: there is no {}", scene, rig));
  std::vector<std::string> folders;
  for (const char* side : kSideNames) folders.push_back(fmt::format("{}/{}/{}", pictures, scene, side));
  const std::set<std::string> names = complete_frames(view, folders, ".png");
  complete_frames(view, {fmt::format("disparity/{}/left", scene), fmt::format("disparity/{}/right", scene)},
                  ".pfm");
  for (const std::string& name : names) {
    ViewFrame frame = {.name = name, .cameras = cameras};
    const int number = std::atoi(name.c_str());
    frame.next_follows = names.contains(fmt::format("{:0{}}", number + 1, name.size()));
    if (poses.contains(number)) {
      const Eigen::Matrix4d& left = poses.at(number).world_from_camera[0];
      frame.world_from_body[0] = frame.world_from_body[1] = as_rigid(left);
      view.poses.push_back({.file = data, .line = poses.at(number).line, .stamp_ns = {}});
      view.poses.back().matrix = left;
    } else if (!poses.empty()) {
      view.faults.push_back({data, name, "missing frame: there is a picture, and no pose"});
    }
    add_files(view, scene, frame, pictures, name);
    view.frames.push_back(std::move(frame));
  }
  if (!view.frames.empty()) view.frames.back().drive_goes_on = view.frames.back().next_follows = false;
}

std::string pictures_of(const fs::path& folder) {
  return fs::is_directory(folder / "frames_cleanpass") ? "frames_cleanpass" : "frames_finalpass";
}

}  // namespace

bool looks_like_sceneflow(const fs::path& folder) {
  return fs::is_directory(folder / pictures_of(folder));
}

DatasetView read_sceneflow_view(const fs::path& folder) {
  DatasetView view = {.format = "sceneflow", .folder = folder};
  view.depth_file = "disparity";
  view.pictures_file = pictures_of(folder);
  std::set<std::string> scenes;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / view.pictures_file))
    if (entry.is_directory()) scenes.insert(entry.path().filename().string());
  for (const std::string& scene : scenes) read_scene(view, view.pictures_file, scene);
  return view;
}

}  // namespace stereobench::harness
