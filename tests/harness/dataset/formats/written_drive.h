// A whole drive in one format, and what its readers should find.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "harness/dataset/camera_pose.h"
#include "tests/harness/dataset/step_writer.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {

inline void PrintTo(const DatasetFormat& format, std::ostream* out) {
  *out << format.name;
}

// The room, from a camera that looks down beside its pictures' middle.
inline worlds::Scenario tilted_drive() {
  worlds::Scenario scenario = room_drive();
  scenario.rig.intrinsics = {160, 120, 140.0, 76.25, 63.5};
  scenario.rig.pitch_down_rad = 0.1;
  scenario.believed_rig = scenario.rig;
  return scenario;
}

// All steps of a drive in one format.
class WrittenDrive {
 public:
  explicit WrittenDrive(std::string_view format, worlds::Scenario scenario = tilted_drive())
      : scenario_(std::move(scenario)) {
    dataset_format(format).check(drive_of(scenario_, scenario_.world, 0));
    StepWriter writer(folder_, scenario_, dataset_format(format), {});
    for (std::size_t step = 0; step < scenario_.path.size(); ++step) writer.write(step, frame(step));
    writer.finish();
  }

  const worlds::Scenario& scenario() const { return scenario_; }

  renderer::StereoFrame frame(std::size_t step) const {
    renderer::Renderer renderer(scenario_.world, scenario_.rig);
    return open_shutter(renderer, scenario_.path, step, scenario_.shutter).frame;
  }

  bool has(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }
  std::string text(const std::string& name) const { return folder_.read(name); }
  cv::Mat picture(const std::string& name) const {
    return cv::imread((folder_.path() / name).string(), cv::IMREAD_UNCHANGED);
  }

  // Where a camera at a pose shows the nearer ball's centre.
  Eigen::Vector2d ball_px(const Eigen::Isometry3d& world_from_camera) const {
    return vision::project(scenario_.rig.intrinsics,
                           world_from_camera.inverse() * scenario_.world.balls.front().centre_m);
  }

  // Where the renderer says that it is.
  Eigen::Vector2d true_ball_px(std::size_t step, vision::Side side) const {
    renderer::Renderer renderer(scenario_.world, scenario_.rig);
    const slam::Pose pose = scenario_.path[step].pose;
    const renderer::StereoIdBuffers ids = renderer.id_buffers(pose, pose);
    const bool is_left = side == vision::Side::kLeft;
    const renderer::StereoFrame seen = renderer.render(pose);
    return renderer::ball_truths(scenario_.world, (is_left ? ids.left : ids.right).view,
                                 (is_left ? seen.left : seen.right).ball_id)
        .front()
        .centre_px;
  }

 private:
  TestFolder folder_;
  worlds::Scenario scenario_;
};

// The lines of a text that are no comments, each split at blanks and commas.
inline std::vector<std::vector<std::string>> words_of(const std::string& text) {
  std::vector<std::vector<std::string>> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    lines.push_back({std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()});
  }
  return lines;
}

inline std::vector<double> as_numbers(const std::vector<std::string>& words, std::size_t from = 0) {
  std::vector<double> numbers;
  for (std::size_t i = from; i < words.size(); ++i) numbers.push_back(std::stod(words[i]));
  return numbers;
}

// A place and a turn, w apart.
inline Eigen::Isometry3d pose_of(const std::vector<double>& xyz, double w, double x, double y, double z) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(w, x, y, z).toRotationMatrix();
  pose.translation() << xyz.at(0), xyz.at(1), xyz.at(2);
  return pose;
}

// Twelve or sixteen numbers, row by row.
inline Eigen::Isometry3d pose_of(const std::vector<double>& numbers) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < 12; ++i)
    pose.matrix()(static_cast<int>(i / 4), static_cast<int>(i % 4)) = numbers.at(i);
  return pose;
}

}  // namespace stereobench::harness
