#include "harness/dataset/plain_dataset.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/dataset_truth.h"
#include "harness/dataset/drive_json.h"
#include "harness/dataset/formats/plain_format.h"
#include "harness/dataset/pictures/picture_change.h"
#include "harness/dataset/truth/ball_lines.h"
#include "harness/io/file_list.h"
#include "harness/io/float_picture.h"
#include "harness/io/json_file.h"
#include "harness/io/number_table.h"
#include "harness/io/picture_reader.h"
#include "harness/io/text_file.h"
#include "harness/logs/measurement_log_reader.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using renderer::Correspondence;
using vision::Side;

/// Takes from dataset.json what the tables do not say.
void read_marker(const JsonValue& json, DatasetDrive& drive) {
  if (const auto format = json.find("format"))
    format->refuse("none: it is exported from the format plain alone");
  drive.seed = json.at("seed").natural_number();
  read_drive(json.at(kDrive), drive);
  if (const auto kinds = json.find("truth"))
    for (const JsonValue& kind : kinds->list(0, 100)) {
      const auto known = parse_truth(kind.text());
      drive.truth.kinds.insert(drive.truth.kinds.end(), known.begin(), known.end());
    }
  if (const auto pictures = json.find(kPictures))
    if (const auto kind = pictures->find("kind")) drive.picture_kind = parse_picture_kind(kind->text());
  if (const auto format = json.find("truth_format")) drive.truth.format = parse_truth_format(format->text());
}

slam::Pose pose_in(const NumberTable& table, const TableRow& row, std::size_t column) {
  return {number_in(table, row, column), number_in(table, row, column + 1),
          number_in(table, row, column + 2)};
}

std::vector<DriveStep> steps_in(const fs::path& file, const MeasurementLog& log) {
  const NumberTable table = read_csv_table(file, {kFramesHeader});
  std::vector<DriveStep> steps;
  for (const TableRow& row : table.rows) {
    if (whole_number_in(table, row, 0, 0) != static_cast<int>(steps.size()))
      refuse(table, row, 0, fmt::format("expected {}", steps.size()));
    const std::int64_t stamp_ns = stamp_ns_in(table, row, 1);
    if (steps.size() >= log.steps.size() || log.steps[steps.size()].stamp_ns != stamp_ns ||
        !log.steps[steps.size()].truth)
      refuse(table, row, 1, "expected a step of instants.csv whose pose is in groundtruth.csv");
    DriveStep step = {stamp_ns, *log.steps[steps.size()].truth, {}};
    if (whole_number_in(table, row, 2, 0) != 0)
      step.pictures = TakenPictures{number_in(table, row, 3), pose_in(table, row, 4), pose_in(table, row, 7)};
    steps.push_back(step);
  }
  return steps;
}

}  // namespace

PlainDataset read_plain_dataset(const fs::path& folder) {
  if (!fs::exists(folder / kManifest))
    throw std::runtime_error(fmt::format(
        "{}: expected a whole data set of `stereobench render` (it has no {}: it is not finished, "
        "or of an older version); render it again",
        folder.string(), kManifest));
  PlainDataset dataset = {.folder = folder, .drive = {}, .log = {}};
  read_json_file(folder / kDatasetJson, [&](const JsonValue& json) { read_marker(json, dataset.drive); });
  dataset.log = read_log(folder, {.odometry_delay_s = 0.0}).log;
  dataset.drive.world = read_balls(folder);
  dataset.drive.steps = steps_in(folder / kFramesFile, dataset.log);
  if (fs::exists(folder / "draws.jsonl")) dataset.drive.draws = read_text(folder / "draws.jsonl");
  return dataset;
}

void require_exact_truth(const PlainDataset& dataset, TruthKind kind) {
  const TruthRequest& has = dataset.drive.truth;
  const bool is_exact = has.format != TruthFormat::kKitti || kind == TruthKind::kBalls;
  if (std::ranges::count(has.kinds, kind) == 0 || !is_exact)
    throw std::runtime_error(fmt::format("{}: has no {} in the format exact; render it with --truth {}",
                                         dataset.folder.string(), name_of(kind), name_of(kind)));
}

fs::path PlainPair::file(Side side, std::string_view kind, std::string_view extension) const {
  return dataset_.folder / picture_folder(side, kind) / fmt::format("{:06}{}", step_, extension);
}

fs::path PlainPair::truth_file(Side side, TruthKind kind, std::string_view extension) const {
  require_exact_truth(dataset_, kind);
  return file(side, name_of(kind), extension);
}

cv::Mat PlainPair::sized(const fs::path& file, cv::Mat picture, int type) const {
  const vision::Intrinsics& camera = dataset_.drive.rig.intrinsics;
  if (picture.type() != type || picture.cols != camera.width_px || picture.rows != camera.height_px)
    throw std::runtime_error(fmt::format("{}: expected a picture of {} x {} pixels and {} channels",
                                         file.string(), camera.width_px, camera.height_px, CV_MAT_CN(type)));
  return picture;
}

std::optional<fs::path> PlainPair::file_of(Side side) const {
  return file(side, "", ".png");
}

cv::Mat PlainPair::picture(Side side) {
  const fs::path picture = file(side, "", ".png");
  return sized(picture, read_exact_png(picture), type_of(dataset_.drive.picture_kind));
}

cv::Mat PlainPair::ball_id(Side side) {
  const fs::path ids = file(side, "id", ".png");
  return sized(ids, read_levels(ids), CV_8UC1);
}

cv::Mat PlainPair::depth_m(Side side) {
  const fs::path depth = file(side, "depth", float_extension(dataset_.drive.truth.format));
  return sized(depth, read_float_picture(depth), CV_32FC1);
}

const renderer::PixelTruth& PlainPair::pixels(Side) {
  throw std::runtime_error(
      fmt::format("{}: surfaces, ranges and normals are not read from data sets", dataset_.folder.string()));
}

std::vector<renderer::BallTruth> PlainPair::balls(Side side) {
  const fs::path lines = truth_file(side, TruthKind::kBalls, ".jsonl");
  return parse_ball_lines(read_text(lines), dataset_.drive.world.balls.size(), lines.string());
}

const Correspondence& PlainPair::to_other_camera(Side side) {
  std::optional<Correspondence>& known = to_other_camera_[static_cast<std::size_t>(side)];
  if (!known) {
    const fs::path disparity =
        truth_file(side, TruthKind::kDisparity, float_extension(dataset_.drive.truth.format));
    const cv::Mat px = sized(disparity, read_float_picture(disparity), CV_32FC1);
    known = with_occlusion(side, TruthKind::kDisparity,
                           {side == Side::kLeft ? cv::Mat(-px) : px, cv::Mat::zeros(px.size(), CV_32FC1)});
  }
  return *known;
}

const Correspondence& PlainPair::to_next_step(Side side) {
  std::optional<Correspondence>& known = to_next_step_[static_cast<std::size_t>(side)];
  if (!known) {
    const fs::path flow = truth_file(side, TruthKind::kFlow, float_extension(dataset_.drive.truth.format));
    std::vector<cv::Mat> bgr;
    cv::split(sized(flow, read_float_picture(flow), CV_32FC3), bgr);
    known = with_occlusion(side, TruthKind::kFlow, {bgr[2], bgr[1]});
  }
  return *known;
}

/// @param shift_px columns and rows; not finite for none
Correspondence PlainPair::with_occlusion(Side side, TruthKind kind,
                                         const std::vector<cv::Mat>& shift_px) const {
  const fs::path mask = file(side, name_of(kind) + std::string("_fate"), ".png");
  Correspondence found = {.shift_px = {}, .occlusion = sized(mask, read_levels(mask), CV_8UC1)};
  cv::merge(shift_px, found.shift_px);
  found.shift_px.setTo(cv::Scalar::all(std::numeric_limits<double>::infinity()),
                       found.occlusion == static_cast<std::uint8_t>(renderer::Occlusion::kNothing));
  return found;
}

}  // namespace stereobench::harness
