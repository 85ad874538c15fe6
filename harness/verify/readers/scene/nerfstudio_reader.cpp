#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/io/json_file.h"
#include "harness/verify/readers/reader_tools.h"
#include "harness/verify/readers/scene/picture_pairs.h"
#include "harness/verify/readers/scene/scene_json.h"
#include "harness/verify/readers/scene/scene_readers.h"

namespace stereobench::harness {
namespace {

namespace fs = std::filesystem;
using vision::Side;

constexpr const char* kTransforms = "transforms.json";
constexpr double kDepthLevel_m = 1e-3;

/// A frame of transforms.json.
struct SceneFrame {
  std::string picture, depth;
  Eigen::Matrix4d world_from_camera = Eigen::Matrix4d::Identity();
  ViewCamera camera;
  bool has_camera = false;  ///< one that this program can project by
};

/// A camera's number: of the frame, or else of all frames.
double number_in(const JsonValue& frame, const JsonValue& all, const char* key, double otherwise) {
  return number_or(frame, key, number_or(all, key, otherwise));
}

std::string text_in(const JsonValue& frame, const JsonValue& all, const char* key, const char* otherwise) {
  const auto own = frame.find(key);
  const auto common = own ? own : all.find(key);
  return common && !common->is_null() ? common->text() : otherwise;
}

/// A camera as OpenCV has it. NeRF's own data sets give an angle alone, and the size by the pictures.
void read_camera(const JsonValue& json, const JsonValue& all, SceneFrame& frame) {
  const auto number = [&](const char* key, double otherwise) { return number_in(json, all, key, otherwise); };
  const double width_px = number("w", 0.0), height_px = number("h", 0.0), focal_px = number("fl_x", 0.0);
  const std::string model = text_in(json, all, "camera_model", "OPENCV");
  frame.camera.pinhole = {static_cast<int>(width_px), static_cast<int>(height_px), focal_px,
                          number("cx", 0.5 * width_px) - kFirstPixel_px,
                          number("cy", 0.5 * height_px) - kFirstPixel_px};
  frame.camera.lens = {.k1 = number("k1", 0.0),
                       .k2 = number("k2", 0.0),
                       .p1 = number("p1", 0.0),
                       .p2 = number("p2", 0.0),
                       .k3 = number("k3", 0.0)};
  frame.has_camera = (model == "OPENCV" || model == "PINHOLE" || model == "SIMPLE_PINHOLE") &&
                     focal_px > 0.0 && width_px > 0.0 && number("k4", 0.0) == 0.0;
  if (frame.has_camera) frame.camera.lens.pixel_aspect = number("fl_y", focal_px) / focal_px;
}

SceneFrame frame_of(const JsonValue& json, const JsonValue& all, std::vector<std::string>& digits) {
  SceneFrame frame;
  frame.picture = json.at("file_path").text();
  frame.depth = text_in(json, json, "depth_file_path", "");
  const auto rows = json.at("transform_matrix").list(3, 4);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::vector<double> numbers = numbers_of(rows[row], 4);
    for (std::size_t i = 0; i < 4; ++i)
      frame.world_from_camera(static_cast<int>(row), static_cast<int>(i)) = numbers[i];
    if (row < 3) digits.push_back(fmt::format("{}", numbers[3]));
  }
  // Cameras are in OpenGL's axes.
  frame.world_from_camera.col(1) *= -1.0;
  frame.world_from_camera.col(2) *= -1.0;
  read_camera(json, all, frame);
  return frame;
}

/// A picture's file. NeRF's own data sets leave out the ending.
std::string file_of_picture(const fs::path& folder, const std::string& name) {
  std::string file = fs::path(name).lexically_normal().string();
  if (!fs::exists(folder / file) && fs::exists(folder / (file + ".png"))) file += ".png";
  return file;
}

void add_scene_frames(DatasetView& view, const std::vector<SceneFrame>& frames) {
  std::vector<std::string> names;
  for (const SceneFrame& frame : frames) names.push_back(frame.picture);
  const std::vector<PicturePair> pairs = picture_pairs(names);
  for (const auto& [missing, there] : missing_halves(pairs, names))
    view.faults.push_back({kTransforms, "", fmt::format("missing frame: {} (there is {})", missing, there)});
  for (const PicturePair& pair : pairs) {
    ViewFrame frame = {.name = pair.name};
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const std::size_t i = index_of(side);
      if (!pair.place[i]) continue;
      const SceneFrame& one = frames[*pair.place[i]];
      frame.cameras[i] = one.camera;
      frame.world_from_body[i] = as_rigid(one.world_from_camera);
      const std::string file = file_of_picture(view.folder, one.picture);
      const auto add = [&](Channel channel, const std::string& name, double step) {
        add_channel(view, frame, side, channel, name, step);
        if (!fs::exists(view.folder / name))
          view.faults.push_back({name, pair.name, fmt::format("missing frame: {} lists it", kTransforms)});
      };
      add(Channel::kPicture, file, 0.0);
      const std::string depth = fs::path(one.depth).lexically_normal().string();
      if (depth.ends_with(".png")) add(Channel::kDepth, depth, kDepthLevel_m);
      if (!depth.empty()) view.depth_file = fs::path(depth).parent_path().string();
      view.pictures_file = fs::path(file).parent_path().string();
    }
    view.frames.push_back(std::move(frame));
  }
}

}  // namespace

bool looks_like_nerfstudio(const fs::path& folder) {
  return fs::exists(folder / kTransforms);
}

DatasetView read_nerfstudio_view(const fs::path& folder) {
  constexpr std::size_t kMostFrames = 1'000'000;
  DatasetView view = {.format = "nerfstudio", .folder = folder};
  view.calibration_file = view.poses_file = kTransforms;
  view.poses_of = PosesOf::kEachCamera;
  view.poses_are_a_way = false;
  std::vector<std::string> digits;
  const std::vector<SceneFrame> frames = read_json_file(folder / kTransforms, [&](const JsonValue& json) {
    std::vector<SceneFrame> all;
    for (const JsonValue& frame : json.at("frames").list(1, kMostFrames))
      all.push_back(frame_of(frame, json, digits));
    return all;
  });
  view.place_precision_m = precision_of(digits);
  for (const SceneFrame& frame : frames) {
    view.has_calibration = view.has_calibration && frame.has_camera;
    view.poses.push_back({.file = kTransforms, .line = 0, .stamp_ns = {}});
    view.poses.back().matrix = frame.world_from_camera;
    view.poses.back().name = frame.picture;
  }
  if (!view.has_calibration)
    view.cannot.push_back(
        "depth against poses: cameras without fl_x, w and h, or of a model that is not read");
  add_scene_frames(view, frames);
  if (view.depth_file.empty()) view.cannot.push_back("depth: no frame has a depth_file_path");
  return view;
}

}  // namespace stereobench::harness
