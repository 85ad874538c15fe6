#include "harness/dataset/formats/odometry/mrclam_format.h"

#include <iterator>

#include <fmt/format.h>

#include "harness/logs/measurement_log_writer.h"

namespace stereobench::harness {
namespace {

/// @param landmark_id from 0 on, or kUnknown
int subject_of(int landmark_id) {
  return landmark_id == slam::kUnknown ? 0 : landmark_id + kMrclamRobots + 1;
}

std::string mrclam_odometry(const MeasurementLog& log) {
  std::string text = "# Time [s]    forward velocity [m/s]    angular velocity[rad/s]\n";
  std::vector<OdometryReading> readings = odometry_readings(log);
  readings.push_back(readings.back());  // it lasts until then
  readings.back().stamp_ns = log.steps.back().stamp_ns;
  for (const OdometryReading& reading : readings)
    fmt::format_to(std::back_inserter(text), "{} {} {}\n", seconds_of(reading.stamp_ns), reading.v_mps,
                   reading.w_radps);
  return text;
}

std::string mrclam_measurements(const MeasurementLog& log) {
  std::string text = "# Time [s]    Subject #    range [m]    bearing [rad]\n";
  for (const LogStep& step : log.steps)
    for (const slam::RangeBearing& seen : step.measurements)
      fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", seconds_of(step.stamp_ns),
                     subject_of(seen.landmark_id), seen.range_m, seen.bearing_rad);
  return text;
}

std::string mrclam_path(const MeasurementLog& log) {
  std::string text = "# Time [s]    x [m]    y [m]    orientation [rad]\n";
  for (const LogStep& step : log.steps) {
    const slam::Pose& pose = step.truth.value();
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", seconds_of(step.stamp_ns), pose.x_m, pose.y_m,
                   pose.heading_rad);
  }
  return text;
}

std::string mrclam_landmarks(const MeasurementLog& log) {
  std::string text = "# Subject #    x [m]    y [m]    x std-dev [m]    y std-dev [m]\n";
  for (const LandmarkTruth& landmark : log.landmarks)
    fmt::format_to(std::back_inserter(text), "{} {} {} 0 0\n", subject_of(landmark.landmark_id),
                   landmark.position_m.x(), landmark.position_m.y());
  return text;
}

std::string mrclam_barcodes(const MeasurementLog& log) {
  std::string text = "# Subject #    Barcode #\n";
  for (const LandmarkTruth& landmark : log.landmarks)
    fmt::format_to(std::back_inserter(text), "{0} {0}\n", subject_of(landmark.landmark_id));
  return text;
}

class MrclamWriter final : public DatasetWriter {
 public:
  std::vector<DatasetFile> frame_files(DatasetPair&) const override { return {}; }
  std::vector<DatasetFile> drive_files(const MeasurementLog& log) const override {
    return {text_file("Robot1_Odometry.dat", mrclam_odometry(log)),
            text_file("Robot1_Measurement.dat", mrclam_measurements(log)),
            text_file("Robot1_Groundtruth.dat", mrclam_path(log)),
            text_file("Landmark_Groundtruth.dat", mrclam_landmarks(log)),
            text_file("Barcodes.dat", mrclam_barcodes(log))};
  }
};

}  // namespace

void check_mrclam_format(const DatasetDrive&) {}

std::unique_ptr<DatasetWriter> mrclam_writer(const DatasetDrive&) {
  return std::make_unique<MrclamWriter>();
}

}  // namespace stereobench::harness
