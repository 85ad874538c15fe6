#include "harness/verify/readers/euroc_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/yaml_numbers.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr std::array kCameras = {"mav0/cam0", "mav0/cam1"};
constexpr const char* kStates = "mav0/state_groundtruth_estimate0/data.csv";

ViewCamera camera_in(const fs::path& file) {
  const YAML::Node yaml = yaml_in(file);
  require_word(file, yaml, "camera_model", "pinhole");
  require_word(file, yaml, "distortion_model", "radial-tangential");
  const std::vector<double> size = numbers_in(file, yaml, "resolution", 2);
  const std::vector<double> pinhole = numbers_in(file, yaml, "intrinsics", 4);
  const std::vector<double> lens = numbers_in(file, yaml, "distortion_coefficients", 4);
  ViewCamera camera;
  camera.pinhole = {static_cast<int>(size[0]), static_cast<int>(size[1]), pinhole[0], pinhole[2], pinhole[3]};
  camera.lens = {.k1 = lens[0], .k2 = lens[1], .p1 = lens[2], .p2 = lens[3]};
  camera.lens.pixel_aspect = pinhole[1] / pinhole[0];
  camera.body_from_camera = transform_in(file, yaml, "T_BS");
  return camera;
}

/// The times and names of a camera's pictures.
std::map<std::int64_t, std::string> pictures_in(DatasetView& view, const std::string& camera) {
  const std::string list = camera + "/data.csv";
  const NumberTable table = read_comma_separated_table(view.folder / list, {"timestamp", "filename"});
  std::map<std::int64_t, std::string> pictures;
  std::int64_t before_ns = std::numeric_limits<std::int64_t>::min();
  std::set<std::string> there = stems_in(view.folder / camera / "data", "");
  for (const TableRow& row : table.rows) {
    const std::int64_t stamp_ns = nanoseconds_in(table, row, 0);
    if (stamp_ns <= before_ns)
      view.faults.push_back(
          {list, row.cells[0],
           fmt::format("line {}: the time is not after that of the line before", row.line)});
    before_ns = stamp_ns;
    const std::string file = fmt::format("{}/data/{}", camera, row.cells[1]);
    if (there.erase(row.cells[1]) == 0)
      view.faults.push_back({file, row.cells[0], fmt::format("missing frame: {} lists it", list)});
    pictures[stamp_ns] = file;
  }
  for (const std::string& name : there)
    view.faults.push_back({fmt::format("{}/data/{}", camera, name), "",
                           fmt::format("missing frame in {}: it does not list this picture", list)});
  return pictures;
}

void read_states(DatasetView& view) {
  constexpr std::size_t kPlace = 1, kTurn = 4;
  const NumberTable table =
      read_comma_separated_table(view.folder / kStates, {"timestamp", "x", "y", "z", "qw", "qx", "qy", "qz"});
  for (const TableRow& row : table.rows) {
    ViewPose pose = pose_in(table, row, kPlace, true);
    pose.file = kStates;
    pose.stamp_ns = nanoseconds_in(table, row, 0);
    view.poses.push_back(pose);
  }
  view.place_precision_m = precision_of(table, kPlace, 3);
  view.turn_precision = precision_of(table, kTurn, 4);
}

void read_euroc_frames(DatasetView& view, const std::array<ViewCamera, 2>& cameras) {
  std::array<std::map<std::int64_t, std::string>, 2> pictures;
  for (std::size_t i = 0; i < 2; ++i)
    if (fs::exists(view.folder / kCameras[i])) pictures[i] = pictures_in(view, kCameras[i]);
  for (const auto& [stamp_ns, file] : pictures[0]) {
    ViewFrame frame = {.name = fmt::format("{}", stamp_ns), .stamp_ns = {stamp_ns, {}}, .cameras = cameras};
    frame.world_from_body[0] = frame.world_from_body[1] = pose_at(view.poses, stamp_ns);
    add_channel(view, frame, Side::kLeft, Channel::kPicture, file);
    const auto right = pictures[1].find(stamp_ns);
    if (right != pictures[1].end())
      add_channel(view, frame, Side::kRight, Channel::kPicture, right->second);
    else if (!pictures[1].empty())
      view.faults.push_back(
          {"mav0/cam1/data.csv", frame.name, "missing frame: mav0/cam0 has a picture of this time"});
    view.frames.push_back(std::move(frame));
  }
  for (const auto& [stamp_ns, file] : pictures[1])
    if (!pictures[0].contains(stamp_ns))
      view.faults.push_back({"mav0/cam0/data.csv", fmt::format("{}", stamp_ns),
                             "missing frame: mav0/cam1 has a picture of this time"});
}

}  // namespace

bool looks_like_euroc(const fs::path& folder) {
  return fs::exists(folder / "mav0/cam0/data.csv");
}

DatasetView read_euroc_view(const fs::path& folder) {
  DatasetView view = {.format = "euroc", .folder = folder};
  view.calibration_file = "mav0/cam0/sensor.yaml, mav0/cam1/sensor.yaml";
  view.poses_file = kStates;
  view.pictures_file = "mav0/cam0/data";
  view.poses_of = PosesOf::kBody;
  std::array<ViewCamera, 2> cameras;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string file = std::string(kCameras[i]) + "/sensor.yaml";
    if (fs::exists(folder / kCameras[i]))
      read_or_blame(view, file, [&] { cameras[i] = camera_in(folder / file); });
  }
  if (fs::exists(folder / kStates)) read_or_blame(view, kStates, [&] { read_states(view); });
  read_euroc_frames(view, cameras);
  view.cannot.push_back(
      "depth, which the layout has not: cameras, baseline and poses were held against corners of "
      "the pictures");
  return view;
}

}  // namespace stereobench::harness
