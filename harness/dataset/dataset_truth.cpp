#include "harness/dataset/dataset_truth.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "harness/dataset/formats/plain_format.h"
#include "harness/io/calibration_file.h"
#include "harness/io/file_list.h"
#include "harness/io/number_table.h"
#include "harness/io/picture_reader.h"
#include "harness/io/text_file.h"
#include "harness/json/json_line.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;

std::vector<std::size_t> frames_in(const fs::path& folder) {
  std::vector<std::size_t> frames;
  if (!fs::is_directory(folder)) return frames;  // of a drive all of whose frames were dropped
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string stem = entry.path().stem().string();
    std::size_t frame = 0;
    const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), frame);
    if (entry.path().extension() == ".png" && error == std::errc() && end == stem.data() + stem.size())
      frames.push_back(frame);
  }
  std::sort(frames.begin(), frames.end());
  return frames;
}

cv::Mat read_ids(const fs::path& file, const vision::Intrinsics& camera) {
  const cv::Mat ids = read_levels(file);
  if (ids.type() != CV_8UC1 || ids.cols != camera.width_px || ids.rows != camera.height_px)
    throw std::runtime_error(fmt::format("{}: expected a grey picture of {} x {} pixels", file.string(),
                                         camera.width_px, camera.height_px));
  return ids;
}

std::vector<worlds::Ball> balls_in(const fs::path& file) {
  const NumberTable table = read_csv_table(file, {"ball_id,colour,red,green,blue,x_m,y_m,z_m,radius_m"});
  std::vector<worlds::Ball> balls;
  for (const TableRow& row : table.rows) {
    if (whole_number_in(table, row, 0, 0) != static_cast<int>(balls.size()))
      refuse(table, row, 0, fmt::format("expected {}", balls.size()));
    worlds::Ball ball;
    ball.colour = whole_number_in(table, row, 1, 0);
    ball.paint_rgb =
        Eigen::Vector3d(number_in(table, row, 2), number_in(table, row, 3), number_in(table, row, 4)) / 255.0;
    ball.centre_m = {number_in(table, row, 5), number_in(table, row, 6), number_in(table, row, 7)};
    ball.radius_m = number_in(table, row, 8);
    if (!(ball.radius_m > 0.0)) refuse(table, row, 8, "expected a positive radius");
    balls.push_back(ball);
  }
  if (balls.empty() || balls.size() > 254)
    throw std::runtime_error(fmt::format("{}: expected 1 to 254 balls", file.string()));
  return balls;
}

/// What dataset.json says under a key, where there is one.
void read_finished(const fs::path& folder, const char* key,
                   const std::function<void(const JsonValue&)>& read) {
  const fs::path marker = folder / kDatasetJson;
  if (!fs::exists(marker)) return;
  try {
    const nlohmann::json json = parse_line(read_text(marker));
    if (const auto found = json.find(key); found != json.end()) read(JsonValue(*found, key));
  } catch (const BadLine& bad) {
    throw std::runtime_error(fmt::format("{}: {}", marker.string(), bad.what()));
  }
}

}  // namespace

worlds::World read_balls(const fs::path& folder) {
  worlds::World world;
  world.balls = balls_in(folder / kBallsFile);
  read_finished(folder, kBallSize, [&](const JsonValue& value) {
    constexpr double kLeast_m = 1e-9, kMost_m = 1e9;
    world.usual_radius_m = value.at("radius_m").number(kLeast_m, kMost_m);
    world.ball_radius_sd_m = value.at("radius_sd_m").number(0.0, *world.usual_radius_m);
  });
  return world;
}

std::optional<double> read_rows_within_px(const fs::path& folder) {
  std::optional<double> rows_px;
  read_finished(folder, kRowsWithin, [&](const JsonValue& value) { rows_px = value.number(0.1, 1e4); });
  return rows_px;
}

DatasetTruth read_dataset_truth(const fs::path& folder) {
  if (!fs::exists(folder / kDatasetJson))
    throw std::runtime_error(fmt::format(
        "{}: expected a whole data set of `stereobench render` (it has no dataset.json)", folder.string()));
  DatasetTruth truth;
  truth.world = read_balls(folder);
  truth.rig = read_calibration(folder / kTrueCalibrationFile);
  truth.believed_rig = read_calibration(folder / kCalibrationFile);
  truth.frames = frames_in(folder / picture_folder(vision::Side::kLeft, "id"));
  return truth;
}

renderer::StereoFrame read_ball_ids(const fs::path& folder, std::size_t frame, const vision::StereoRig& rig) {
  const std::string name = fmt::format("{:06}.png", frame);
  renderer::StereoFrame ids;
  ids.left.ball_id = read_ids(folder / picture_folder(vision::Side::kLeft, "id") / name, rig.intrinsics);
  ids.right.ball_id = read_ids(folder / picture_folder(vision::Side::kRight, "id") / name, rig.intrinsics);
  return ids;
}

}  // namespace stereobench::harness
