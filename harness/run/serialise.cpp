#include "harness/run/serialise.h"

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace nlohmann {

/// Matrices as flat arrays in Eigen's order of storage.
template <int Rows, int Cols>
struct adl_serializer<Eigen::Matrix<double, Rows, Cols>> {
  using Matrix = Eigen::Matrix<double, Rows, Cols>;
  static void to_json(json& j, const Matrix& m) { j = std::vector<double>(m.data(), m.data() + m.size()); }
  static void from_json(const json& j, Matrix& m) {
    for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = j.at(static_cast<std::size_t>(i)).get<double>();
  }
};

template <typename Value>
struct adl_serializer<std::optional<Value>> {
  static void to_json(json& j, const std::optional<Value>& value) {
    j = value ? json(*value) : json(nullptr);
  }
  static void from_json(const json& j, std::optional<Value>& value) {
    value = j.is_null() ? std::nullopt : std::optional<Value>(j.get<Value>());
  }
};

}  // namespace nlohmann

namespace stereobench::slam {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Pose, x_m, y_m, heading_rad)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Control, v_mps, w_radps, duration_s)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RangeBearing, range_m, bearing_rad, covariance, landmark_id, colour_class)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LandmarkEstimate, landmark_id, colour_class, position_m, covariance,
                                   origin)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FilterCounters, resamplings, covariance_repairs, weight_collapses,
                                   gated_measurements, rejected_inputs, joint_searches_cut)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(NormalisedInnovation, sighting, squared_length, refused)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Estimate, pose, covariance, landmarks, effective_particles, counters)
}  // namespace stereobench::slam

namespace stereobench::vision {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Intrinsics, width_px, height_px, focal_px, cx_px, cy_px)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FaultSums, information, evidence, squares)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RigWatch, rows, sizes, balls)
}  // namespace stereobench::vision

namespace stereobench::harness {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LogStep, stamp_ns, odometry, measurements, truth, true_landmarks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(AssociationScore, correct, wrong, missed, imagined, duplicated, spurious)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LandmarkTruth, landmark_id, colour_class, position_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MeasurementLog, start, start_is_true, steps, landmarks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(UpdateRecord, innovations, effective_particles, distinct_ancestors)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FilterRun, filter, particles, seed, poses, covariances, updates, last,
                                   association, failed, failure)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoundRun, poses, smoothed_poses, landmarks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(References, bound, batch)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RigCheck, camera, baseline_m, watch)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(VisionScore, visible, found, observations, right, misidentified, spurious,
                                   repeated, flagged, range_errors_m, bearing_errors_rad, disparity_errors_px,
                                   normalised_errors, rig)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BallBounds, of_size, unknown_size)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CalibrationSample, truth, error, stated, bounds, disparity_error_px,
                                   radius_error_px, depth_m, whole)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CalibrationTake, samples, score)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CoarseBlur, pairs, most_step_px)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Recording, log, detector, vision, blur, timing)

namespace {

std::string bytes_of(const nlohmann::json& json) {
  std::string bytes;
  nlohmann::json::to_cbor(json, bytes);
  return bytes;
}

nlohmann::json json_of(std::string_view bytes) {
  return nlohmann::json::from_cbor(bytes.begin(), bytes.end());
}

}  // namespace

std::string to_bytes(const SeedDrive& drive) {
  nlohmann::json snapshots = nlohmann::json::array();
  for (const Snapshot& snapshot : drive.snapshots)
    snapshots.push_back({{"step", snapshot.step},
                         {"png", nlohmann::json::binary({snapshot.png.begin(), snapshot.png.end()})}});
  return bytes_of({{"seed", drive.seed},
                   {"recording", drive.recording},
                   {"runs", drive.runs},
                   {"references", drive.references},
                   {"snapshots", std::move(snapshots)}});
}

SeedDrive seed_drive_from_bytes(std::string_view bytes) {
  const nlohmann::json json = json_of(bytes);
  SeedDrive drive;
  json.at("seed").get_to(drive.seed);
  json.at("recording").get_to(drive.recording);
  json.at("runs").get_to(drive.runs);
  json.at("references").get_to(drive.references);
  for (const nlohmann::json& snapshot : json.at("snapshots")) {
    const auto& png = snapshot.at("png").get_binary();
    drive.snapshots.push_back({snapshot.at("step").get<std::size_t>(), {png.begin(), png.end()}});
  }
  return drive;
}

std::string to_bytes(const std::vector<FilterRun>& runs) {
  return bytes_of(runs);
}

std::vector<FilterRun> filter_runs_from_bytes(std::string_view bytes) {
  return json_of(bytes).get<std::vector<FilterRun>>();
}

std::string to_bytes(const CalibrationTake& take) {
  return bytes_of(take);
}

CalibrationTake calibration_take_from_bytes(std::string_view bytes) {
  return json_of(bytes).get<CalibrationTake>();
}

}  // namespace stereobench::harness
