#include "harness/dataset/formats/odometry/tum_format.h"

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/truth/truth_pictures.h"
#include "harness/io/calibration_file.h"
#include "harness/logs/measurement_log_writer.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using vision::Side;

constexpr double kLevelsPerMetre = 5000.0;

class TumWriter final : public DatasetWriter {
 public:
  explicit TumWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    return {camera_file(name("rgb", pair.step()), pair, Side::kLeft),
            picture_file(name("depth", pair.step()),
                         [&pair] { return depth_levels(pair.depth_m(Side::kLeft), kLevelsPerMetre); })};
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog& log) const override {
    std::string poses =
        fmt::format("# ground truth trajectory\n# {}, seed {}\n# timestamp tx ty tz qx qy qz qw\n",
                    drive_.name, drive_.seed);
    const Eigen::Isometry3d robot_from_camera = vision::robot_from_camera(drive_.rig);
    for (const LogStep& step : log.steps)
      poses += tum_line(kEpoch_ns + step.stamp_ns, world_from_robot(step.truth.value()) * robot_from_camera);
    return {text_file("rgb.txt", list_of("rgb", "color images")),
            text_file("depth.txt", list_of("depth", "depth maps")), text_file("groundtruth.txt", poses),
            text_file("calibration.yaml", calibration_yaml(drive_.rig))};
  }

 private:
  std::string time(std::size_t step) const { return seconds_of(kEpoch_ns + drive_.steps[step].stamp_ns); }
  std::string name(const char* folder, std::size_t step) const {
    return fmt::format("{}/{}.png", folder, time(step));
  }
  std::string list_of(const char* folder, const char* what) const {
    std::string text =
        fmt::format("# {}\n# {}, seed {}\n# timestamp filename\n", what, drive_.name, drive_.seed);
    for (const std::size_t step : steps_with_pictures(drive_))
      text += fmt::format("{} {}\n", time(step), name(folder, step));
    return text;
  }

  const DatasetDrive& drive_;
};

}  // namespace

void check_tum_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"tum", "pictures of one camera and of one instant"};
  limits.require_believed(drive);
  limits.require_whole_pictures(drive);
  limits.require_in_time(drive);
}

std::unique_ptr<DatasetWriter> tum_writer(const DatasetDrive& drive) {
  return std::make_unique<TumWriter>(drive);
}

}  // namespace stereobench::harness
