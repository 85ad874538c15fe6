#include "harness/dataset/formats/stereobench_format.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/ball_lines.h"
#include "harness/dataset/draws_file.h"
#include "harness/dataset/frames_file.h"
#include "harness/dataset/truth_limits.h"
#include "harness/dataset/truth_pictures.h"
#include "harness/io/calibration_file.h"
#include "harness/logs/measurement_log_writer.h"
#include "renderer/surfaces/primitives.h"

namespace stereobench::harness {
namespace {

using vision::Side;

constexpr std::array kSides = {Side::kLeft, Side::kRight};

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

class StereobenchWriter final : public DatasetWriter {
 public:
  explicit StereobenchWriter(const DatasetDrive& drive);
  std::vector<DatasetFile> frame_files(const FrameEvent& event, FrameTruth& truth) const override;
  std::vector<DatasetFile> drive_files(const MeasurementLog& log) const override;

 private:
  bool wants(TruthKind kind) const;
  /// Whether there is such truth of a step: what leads to the next one is not there for the last one.
  bool has(TruthKind kind, std::size_t step) const;
  void add_truth(TruthKind kind, Side side, std::size_t step, FrameTruth& truth,
                 std::vector<DatasetFile>& files) const;
  void add_shift(TruthKind kind, Side side, std::size_t step, FrameTruth& truth,
                 std::vector<DatasetFile>& files) const;

  DatasetDrive drive_;
};

StereobenchWriter::StereobenchWriter(const DatasetDrive& drive) : drive_(drive) {
  const std::size_t surfaces =
      static_cast<std::size_t>(renderer::first_mesh_primitive(drive.world)) + drive.world.meshes.size();
  if (wants(TruthKind::kSurface) && surfaces > std::numeric_limits<std::uint16_t>::max())
    throw std::runtime_error(
        fmt::format("--truth surface: {} surfaces are more than 16 bits can number", surfaces));
}

bool StereobenchWriter::wants(TruthKind kind) const {
  return std::ranges::find(drive_.truth.kinds, kind) != drive_.truth.kinds.end();
}

bool StereobenchWriter::has(TruthKind kind, std::size_t step) const {
  return kind != TruthKind::kFlow || step + 1 < drive_.scenario.path.size();
}

std::vector<DatasetFile> StereobenchWriter::frame_files(const FrameEvent& event, FrameTruth& truth) const {
  std::vector<DatasetFile> files;
  for (const Side side : kSides) {
    const bool is_left = side == Side::kLeft;
    const renderer::RenderedImage& image = is_left ? event.frame.left : event.frame.right;
    files.push_back(
        picture_file(file_of(side, "", event.step, ".png"), is_left ? event.pair.left : event.pair.right));
    files.push_back(picture_file(file_of(side, "id", event.step, ".png"), image.ball_id));
    files.push_back(picture_file(file_of(side, "depth", event.step, ".pfm"), image.depth_m));
  }
  for (const Side side : kSides)
    for (const TruthKind kind : drive_.truth.kinds)
      if (has(kind, event.step)) add_truth(kind, side, event.step, truth, files);
  return files;
}

void StereobenchWriter::add_truth(TruthKind kind, Side side, std::size_t step, FrameTruth& truth,
                                  std::vector<DatasetFile>& files) const {
  const auto file = [&](const char* extension) { return file_of(side, name_of(kind), step, extension); };
  switch (kind) {
    case TruthKind::kBalls:
      files.push_back(
          {file(".jsonl"), [this, side, &truth] { return ball_lines(drive_.world, truth.balls(side)); }});
      return;
    case TruthKind::kSurface:
      files.push_back(
          picture_file(file(".png"), [side, &truth] { return surface_picture(truth.pixels(side).surface); }));
      return;
    case TruthKind::kRange:
      files.push_back(picture_file(file(".pfm"), [side, &truth] { return truth.pixels(side).range_m; }));
      return;
    case TruthKind::kNormal:
      files.push_back(
          picture_file(file(".pfm"), [side, &truth] { return normal_picture(truth.pixels(side).normal); }));
      return;
    case TruthKind::kDisparity:
    case TruthKind::kMatch:
    case TruthKind::kFlow:
      add_shift(kind, side, step, truth, files);
  }
}

/// Where points are in another picture, and whether they are seen there.
void StereobenchWriter::add_shift(TruthKind kind, Side side, std::size_t step, FrameTruth& truth,
                                  std::vector<DatasetFile>& files) const {
  const TruthFormat format = drive_.truth.format;
  const auto found = [kind, side, &truth]() -> const renderer::Correspondence& {
    return kind == TruthKind::kFlow ? truth.to_next_step(side) : truth.to_other_camera(side);
  };
  const std::string name = name_of(kind);
  files.push_back(picture_file(file_of(side, name, step, format == TruthFormat::kKitti ? ".png" : ".pfm"),
                               [kind, side, format, found] {
                                 return kind == TruthKind::kDisparity
                                            ? disparity_picture(found(), side, format)
                                            : shift_picture(found(), format);
                               }));
  files.push_back(
      picture_file(file_of(side, name + "_fate", step, ".png"), [found] { return found().occlusion; }));
}

std::vector<DatasetFile> StereobenchWriter::drive_files(const MeasurementLog& log) const {
  const worlds::Scenario& scenario = drive_.scenario;
  std::vector<DatasetFile> files = {text_file("frames.csv", frames_csv(scenario, drive_.seed, drive_.frames)),
                                    text_file(kCalibrationFile, calibration_yaml(scenario.believed_rig)),
                                    text_file(kTrueCalibrationFile, calibration_yaml(scenario.rig)),
                                    text_file(kBallsFile, balls_csv(drive_.world))};
  if (wants(TruthKind::kSurface)) files.push_back(text_file("surfaces.csv", surfaces_csv(drive_.world)));
  const std::string draws = draws_jsonl(scenario, std::array{drive_.seed});
  if (!draws.empty()) files.push_back(text_file("draws.jsonl", draws));
  for (LogFile& file : log_files(log)) files.push_back(text_file(std::move(file.name), std::move(file.text)));
  return files;
}

}  // namespace

std::string picture_folder(Side side, std::string_view kind) {
  return fmt::format("{}{}{}", side == Side::kLeft ? "left" : "right", kind.empty() ? "" : "_", kind);
}

void check_stereobench_format(const worlds::Scenario& scenario, const TruthRequest& truth) {
  require_truth(truth, scenario);
}

std::unique_ptr<DatasetWriter> stereobench_writer(const DatasetDrive& drive) {
  return std::make_unique<StereobenchWriter>(drive);
}

}  // namespace stereobench::harness
