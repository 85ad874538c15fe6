#include "harness/dataset/rendered_dataset.h"

#include <array>
#include <charconv>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/core.hpp>

#include "harness/io/atomic_file.h"
#include "harness/io/calibration_file.h"
#include "harness/io/file_list.h"
#include "harness/io/json_line.h"
#include "harness/io/picture_file.h"
#include "harness/io/text_file.h"
#include "harness/logs/measurement_log_writer.h"
#include "worlds/generate/paint.h"

namespace stereobench::harness {
namespace {

/// The folder's marker while frames are still being written.
constexpr const char* kUnfinished = "dataset.unfinished.json";

/// The finished data set's key that lists the frames it has pictures of.
constexpr const char* kFrames = "frames";

/// And the one that says how coarse their motion blur is.
constexpr const char* kBlur = "blur";

/// The markers that there are.
std::vector<std::filesystem::path> markers_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> markers;
  for (const char* marker : {kFinishedDataset, kUnfinished})
    if (std::filesystem::exists(folder / marker)) markers.push_back(folder / marker);
  return markers;
}

/// What a marker says.
nlohmann::json read_marker(const std::filesystem::path& path) {
  try {
    nlohmann::json told = parse_line(read_text(path));
    if (told.is_object()) return told;
  } catch (const BadLine&) {
  }
  throw std::runtime_error(
      fmt::format("{}: is not what `render` writes; choose another folder or remove it", path.string()));
}

/// Whether something of a data set lies in a folder.
bool holds_files(const std::filesystem::path& folder) {
  return std::filesystem::is_directory(folder) && !product_names(folder).empty();
}

/// The keys that one of two objects has not, or with another value.
std::vector<std::string> differing_keys(const nlohmann::json& one, const nlohmann::json& other) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : one.items())
    if (!other.contains(key) || other[key] != value) keys.push_back(key);
  for (const auto& [key, value] : other.items())
    if (!one.contains(key)) keys.push_back(key);
  return keys;
}

/// The frames whose left picture is among the files.
std::vector<std::size_t> frames_among(const std::vector<std::string>& names) {
  std::vector<std::size_t> frames;
  for (const std::string& name : names) {
    std::size_t frame = 0;
    if (name.starts_with("left/") &&
        std::from_chars(name.data() + 5, name.data() + name.size(), frame).ec == std::errc())
      frames.push_back(frame);
  }
  return frames;
}

}  // namespace

bool holds_rendering(const std::filesystem::path& folder) {
  return !markers_in(folder).empty() && holds_files(folder);
}

void require_same_rendering(const std::filesystem::path& folder, const nlohmann::ordered_json& identity) {
  if (!std::filesystem::exists(folder / kFinishedDataset) && !holds_files(folder)) return;
  for (const std::filesystem::path& marker : markers_in(folder)) {
    nlohmann::json told = read_marker(marker);
    for (const char* outcome : {kFiles, kFrames, kBlur}) told.erase(outcome);
    const auto differing = differing_keys(told, parse_line(identity.dump()));
    if (!differing.empty())
      throw std::runtime_error(
          fmt::format("{}: holds a data set of another {}; choose another folder or remove it",
                      marker.string(), fmt::join(differing, ", ")));
  }
}

RenderedDataset::RenderedDataset(std::filesystem::path folder, nlohmann::ordered_json identity)
    : folder_(std::move(folder)), identity_(std::move(identity)) {
  if (std::filesystem::exists(folder_)) prepare_output_folder(folder_);
  require_same_rendering(folder_, identity_);
  is_finished_ = std::filesystem::exists(folder_ / kFinishedDataset);
  if (is_finished_) find_spoilt(folder_ / kFinishedDataset);
  if (std::filesystem::exists(folder_)) remove_leftovers(folder_);
  if (is_complete() || !holds_files(folder_)) std::filesystem::remove(folder_ / kUnfinished);
  if (spoilt_.empty()) return;
  begin();
  std::filesystem::remove(folder_ / kFinishedDataset);
  for (const std::string& name : spoilt_) std::filesystem::remove(folder_ / name);
}

void RenderedDataset::begin() const {
  for (const char* part : {"left", "right", "left_id", "right_id", "left_depth", "right_depth"})
    prepare_output_folder(folder_ / part);
  write_file_atomically(folder_ / kUnfinished, identity_.dump(2) + "\n");
}

void RenderedDataset::find_spoilt(const std::filesystem::path& marker) {
  const nlohmann::json told = read_marker(marker);
  try {
    for (const std::string& name :
         changed_files(folder_, told.value(kFiles, nlohmann::json(nlohmann::json::object()))))
      spoilt_.push_back(name);
  } catch (const BadLine& error) {
    throw std::runtime_error(fmt::format("{}: {}", marker.string(), error.what()));
  }
}

void RenderedDataset::write(const FrameEvent& event) const {
  if (!std::filesystem::exists(folder_ / kUnfinished)) begin();
  const std::string name = fmt::format("{:06}", event.step);
  const std::array<std::pair<const char*, const renderer::RenderedImage*>, 2> images = {
      {{"left", &event.frame.left}, {"right", &event.frame.right}}};
  for (const auto& [side, frame] : images) {
    const cv::Mat& picture = frame == &event.frame.left ? event.pair.left : event.pair.right;
    write_once(folder_ / side / (name + ".png"), picture);
    write_once(folder_ / (std::string(side) + "_id") / (name + ".png"), frame->ball_id);
    write_once(folder_ / (std::string(side) + "_depth") / (name + ".pfm"), frame->depth_m);
  }
}

void RenderedDataset::finish(const worlds::World& world, const vision::StereoRig& rig,
                             const vision::StereoRig& believed_rig, const MeasurementLog& log,
                             const CoarseBlur& blur) const {
  if (!std::filesystem::exists(folder_ / kUnfinished)) begin();
  write_file_atomically(folder_ / "calibration.yaml", calibration_yaml(believed_rig));
  write_file_atomically(folder_ / "true_calibration.yaml", calibration_yaml(rig));
  write_file_atomically(folder_ / "balls.csv", balls_csv(world));
  write_log(folder_, log);
  remove_leftovers(folder_);  // of one that was just dying when this one began
  nlohmann::ordered_json marker = identity_;
  const std::vector<std::string> names = product_names(folder_);
  marker[kFrames] = frames_among(names);
  marker[kBlur] = blur_json(blur);
  marker[kFiles] = file_list(folder_, names);
  write_file_atomically(folder_ / kFinishedDataset, marker.dump(2) + "\n");
  std::filesystem::remove(folder_ / kUnfinished);
}

std::string balls_csv(const worlds::World& world) {
  std::string csv = "ball_id,colour,red,green,blue,x_m,y_m,z_m,radius_m\n";
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    const worlds::Ball& ball = world.balls[i];
    const Eigen::Vector3d rgb = 255.0 * worlds::paint_of(ball);
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", i, ball.colour, rgb.x(), rgb.y(), rgb.z(),
                       ball.centre_m.x(), ball.centre_m.y(), ball.centre_m.z(), ball.radius_m);
  }
  return csv;
}

}  // namespace stereobench::harness
