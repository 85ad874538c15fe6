#include "harness/verify/readers/tum_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/rig_calibration_file.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr double kLevel_m = 1.0 / 5000.0;
constexpr const char* kPoses = "groundtruth.txt";
constexpr const char* kCalibration = "calibration.yaml";

using Pictures = std::map<std::int64_t, std::string>;

/// The times and names of rgb.txt or depth.txt.
Pictures listed_in(DatasetView& view, const std::string& kind) {
  const std::string list = kind + ".txt";
  const NumberTable table = read_blank_separated_table(view.folder / list, {"timestamp", "filename"});
  std::set<std::string> there = stems_in(view.folder / kind, "");
  Pictures pictures;
  std::int64_t before_ns = std::numeric_limits<std::int64_t>::min();
  for (const TableRow& row : table.rows) {
    const std::int64_t stamp_ns = stamp_ns_in(table, row, 0);
    if (stamp_ns <= before_ns)
      view.faults.push_back(
          {list, row.cells[0],
           fmt::format("line {}: the time is not after that of the line before", row.line)});
    before_ns = stamp_ns;
    if (there.erase(fs::path(row.cells[1]).filename().string()) == 0)
      view.faults.push_back({row.cells[1], row.cells[0], fmt::format("missing frame: {} lists it", list)});
    pictures[stamp_ns] = row.cells[1];
  }
  for (const std::string& name : there)
    view.faults.push_back({fmt::format("{}/{}", kind, name), "",
                           fmt::format("missing frame in {}: it does not list this picture", list)});
  return pictures;
}

void read_poses(DatasetView& view) {
  const NumberTable table = read_blank_separated_table(
      view.folder / kPoses, {"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"});
  for (const TableRow& row : table.rows) {
    ViewPose pose = pose_in(table, row, 1, false);
    pose.file = kPoses;
    pose.stamp_ns = stamp_ns_in(table, row, 0);
    view.poses.push_back(pose);
  }
  view.place_precision_m = precision_of(table, 1, 3);
  view.turn_precision = precision_of(table, 4, 4);
}

/// The file of the nearest time; TUM's tools take those within 20 ms for the same instant.
const std::string* nearest(const Pictures& pictures, std::int64_t stamp_ns) {
  constexpr std::int64_t kSame_ns = 20'000'000;
  const auto after = pictures.lower_bound(stamp_ns);
  const std::string* best = nullptr;
  std::int64_t best_ns = kSame_ns;
  for (auto one : {after, after == pictures.begin() ? after : std::prev(after)})
    if (one != pictures.end() && std::abs(one->first - stamp_ns) < best_ns)
      best = &one->second, best_ns = std::abs(one->first - stamp_ns);
  return best;
}

}  // namespace

bool looks_like_tum(const fs::path& folder) {
  return fs::exists(folder / "rgb.txt") && fs::is_directory(folder / "rgb");
}

DatasetView read_tum_view(const fs::path& folder) {
  DatasetView view = {.format = "tum", .folder = folder};
  view.poses_file = kPoses;
  view.depth_file = "depth";
  view.pictures_file = "rgb";
  std::array<ViewCamera, 2> cameras;
  view.has_calibration = fs::exists(folder / kCalibration);
  if (view.has_calibration)
    read_or_blame(view, kCalibration, [&] {
      view.calibration_file = kCalibration;
      cameras = read_rig_cameras(view, kCalibration);
      cameras[1].body_from_camera = cameras[0].body_from_camera.inverse() * cameras[1].body_from_camera;
      cameras[0].body_from_camera = Eigen::Isometry3d::Identity();
    });
  else
    view.cannot.push_back(
        "depth against poses: the layout has no calibration, and there is no calibration.yaml");
  if (fs::exists(folder / kPoses)) read_or_blame(view, kPoses, [&] { read_poses(view); });
  const Pictures pictures = listed_in(view, "rgb");
  const Pictures depths = fs::exists(folder / "depth.txt") ? listed_in(view, "depth") : Pictures();
  for (const auto& [stamp_ns, file] : pictures) {
    ViewFrame frame = {
        .name = fs::path(file).stem().string(), .stamp_ns = {stamp_ns, {}}, .cameras = cameras};
    frame.world_from_body[0] = pose_at(view.poses, stamp_ns);
    add_channel(view, frame, Side::kLeft, Channel::kPicture, file);
    const std::string* depth = nearest(depths, stamp_ns);
    if (depth != nullptr) add_channel(view, frame, Side::kLeft, Channel::kDepth, *depth, kLevel_m);
    if (depth == nullptr && !depths.empty())
      view.faults.push_back(
          {"depth.txt", frame.name, "missing frame: no depth within 20 ms of this picture"});
    view.frames.push_back(std::move(frame));
  }
  return view;
}

}  // namespace stereobench::harness
