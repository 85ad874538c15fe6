#include "harness/dataset/rendered_dataset.h"

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "harness/dataset/atomic_file.h"
#include "harness/dataset/calibration_file.h"
#include "harness/dataset/measurement_log_writer.h"
#include "harness/dataset/picture_file.h"
#include "worlds/paint.h"

namespace stereobench::harness {
namespace {

/// What the folder's marker says while frames are still being written, and after.
constexpr const char* kUnfinished = "dataset.unfinished.json";
constexpr const char* kFinished = "dataset.json";

std::string read_whole(const std::filesystem::path& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

}  // namespace

RenderedDataset::RenderedDataset(std::filesystem::path folder, std::string identity)
    : folder_(std::move(folder)), identity_(std::move(identity)) {
  prepare_output_folder(folder_);
  for (const char* marker : {kFinished, kUnfinished})
    if (std::filesystem::exists(folder_ / marker) && read_whole(folder_ / marker) != identity_)
      throw std::runtime_error(
          fmt::format("{}: holds a data set of another scenario, seed, back end or version; choose another "
                      "folder or remove it",
                      (folder_ / marker).string()));
  remove_leftovers(folder_);
  for (const char* part : {"left", "right", "left_id", "right_id", "left_depth", "right_depth"})
    prepare_output_folder(folder_ / part);
  if (!std::filesystem::exists(folder_ / kFinished)) write_file_atomically(folder_ / kUnfinished, identity_);
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
  write_file_atomically(folder_ / kFinished, identity_);
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
