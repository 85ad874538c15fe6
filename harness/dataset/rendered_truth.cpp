#include "harness/dataset/rendered_truth.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/dataset/ball_lines.h"
#include "harness/dataset/truth_limits.h"
#include "harness/dataset/truth_pictures.h"
#include "harness/io/atomic_file.h"
#include "harness/io/picture_file.h"
#include "renderer/truth/ball_truth.h"
#include "renderer/truth/distorted_ids.h"
#include "worlds/drive/path.h"

namespace stereobench::harness {
namespace {

using renderer::IdBuffer;
using renderer::StereoIdBuffers;
using vision::Side;

const char* name_of(Side side) {
  return side == Side::kLeft ? "left" : "right";
}

const IdBuffer& side_of(const StereoIdBuffers& ids, Side side) {
  return side == Side::kLeft ? ids.left : ids.right;
}

Side other(Side side) {
  return side == Side::kLeft ? Side::kRight : Side::kLeft;
}

bool is_shift(TruthKind kind) {
  return kind == TruthKind::kDisparity || kind == TruthKind::kMatch || kind == TruthKind::kFlow;
}

const char* extension_of(TruthKind kind, TruthFormat format) {
  if (kind == TruthKind::kBalls) return ".jsonl";
  if (kind == TruthKind::kSurface) return ".png";
  return is_shift(kind) && format == TruthFormat::kKitti ? ".png" : ".pfm";
}

std::filesystem::path fate_file(const std::filesystem::path& shift_file) {
  const std::filesystem::path folder = shift_file.parent_path().string() + "_fate";
  return (folder / shift_file.filename()).replace_extension(".png");
}

cv::Mat surface_picture(const cv::Mat& surface) {
  cv::Mat narrow;
  surface.convertTo(narrow, CV_16U);
  return narrow;
}

}  // namespace

/// One camera at one step.
struct RenderedTruth::ImageEvent {
  std::size_t step;
  Side side;
  const cv::Mat& ball_id;
  double late_s;
  renderer::Renderer& renderer;
};

RenderedTruth::RenderedTruth(std::filesystem::path folder, TruthRequest request,
                             const worlds::Scenario& scenario, const worlds::World& world,
                             const renderer::FormReader& read)
    : folder_(std::move(folder)),
      request_(std::move(request)),
      scenario_(scenario),
      world_(world),
      scene_(world, read) {
  require_truth(request_, scenario);
  const std::size_t surfaces =
      static_cast<std::size_t>(renderer::first_mesh_primitive(world)) + world.meshes.size();
  if (wants(TruthKind::kSurface) && surfaces > std::numeric_limits<std::uint16_t>::max())
    throw std::runtime_error(
        fmt::format("--truth surface: {} surfaces are more than 16 bits can number", surfaces));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    for (const TruthKind kind : request_.kinds) {
      const std::filesystem::path path = file(0, side, kind);
      prepare_output_folder(path.parent_path());
      if (is_shift(kind)) prepare_output_folder(fate_file(path).parent_path());
    }
  }
}

bool RenderedTruth::wants(TruthKind kind) const {
  return std::find(request_.kinds.begin(), request_.kinds.end(), kind) != request_.kinds.end();
}

std::filesystem::path RenderedTruth::file(std::size_t step, Side side, TruthKind kind) const {
  return folder_ / fmt::format("{}_{}", name_of(side), harness::name_of(kind)) /
         fmt::format("{:06}{}", step, extension_of(kind, request_.format));
}

bool RenderedTruth::has_all(const ImageEvent& event) const {
  const bool is_last = event.step + 1 == scenario_.path.size();
  return std::all_of(request_.kinds.begin(), request_.kinds.end(), [&](TruthKind kind) {
    const std::filesystem::path path = file(event.step, event.side, kind);
    return (kind == TruthKind::kFlow && is_last) ||
           (std::filesystem::exists(path) && (!is_shift(kind) || std::filesystem::exists(fate_file(path))));
  });
}

void RenderedTruth::write(const FrameEvent& event) {
  buffers_.erase(buffers_.begin(), buffers_.lower_bound(event.step));
  write_side({event.step, Side::kLeft, event.frame.left.ball_id, event.late_s, *event.renderer});
  write_side({event.step, Side::kRight, event.frame.right.ball_id, event.late_s, *event.renderer});
}

StereoIdBuffers RenderedTruth::id_buffers_of(renderer::Renderer& renderer, const RowBand& band,
                                             std::size_t step, double late_s) const {
  const double offset_s = late_s + band.offset_s;
  const slam::Pose left = worlds::pose_near(scenario_.path, step, offset_s);
  const slam::Pose right =
      worlds::pose_near(scenario_.path, step, offset_s + scenario_.shutter.right_delay_s);
  if (scenario_.rig.distortion == vision::Distortion{}) return renderer.id_buffers(left, right, band.rows);
  const StereoIdBuffers undistorted = renderer.id_buffers(left, right);
  return {renderer::distorted_ids(scene_, undistorted.left, scenario_.rig),
          renderer::distorted_ids(scene_, undistorted.right, scenario_.rig)};
}

/// What the cameras look at, by bands of rows; one where all rows look at once.
const std::vector<StereoIdBuffers>& RenderedTruth::id_buffers_at(renderer::Renderer& renderer,
                                                                 std::size_t step, double late_s) {
  const auto [known, is_new] = buffers_.try_emplace(step);
  if (!is_new) return known->second;
  for (const RowBand& band : row_bands(scenario_.shutter, scenario_.rig.intrinsics.height_px))
    known->second.push_back(id_buffers_of(renderer, band, step, late_s));
  return known->second;
}

renderer::PixelTruth RenderedTruth::truth_of(const ImageEvent& event) {
  renderer::PixelTruth whole;
  for (const StereoIdBuffers& band : id_buffers_at(event.renderer, event.step, event.late_s)) {
    const renderer::PixelTruth rows = renderer::pixel_truth(scene_, side_of(band, event.side));
    whole.surface.push_back(rows.surface);
    whole.range_m.push_back(rows.range_m);
    whole.normal.push_back(rows.normal);
  }
  return whole;
}

void RenderedTruth::write_pictures(const ImageEvent& event) {
  const renderer::PixelTruth truth = truth_of(event);
  if (wants(TruthKind::kSurface))
    write_once(file(event.step, event.side, TruthKind::kSurface), surface_picture(truth.surface));
  if (wants(TruthKind::kRange)) write_once(file(event.step, event.side, TruthKind::kRange), truth.range_m);
  if (wants(TruthKind::kNormal))
    write_once(file(event.step, event.side, TruthKind::kNormal), normal_picture(truth.normal));
}

void RenderedTruth::write_side(const ImageEvent& event) {
  if (has_all(event)) return;
  if (wants(TruthKind::kSurface) || wants(TruthKind::kRange) || wants(TruthKind::kNormal))
    write_pictures(event);
  const StereoIdBuffers ids = id_buffers_at(event.renderer, event.step, event.late_s).front();
  if (wants(TruthKind::kBalls)) {
    const auto truths = renderer::ball_truths(world_, side_of(ids, event.side).view, event.ball_id);
    write_file_atomically(file(event.step, event.side, TruthKind::kBalls), ball_lines(world_, truths));
  }
  for (const TruthKind kind : {TruthKind::kDisparity, TruthKind::kMatch})
    if (wants(kind)) write_shift(event, kind, side_of(ids, other(event.side)));
  if (wants(TruthKind::kFlow) && event.step + 1 < scenario_.path.size())
    write_shift(event, TruthKind::kFlow,
                side_of(id_buffers_at(event.renderer, event.step + 1, 0.0).front(), event.side));
}

void RenderedTruth::write_shift(const ImageEvent& event, TruthKind kind, const IdBuffer& to) const {
  const std::filesystem::path path = file(event.step, event.side, kind);
  const renderer::Correspondence found =
      renderer::correspond(scene_, side_of(buffers_.at(event.step).front(), event.side), to);
  const bool kitti = request_.format == TruthFormat::kKitti;
  if (kind == TruthKind::kDisparity) {
    const cv::Mat disparity = renderer::disparity_px(found, event.side);
    write_once(path, kitti ? kitti_disparity(disparity) : disparity);
  } else {
    write_once(path, kitti ? kitti_shift(found) : exact_shift(found));
  }
  write_once(fate_file(path), found.occlusion);
}

void RenderedTruth::finish() const {
  if (wants(TruthKind::kSurface)) write_file_atomically(folder_ / "surfaces.csv", surfaces_csv(world_));
}

}  // namespace stereobench::harness
