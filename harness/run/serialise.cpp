#include "harness/run/serialise.h"

#include "harness/io/cbor.h"
#include "harness/vision_scoring/vision_score_json.h"

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
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CoarseBlur, pairs, most_step_px)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Recording, log, detector, vision, blur, timing)

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

}  // namespace stereobench::harness
