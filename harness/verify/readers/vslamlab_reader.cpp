#include "harness/verify/readers/vslamlab_reader.h"

#include <stdexcept>

#include <fmt/format.h>

#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/yaml_numbers.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr const char* kPairs = "rgb.csv";
constexpr const char* kTruth = "groundtruth.csv";
constexpr const char* kRigCameras = "calibration.yaml";

ViewCamera camera_in(const fs::path& file, const YAML::Node& yaml) {
  require_word(file, yaml, "cam_model", "pinhole");
  require_word(file, yaml, "distortion_type", "radtan5");
  const std::vector<double> focal = numbers_in(file, yaml, "focal_length", 2);
  const std::vector<double> centre = numbers_in(file, yaml, "principal_point", 2);
  const std::vector<double> lens = numbers_in(file, yaml, "distortion_coefficients", 5);
  const std::vector<double> size = numbers_in(file, yaml, "image_dimension", 2);
  ViewCamera camera;
  camera.pinhole = {static_cast<int>(size[0]), static_cast<int>(size[1]), focal[0], centre[0], centre[1]};
  camera.lens = {.k1 = lens[0], .k2 = lens[1], .p1 = lens[2], .p2 = lens[3], .k3 = lens[4]};
  camera.lens.pixel_aspect = focal[1] / focal[0];
  camera.body_from_camera = transform_in(file, yaml, "T_BS");
  return camera;
}

std::array<ViewCamera, 2> cameras_in(const fs::path& file) {
  const YAML::Node list = yaml_in(file)["cameras"];
  if (!list.IsDefined() || !list.IsSequence() || list.size() != 2)
    throw std::runtime_error(fmt::format("{}: cameras: expected two", file.string()));
  return {camera_in(file, list[0]), camera_in(file, list[1])};
}

void read_truth(DatasetView& view) {
  const NumberTable table =
      read_comma_separated_table(view.folder / kTruth, {"ts (ns)", "tx", "ty", "tz", "qx", "qy", "qz", "qw"});
  for (const TableRow& row : table.rows) {
    ViewPose pose = pose_in(table, row, 1, false);
    pose.file = kTruth;
    pose.stamp_ns = nanoseconds_in(table, row, 0);
    view.poses.push_back(pose);
  }
  view.place_precision_m = precision_of(table, 1, 3);
  view.turn_precision = precision_of(table, 4, 4);
}

void add_picture(DatasetView& view, ViewFrame& frame, Side side, const std::string& file,
                 std::set<std::string>& there) {
  if (there.erase(fs::path(file).filename().string()) == 0)
    view.faults.push_back({file, frame.name, fmt::format("missing frame: {} lists it", kPairs)});
  add_channel(view, frame, side, Channel::kPicture, file);
}

void read_vslamlab_frames(DatasetView& view, const std::array<ViewCamera, 2>& cameras) {
  std::array<std::set<std::string>, 2> there = {stems_in(view.folder / "rgb_0", ""),
                                                stems_in(view.folder / "rgb_1", "")};
  const NumberTable table =
      read_comma_separated_table(view.folder / kPairs, {"ts_rgb_0", "path_rgb_0", "ts_rgb_1", "path_rgb_1"});
  for (const TableRow& row : table.rows) {
    ViewFrame frame = {.name = row.cells[0], .cameras = cameras};
    frame.stamp_ns = {nanoseconds_in(table, row, 0), nanoseconds_in(table, row, 2)};
    for (std::size_t side = 0; side < 2; ++side) {
      frame.world_from_body[side] = pose_at(view.poses, *frame.stamp_ns[side]);
      add_picture(view, frame, static_cast<Side>(side), row.cells[2 * side + 1], there[side]);
    }
    view.frames.push_back(std::move(frame));
  }
  for (std::size_t side = 0; side < 2; ++side)
    for (const std::string& name : there[side])
      view.faults.push_back({fmt::format("rgb_{}/{}", side, name), "",
                             fmt::format("missing frame in {}: it does not list this picture", kPairs)});
}

}  // namespace

bool looks_like_vslamlab(const fs::path& folder) {
  return fs::exists(folder / kPairs) && fs::is_directory(folder / "rgb_0");
}

DatasetView read_vslamlab_view(const fs::path& folder) {
  DatasetView view = {.format = "vslamlab", .folder = folder};
  view.calibration_file = kRigCameras;
  view.poses_file = kTruth;
  view.pictures_file = "rgb_0";
  std::array<ViewCamera, 2> cameras;
  read_or_blame(view, kRigCameras, [&] { cameras = cameras_in(folder / kRigCameras); });
  if (fs::exists(folder / kTruth)) read_or_blame(view, kTruth, [&] { read_truth(view); });
  read_vslamlab_frames(view, cameras);
  view.cannot.push_back(
      "depth, which the layout has not: cameras, baseline and poses were held against corners of "
      "the pictures");
  return view;
}

}  // namespace stereobench::harness
