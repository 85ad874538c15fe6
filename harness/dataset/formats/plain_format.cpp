#include "harness/dataset/formats/plain_format.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/truth/ball_lines.h"
#include "harness/dataset/truth/truth_limits.h"
#include "harness/dataset/truth/truth_pictures.h"
#include "harness/io/calibration_file.h"
#include "harness/logs/measurement_log_writer.h"
#include "renderer/surfaces/primitives.h"

namespace stereobench::harness {
namespace {

using vision::Side;

std::string file_of(Side side, std::string_view kind, std::size_t step, std::string_view extension) {
  return fmt::format("{}/{:06}{}", picture_folder(side, kind), step, extension);
}

cv::Mat surface_picture(const cv::Mat& surface) {
  cv::Mat narrow;
  surface.convertTo(narrow, CV_16U);
  return narrow;
}

cv::Mat disparity_picture(const renderer::Correspondence& found, Side side, TruthFormat format) {
  const cv::Mat disparity = renderer::disparity_px(found, side);
  return format == TruthFormat::kKitti ? kitti_disparity(disparity) : disparity;
}

cv::Mat shift_picture(const renderer::Correspondence& found, TruthFormat format) {
  return format == TruthFormat::kKitti ? kitti_shift(found) : exact_shift(found);
}

class PlainWriter final : public DatasetWriter {
 public:
  explicit PlainWriter(const DatasetDrive& drive);
  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override;
  std::vector<DatasetFile> drive_files(const MeasurementLog& log) const override;

 private:
  bool wants(TruthKind kind) const;
  /// Whether there is such truth of a step: what leads to the next one is not there for the last one.
  bool has(TruthKind kind, std::size_t step) const;
  void add_truth(TruthKind kind, Side side, DatasetPair& pair, std::vector<DatasetFile>& files) const;
  void add_shift(TruthKind kind, Side side, DatasetPair& pair, std::vector<DatasetFile>& files) const;

  const DatasetDrive& drive_;
};

PlainWriter::PlainWriter(const DatasetDrive& drive) : drive_(drive) {
  const std::size_t surfaces =
      static_cast<std::size_t>(renderer::first_mesh_primitive(drive.world)) + drive.world.meshes.size();
  if (wants(TruthKind::kSurface) && surfaces > std::numeric_limits<std::uint16_t>::max())
    throw std::runtime_error(
        fmt::format("--truth surface: {} surfaces are more than 16 bits can number", surfaces));
}

bool PlainWriter::wants(TruthKind kind) const {
  return std::ranges::find(drive_.truth.kinds, kind) != drive_.truth.kinds.end();
}

bool PlainWriter::has(TruthKind kind, std::size_t step) const {
  return kind != TruthKind::kFlow || step + 1 < drive_.steps.size();
}

std::vector<DatasetFile> PlainWriter::frame_files(DatasetPair& pair) const {
  std::vector<DatasetFile> files;
  for (const Side side : kBothSides) {
    files.push_back(camera_file(file_of(side, "", pair.step(), ".png"), pair, side));
    files.push_back(
        picture_file(file_of(side, "id", pair.step(), ".png"), [side, &pair] { return pair.ball_id(side); }));
    files.push_back(picture_file(file_of(side, "depth", pair.step(), float_extension(drive_.truth.format)),
                                 [side, &pair] { return pair.depth_m(side); }));
  }
  for (const Side side : kBothSides)
    for (const TruthKind kind : drive_.truth.kinds)
      if (has(kind, pair.step())) add_truth(kind, side, pair, files);
  return files;
}

void PlainWriter::add_truth(TruthKind kind, Side side, DatasetPair& pair,
                            std::vector<DatasetFile>& files) const {
  const char* const floats = float_extension(drive_.truth.format);
  const auto file = [&](const char* extension) {
    return file_of(side, name_of(kind), pair.step(), extension);
  };
  switch (kind) {
    case TruthKind::kBalls:
      files.push_back(
          {file(".jsonl"), [this, side, &pair] { return ball_lines(drive_.world, pair.balls(side)); }});
      return;
    case TruthKind::kSurface:
      files.push_back(
          picture_file(file(".png"), [side, &pair] { return surface_picture(pair.pixels(side).surface); }));
      return;
    case TruthKind::kRange:
      files.push_back(picture_file(file(floats), [side, &pair] { return pair.pixels(side).range_m; }));
      return;
    case TruthKind::kNormal:
      files.push_back(
          picture_file(file(floats), [side, &pair] { return normal_picture(pair.pixels(side).normal); }));
      return;
    case TruthKind::kDisparity:
    case TruthKind::kMatch:
    case TruthKind::kFlow:
      add_shift(kind, side, pair, files);
  }
}

/// Where points are in another picture, and whether they are seen there.
void PlainWriter::add_shift(TruthKind kind, Side side, DatasetPair& pair,
                            std::vector<DatasetFile>& files) const {
  const TruthFormat format = drive_.truth.format;
  const auto found = [kind, side, &pair]() -> const renderer::Correspondence& {
    return kind == TruthKind::kFlow ? pair.to_next_step(side) : pair.to_other_camera(side);
  };
  const std::string name = name_of(kind);
  files.push_back(picture_file(
      file_of(side, name, pair.step(), format == TruthFormat::kKitti ? ".png" : float_extension(format)),
      [kind, side, format, found] {
        return kind == TruthKind::kDisparity ? disparity_picture(found(), side, format)
                                             : shift_picture(found(), format);
      }));
  files.push_back(picture_file(file_of(side, name + "_fate", pair.step(), ".png"),
                               [found] { return found().occlusion; }));
}

std::vector<DatasetFile> PlainWriter::drive_files(const MeasurementLog& log) const {
  std::vector<DatasetFile> files = {text_file(kFramesFile, frames_csv(drive_)),
                                    text_file(kCalibrationFile, calibration_yaml(drive_.believed_rig)),
                                    text_file(kTrueCalibrationFile, calibration_yaml(drive_.rig)),
                                    text_file(kBallsFile, balls_csv(drive_.world))};
  if (wants(TruthKind::kSurface)) files.push_back(text_file("surfaces.csv", surfaces_csv(drive_.world)));
  if (!drive_.draws.empty()) files.push_back(text_file("draws.jsonl", drive_.draws));
  for (LogFile& file : log_files(log)) files.push_back(text_file(std::move(file.name), std::move(file.text)));
  return files;
}

}  // namespace

std::string picture_folder(Side side, std::string_view kind) {
  return fmt::format("{}{}{}", side == Side::kLeft ? "left" : "right", kind.empty() ? "" : "_", kind);
}

void check_plain_format(const DatasetDrive& drive) {
  require_truth(drive.truth, drive.rig, drive.shutter);
}

std::unique_ptr<DatasetWriter> plain_writer(const DatasetDrive& drive) {
  return std::make_unique<PlainWriter>(drive);
}

}  // namespace stereobench::harness
