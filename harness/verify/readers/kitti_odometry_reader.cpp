#include <cmath>

#include <fmt/format.h>

#include "harness/verify/readers/kitti_calibration.h"
#include "harness/verify/readers/kitti_readers.h"
#include "harness/verify/readers/reader_tools.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

std::vector<ViewPose> path_in(DatasetView& view, const std::string& file) {
  std::vector<std::string> columns;
  for (int i = 0; i < 12; ++i) columns.push_back(fmt::format("p{}", i));
  const NumberTable table = read_blank_separated_table(view.folder / file, columns);
  std::vector<ViewPose> path;
  for (const TableRow& row : table.rows) {
    path.push_back({.file = file, .line = row.line, .stamp_ns = {}});
    path.back().matrix = matrix_in(table, row, 0, columns.size());
  }
  for (const std::size_t column : {3U, 7U, 11U})
    view.place_precision_m = std::max(view.place_precision_m, precision_of(table, column, 1));
  // Rows of a rotation that are whole numbers say nothing of how exact the others are.
  for (const std::size_t column : {0U, 4U, 8U})
    if (const double unit = precision_of(table, column, 3); unit > 0.0)
      view.turn_precision = view.turn_precision == 0.0 ? unit : std::min(view.turn_precision, unit);
  return path;
}

/// times.txt in nanoseconds; KITTI writes seconds with an exponent.
std::vector<std::int64_t> times_in(const fs::path& file) {
  constexpr double kNanoseconds = 1e9;
  const NumberTable table = read_blank_separated_table(file, {"t_s"});
  std::vector<std::int64_t> times;
  for (const TableRow& row : table.rows)
    times.push_back(std::llround(kNanoseconds * number_in(table, row, 0)));
  return times;
}

void expect_count(DatasetView& view, const std::string& file, std::size_t got, std::size_t frames) {
  if (got != frames)
    view.faults.push_back(
        {file, "", fmt::format("missing frame: expected {} lines, one a picture (got {})", frames, got)});
}

/// The frames of one sequence: "00".
void read_sequence(DatasetView& view, const std::string& sequence) {
  const std::string folder = fmt::format("sequences/{}/", sequence);
  std::vector<std::string> folders;
  for (int i = 0; i < 4; ++i) folders.push_back(fmt::format("{}image_{}", folder, i));
  const std::set<std::string> names = complete_frames(view, folders, ".png");
  const bool has_colour = fs::exists(view.folder / folders[2]);
  std::array<ViewCamera, 2> cameras;
  const std::string calibration = folder + "calib.txt";
  read_or_blame(view, calibration, [&] {
    const auto numbers = keyed_numbers(view.folder / calibration);
    for (std::size_t i = 0; i < 2; ++i)
      cameras[i] =
          projected_camera(view.folder / calibration, numbers, fmt::format("P{}", i + (has_colour ? 2 : 0)));
  });
  std::vector<std::int64_t> times;
  std::vector<ViewPose> path;
  const std::string times_file = folder + "times.txt", poses_file = fmt::format("poses/{}.txt", sequence);
  if (fs::exists(view.folder / times_file))
    read_or_blame(view, times_file, [&] { times = times_in(view.folder / times_file); });
  if (fs::exists(view.folder / poses_file))
    read_or_blame(view, poses_file, [&] { path = path_in(view, poses_file); });
  if (!times.empty()) expect_count(view, times_file, times.size(), names.size());
  if (!path.empty()) expect_count(view, poses_file, path.size(), names.size());
  for (const std::string& name : names) {
    const std::size_t number = std::strtoul(name.c_str(), nullptr, 10);
    ViewFrame frame = {.name = fmt::format("{}/{}", sequence, name), .cameras = cameras};
    if (number < times.size()) frame.stamp_ns[0] = frame.stamp_ns[1] = times[number];
    if (number < path.size())
      frame.world_from_body[0] = frame.world_from_body[1] = as_rigid(path[number].matrix);
    for (std::size_t i = 0; i < 2; ++i)
      add_channel(view, frame, static_cast<Side>(i), Channel::kPicture,
                  fmt::format("{}/{}.png", folders[i + (has_colour ? 2 : 0)], name));
    view.frames.push_back(std::move(frame));
  }
  if (!view.frames.empty()) view.frames.back().drive_goes_on = false;
  view.poses.insert(view.poses.end(), path.begin(), path.end());
  view.calibration_file = calibration;
  view.poses_file = poses_file;
  view.pictures_file = folders[has_colour ? 2 : 0];
}

}  // namespace

bool looks_like_kitti_odometry(const fs::path& folder) {
  return fs::is_directory(folder / "sequences");
}

DatasetView read_kitti_odometry_view(const fs::path& folder) {
  DatasetView view = {.format = "kitti-odometry", .folder = folder};
  std::set<std::string> sequences;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "sequences"))
    if (entry.is_directory()) sequences.insert(entry.path().filename().string());
  for (const std::string& sequence : sequences) read_sequence(view, sequence);
  view.cannot.push_back(
      "depth, which the layout has not: cameras, baseline and poses were held against corners of "
      "the pictures");
  return view;
}

}  // namespace stereobench::harness
