#include "harness/verify/readers/plain_reader.h"

#include <charconv>
#include <sstream>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/dataset_pair.h"
#include "harness/dataset/dataset_truth.h"
#include "harness/dataset/formats/plain_format.h"
#include "harness/io/file_list.h"
#include "harness/io/json_file.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/rig_calibration_file.h"
#include "harness/verify/readers/scene/scene_json.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr double kKittiDisparity_px = 1.0 / 256.0, kKittiShift_px = 1.0 / 64.0;

template <int Size>
Eigen::Matrix<double, Size, 1> vector_in(const JsonValue& value) {
  constexpr double kMost = 1e9;
  Eigen::Matrix<double, Size, 1> vector;
  const auto numbers = value.list(Size, Size);
  for (int i = 0; i < Size; ++i) vector[i] = numbers[static_cast<std::size_t>(i)].number(-kMost, kMost);
  return vector;
}

ViewBallTruth ball_in(const std::string& line) {
  constexpr std::int64_t kMost = std::int64_t{1} << 40;
  const nlohmann::json json = parse_line(line);
  const JsonValue value(json, "");
  const auto share = value.find("visib_fract");
  return {.ball = static_cast<int>(value.at("ball_id").integer(0, 1 << 20)),
          .centre_px = vector_in<2>(value.at("centre_px")),
          .centre_in_camera_m = vector_in<3>(value.at("centre_in_camera_m")),
          .bbox_visib = box_in(value.at("bbox_visib")),
          .px_count_visib = value.at("px_count_visib").integer(0, kMost),
          .px_count_all = value.at("px_count_all").integer(0, kMost),
          .visib_fract = share ? std::optional(share->number(0.0, 1.0)) : std::nullopt};
}

void read_balls_of(DatasetView& view, ViewFrame& frame, Side side) {
  const std::string name = fmt::format("{}/{}.jsonl", picture_folder(side, "balls"), frame.name);
  if (!fs::exists(view.folder / name)) return;
  BallsFile file = {.file = name, .balls = {}};
  std::istringstream lines(read_text(view.folder / name));
  long number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    try {
      file.balls.push_back(ball_in(line));
    } catch (const BadLine& error) {
      view.faults.push_back({name, frame.name, fmt::format("line {}: {}", number, error.what())});
    }
  }
  frame.balls[index_of(side)] = std::move(file);
}

void add_files(DatasetView& view, ViewFrame& frame) {
  const auto add = [&](Side side, Channel channel, const char* kind, const char* ending, double step = 0.0) {
    add_channel(view, frame, side, channel,
                fmt::format("{}/{}{}", picture_folder(side, kind), frame.name, ending), step);
  };
  for (const Side side : kBothSides) {
    add(side, Channel::kPicture, "", ".png");
    add(side, Channel::kBallId, "id", ".png");
    add(side, Channel::kDisparity, "disparity", ".png", kKittiDisparity_px);
    add(side, Channel::kFlow, "flow", ".png", kKittiShift_px);
    for (const char* floats : {".pfm", ".tiff"}) {
      add(side, Channel::kDepth, "depth", floats);
      add(side, Channel::kRange, "range", floats);
      add(side, Channel::kDisparity, "disparity", floats);
      add(side, Channel::kFlow, "flow", floats);
    }
    read_balls_of(view, frame, side);
  }
}

Eigen::Isometry3d robot_at(const NumberTable& table, const TableRow& row, std::size_t column) {
  return world_from_robot(
      {number_in(table, row, column), number_in(table, row, column + 1), number_in(table, row, column + 2)});
}

/// The frames of frames.csv that have pictures.
void read_plain_frames(DatasetView& view, const std::array<ViewCamera, 2>& cameras) {
  const NumberTable table = read_csv_table(view.folder / kFramesFile, {kFramesHeader});
  int last_step = -1;
  for (const TableRow& row : table.rows) {
    const int step = whole_number_in(table, row, 0, 0);
    if (step != last_step + 1)
      view.faults.push_back(
          {kFramesFile, fmt::format("{:06}", step),
           fmt::format("line {}: missing frame: expected step {}", row.line, last_step + 1)});
    last_step = step;
    if (whole_number_in(table, row, 2, 0) == 0) continue;
    ViewFrame frame = {.name = fmt::format("{:06}", step), .cameras = cameras};
    const std::int64_t stamp_ns = stamp_ns_in(table, row, 1);
    frame.stamp_ns = {stamp_ns, stamp_ns};
    frame.world_from_body = {robot_at(table, row, 4), robot_at(table, row, 7)};
    ViewPose pose = {.file = kFramesFile, .line = row.line, .stamp_ns = stamp_ns};
    pose.matrix = frame.world_from_body[0]->matrix();
    view.poses.push_back(pose);
    add_files(view, frame);
    view.frames.push_back(std::move(frame));
  }
  for (std::size_t i = 0; i + 1 < view.frames.size(); ++i)
    view.frames[i].next_follows = std::stoi(view.frames[i].name) + 1 == std::stoi(view.frames[i + 1].name);
}

/// What is missing of pictures, beside each other and beside frames.csv.
void find_missing(DatasetView& view) {
  std::vector<std::string> folders;
  for (const char* kind : {"", "id", "depth"})
    for (const Side side : kBothSides) folders.push_back(picture_folder(side, kind));
  std::set<std::string> there = complete_frames(view, {folders.begin(), folders.begin() + 4}, ".png");
  for (const std::vector<std::string>& pair : {std::vector<std::string>{"left_depth", "right_depth"},
                                               {"left_disparity", "right_disparity"},
                                               {"left_range", "right_range"},
                                               {"left_flow", "right_flow"}})
    for (const char* floats : {".pfm", ".tiff"}) complete_frames(view, pair, floats);
  for (const ViewFrame& frame : view.frames)
    if (there.erase(frame.name) == 0)
      view.faults.push_back({fmt::format("left/{}.png", frame.name), frame.name,
                             fmt::format("missing frame: {} says that it has pictures", kFramesFile)});
  for (const std::string& name : there)
    view.faults.push_back({kFramesFile, name, "missing frame: there are pictures, and no line that says so"});
}

}  // namespace

bool looks_plain(const fs::path& folder) {
  return fs::exists(folder / kFramesFile) && fs::is_directory(folder / picture_folder(Side::kLeft));
}

DatasetView read_plain_view(const fs::path& folder) {
  DatasetView view = {.format = "plain", .folder = folder};
  view.calibration_file = fs::exists(folder / kTrueCalibrationFile) ? kTrueCalibrationFile : kCalibrationFile;
  view.poses_file = kFramesFile;
  view.depth_file = picture_folder(Side::kLeft, "depth");
  view.pictures_file = picture_folder(Side::kLeft);
  view.poses_of = PosesOf::kBody;
  read_or_blame(view, kDatasetJson,
                [&] { view.rows_look_apart = said_of_shutter(folder, "readout_s") != 0.0; });
  const std::array<ViewCamera, 2> cameras = read_rig_cameras(view, view.calibration_file);
  read_or_blame(view, kBallsFile, [&] {
    for (const worlds::Ball& ball : read_balls(folder).balls)
      view.balls.push_back({ball.centre_m, ball.radius_m});
  });
  read_plain_frames(view, cameras);
  find_missing(view);
  if (view.rows_look_apart)
    view.cannot.push_back("rows of a rolling shutter against poses, which hold for one row");
  if (view.frames.empty() || find_channel(view.frames.front(), Side::kLeft, Channel::kDisparity) == nullptr)
    view.cannot.push_back("disparity: it was not rendered");
  return view;
}

}  // namespace stereobench::harness
