#include "harness/dataset/formats/odometry/euroc_format.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/dataset/camera_pose.h"
#include "harness/dataset/formats/format_limits.h"
#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using vision::Side;

/// A line of sensor.yaml; none where there is no rate.
std::string rate_line(const DatasetDrive& drive) {
  const double rate_hz = pairs_per_second(drive);
  return rate_hz > 0.0 ? fmt::format("rate_hz: {}\n", rate_hz) : "";
}

/// How a sensor is placed on the robot, as all of the layout's sensor.yaml begin.
std::string sensor_yaml(const char* type, const std::string& comment,
                        const Eigen::Isometry3d& body_from_sensor) {
  return fmt::format("sensor_type: {}\ncomment: {}\nT_BS:\n  cols: 4\n  rows: 4\n  data: [{}]\n", type,
                     comment, matrix_text(body_from_sensor, 4, ", "));
}

std::string camera_yaml(const DatasetDrive& drive, Side side) {
  const vision::Intrinsics& camera = drive.rig.intrinsics;
  const vision::Distortion& lens = drive.rig.distortion;
  return sensor_yaml("camera", fmt::format("{}, seed {}", drive.name, drive.seed),
                     vision::robot_from_camera(drive.rig, side)) +
         rate_line(drive) +
         fmt::format(
             "resolution: [{}, {}]\ncamera_model: pinhole\nintrinsics: [{}, {}, {}, {}]\n"
             "distortion_model: radial-tangential\ndistortion_coefficients: [{}, {}, {}, {}]\n",
             camera.width_px, camera.height_px, camera.focal_px, camera.focal_px * lens.pixel_aspect,
             camera.cx_px, camera.cy_px, lens.k1, lens.k2, lens.p1, lens.p2);
}

/// The speed at which the robot came from one place to another, m/s in the world: a way without a bend.
Eigen::Vector3d speed_between(const LogStep& before, const LogStep& now) {
  const double seconds =
      static_cast<double>(now.stamp_ns - before.stamp_ns) / static_cast<double>(kSecond_ns);
  const slam::Pose& from = before.truth.value();
  const slam::Pose& to = now.truth.value();
  return Eigen::Vector3d(to.x_m - from.x_m, to.y_m - from.y_m, 0.0) / seconds;
}

std::string states_csv(const MeasurementLog& log) {
  std::string csv =
      "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
      "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], "
      "b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], "
      "b_a_RS_S_z [m s^-2]\n";
  for (std::size_t i = 0; i < log.steps.size(); ++i) {
    const Eigen::Isometry3d body = world_from_robot(log.steps[i].truth.value());
    const Eigen::Quaterniond turn = unit_quaternion(body.linear());
    const std::size_t from = i == 0 ? 0 : i - 1, to = std::min(from + 1, log.steps.size() - 1);
    const Eigen::Vector3d speed =
        to == from ? Eigen::Vector3d::Zero() : speed_between(log.steps[from], log.steps[to]);
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},0,0,0,0,0,0\n", kEpoch_ns + log.steps[i].stamp_ns,
                       body.translation().x(), body.translation().y(), body.translation().z(), turn.w(),
                       turn.x(), turn.y(), turn.z(), speed.x(), speed.y(), speed.z());
  }
  return csv;
}

class EurocWriter final : public DatasetWriter {
 public:
  explicit EurocWriter(const DatasetDrive& drive) : drive_(drive) {}

  std::vector<DatasetFile> frame_files(DatasetPair& pair) const override {
    std::vector<DatasetFile> files;
    for (const Side side : kBothSides)
      files.push_back(
          camera_file(fmt::format("mav0/{}/data/{}", camera_of(side), name(pair.step())), pair, side));
    return files;
  }

  std::vector<DatasetFile> drive_files(const MeasurementLog& log) const override {
    const std::string truth = "mav0/state_groundtruth_estimate0/";
    std::vector<DatasetFile> files = {
        text_file("mav0/body.yaml", fmt::format("comment: {}, seed {}\n", drive_.name, drive_.seed)),
        text_file(truth + "data.csv", states_csv(log)),
        text_file(truth + "sensor.yaml",
                  sensor_yaml("visual-inertial", "the exact path", Eigen::Isometry3d::Identity()))};
    for (const Side side : kBothSides) {
      files.push_back(text_file(fmt::format("mav0/{}/data.csv", camera_of(side)), pictures_csv()));
      files.push_back(
          text_file(fmt::format("mav0/{}/sensor.yaml", camera_of(side)), camera_yaml(drive_, side)));
    }
    return files;
  }

 private:
  static const char* camera_of(Side side) { return side == Side::kLeft ? "cam0" : "cam1"; }
  std::string name(std::size_t step) const {
    return fmt::format("{}.png", kEpoch_ns + drive_.steps[step].stamp_ns);
  }
  /// The same for both cameras: readers find the right picture by the left one's name.
  std::string pictures_csv() const {
    std::string csv = "#timestamp [ns],filename\n";
    for (const std::size_t step : steps_with_pictures(drive_))
      csv += fmt::format("{},{}\n", kEpoch_ns + drive_.steps[step].stamp_ns, name(step));
    return csv;
  }

  const DatasetDrive& drive_;
};

}  // namespace

void check_euroc_format(const DatasetDrive& drive) {
  const FormatLimits limits = {"euroc", "pairs of one instant, of lenses with k1, k2, p1 and p2"};
  if (drive.rig.distortion.k3 != 0.0) limits.refuse("rig.distortion.k3");
  limits.require_believed(drive);
  limits.require_one_instant(drive);
  limits.require_in_time(drive);
}

std::unique_ptr<DatasetWriter> euroc_writer(const DatasetDrive& drive) {
  return std::make_unique<EurocWriter>(drive);
}

}  // namespace stereobench::harness
