#include "harness/dataset/formats/odometry/kitti_odometry_format.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "harness/dataset/formats/rectified_pair.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// From a laser scanner's axes (x forward, y left, z up), which readers ask for, to the left camera's. It is
/// where the camera is: there is none.
constexpr const char* kNoScanner = "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n";

class KittiOdometryWriter final : public DatasetWriter {
 public:
  explicit KittiOdometryWriter(const DatasetDrive& drive)
      : drive_(drive),
        sequence_(fmt::format("sequences/{:02}/", drive.seed)),
        taken_(steps_with_pictures(drive)) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    const auto frame = std::ranges::lower_bound(taken_, pair.step()) - taken_.begin();
    std::vector<DatasetFile> files;
    for (const Side side : kBothSides) {
      const int camera = side == Side::kLeft ? 0 : 1;
      files.push_back(picture_file(fmt::format("{}image_{}/{:06}.png", sequence_, camera, frame),
                                   [side, &pair] { return grey_of(pair.picture(side)); }));
      files.push_back(
          camera_file(fmt::format("{}image_{}/{:06}.png", sequence_, camera + 2, frame), pair, side));
    }
    return files;
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog&) const override {
    std::string times, poses;
    for (const std::size_t step : taken_) {
      const auto since_first_ns = drive_.steps[step].stamp_ns - drive_.steps[taken_.front()].stamp_ns;
      times += fmt::format("{:e}\n", static_cast<double>(since_first_ns) / static_cast<double>(kSecond_ns));
      const Eigen::Isometry3d first_from_this =
          world_from_camera(drive_, taken_.front(), Side::kLeft).inverse() *
          world_from_camera(drive_, step, Side::kLeft);
      poses += matrix_text(first_from_this, 3, " ") + "\n";
    }
    return {text_file(sequence_ + "calib.txt", kitti_projections(drive_.rig) + kNoScanner),
            text_file(sequence_ + "times.txt", times),
            text_file(sequence_ + "velodyne/none.txt", "There is no laser scanner.\n"),
            text_file(fmt::format("poses/{:02}.txt", drive_.seed), poses)};
  }

 private:
  const DatasetDrive& drive_;
  std::string sequence_;
  std::vector<std::size_t> taken_;  ///< the steps that have pictures
};

}  // namespace

void check_kitti_odometry_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"kitti-odometry", "rectified pairs of one instant, and one calibration"};
  limits.require_pairs(drive);
  limits.require_in_time(drive);
}

std::unique_ptr<DatasetWriter> kitti_odometry_writer(const DatasetDrive& drive) {
  return std::make_unique<KittiOdometryWriter>(drive);
}

}  // namespace stereobench::harness
