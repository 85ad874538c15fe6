#include "harness/dataset/rendered_dataset.h"

#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "harness/dataset/atomic_file.h"
#include "harness/dataset/calibration_file.h"
#include "harness/dataset/file_list.h"
#include "harness/dataset/measurement_log_writer.h"
#include "harness/dataset/picture_file.h"
#include "harness/dataset/text_file.h"
#include "harness/detector/json_line.h"
#include "worlds/paint.h"

namespace stereobench::harness {
namespace {

/// The folder's marker while frames are still being written.
constexpr const char* kUnfinished = "dataset.unfinished.json";

/// What a marker says; nothing where it is not JSON.
nlohmann::json read_marker(const std::filesystem::path& path) {
  try {
    return parse_line(read_text(path));
  } catch (const BadLine&) {
    return {};
  }
}

}  // namespace

RenderedDataset::RenderedDataset(std::filesystem::path folder, nlohmann::ordered_json identity)
    : folder_(std::move(folder)), identity_(std::move(identity)) {
  prepare_output_folder(folder_);
  for (const char* marker : {kFinishedDataset, kUnfinished})
    if (std::filesystem::exists(folder_ / marker)) take_up(folder_ / marker);
  remove_leftovers(folder_);
  for (const char* part : {"left", "right", "left_id", "right_id", "left_depth", "right_depth"})
    prepare_output_folder(folder_ / part);
  if (!std::filesystem::exists(folder_ / kFinishedDataset) || !spoilt_.empty())
    write_file_atomically(folder_ / kUnfinished, identity_.dump(2) + "\n");
  if (!spoilt_.empty()) std::filesystem::remove(folder_ / kFinishedDataset);
  for (const std::string& name : spoilt_) std::filesystem::remove(folder_ / name);
}

void RenderedDataset::take_up(const std::filesystem::path& marker) {
  nlohmann::json told = read_marker(marker);
  nlohmann::json files = nlohmann::json::object();
  if (told.is_object() && told.contains(kFiles)) {
    files = told[kFiles];
    told.erase(kFiles);
  }
  if (told != parse_line(identity_.dump()))
    throw std::runtime_error(
        fmt::format("{}: holds a data set of another scenario, seed, back end or version; choose another "
                    "folder or remove it",
                    marker.string()));
  try {
    for (const std::string& name : changed_files(folder_, files)) spoilt_.push_back(name);
  } catch (const BadLine& error) {
    throw std::runtime_error(fmt::format("{}: {}", marker.string(), error.what()));
  }
}

void RenderedDataset::write(const Look& look) const {
  const std::string name = fmt::format("{:06}", look.step);
  const std::array<std::pair<const char*, const renderer::EyeFrame*>, 2> eyes = {
      {{"left", &look.frame.left}, {"right", &look.frame.right}}};
  for (const auto& [eye, frame] : eyes) {
    const cv::Mat& picture = frame == &look.frame.left ? look.pair.left : look.pair.right;
    write_once(folder_ / eye / (name + ".png"), picture);
    write_once(folder_ / (std::string(eye) + "_id") / (name + ".png"), frame->ball_id);
    write_once(folder_ / (std::string(eye) + "_depth") / (name + ".pfm"), frame->depth_m);
  }
}

void RenderedDataset::finish(const worlds::World& world, const vision::StereoRig& rig,
                             const vision::StereoRig& believed_rig, const MeasurementLog& log) const {
  write_file_atomically(folder_ / "calibration.yaml", calibration_yaml(believed_rig));
  write_file_atomically(folder_ / "true_calibration.yaml", calibration_yaml(rig));
  write_file_atomically(folder_ / "balls.csv", balls_csv(world));
  write_log(folder_, log);
  remove_leftovers(folder_);  // of one that was just dying when this one began
  nlohmann::ordered_json marker = identity_;
  marker[kFiles] = file_list(folder_, product_names(folder_));
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
