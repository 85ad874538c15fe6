#include "harness/json/cbor.h"
#include "harness/run/seed_result.h"
#include "harness/vision_scoring/vision_score_json.h"

namespace stereobench::slam {
STEREOBENCH_ALL_FIELDS(Pose, x_m, y_m, heading_rad)
STEREOBENCH_ALL_FIELDS(LandmarkEstimate, landmark_id, colour_class, position_m, covariance, origin)
STEREOBENCH_ALL_FIELDS(FilterCounters, resamplings, covariance_repairs, weight_collapses, gated_measurements,
                       rejected_inputs, joint_searches_cut, refitted_frames)
STEREOBENCH_ALL_FIELDS(Control, v_mps, w_radps, duration_s, lateral_mps, covariance)
STEREOBENCH_ALL_FIELDS(RangeBearing, range_m, bearing_rad, covariance, landmark_id, colour_class, sd_scale)
STEREOBENCH_ALL_FIELDS(BatchStep, controls, sightings)
}  // namespace stereobench::slam

namespace stereobench::harness {
STEREOBENCH_ALL_FIELDS(LandmarkTruth, landmark_id, colour_class, position_m)
STEREOBENCH_ALL_FIELDS(FaultCounts, moved, lost, added, renamed, delayed, undelivered)
STEREOBENCH_ALL_FIELDS(CoarseBlur, pairs, most_step_px)
STEREOBENCH_ALL_FIELDS(AssociationScore, correct, wrong, missed, imagined, duplicated, spurious)
STEREOBENCH_ALL_FIELDS(TrajectoryScore, ate_rms_m, ate_max_m, ate_aligned_rms_m, ate_aligned_max_m,
                       heading_rms_rad, rpe_rms_m, rpe_heading_rms_rad, final_drift, truth_from_estimate,
                       scored_steps)
STEREOBENCH_ALL_FIELDS(MapScore, rms_m, max_m, found_once, duplicated, missed, spurious)
STEREOBENCH_ALL_FIELDS(EllipseCoverage, within, positions)
STEREOBENCH_ALL_FIELDS(ParticleScore, effective_mean, effective_least, resamplings, ancestors_of_first,
                       ancestors_of_quarter)

/// One a step: two numbers without names.
inline void to_json(nlohmann::json& json, const SquaredSum& sum) {
  json = {sum.sum, sum.degrees_of_freedom};
}
inline void from_json(const nlohmann::json& json, SquaredSum& sum) {
  json.at(0).get_to(sum.sum);
  json.at(1).get_to(sum.degrees_of_freedom);
}

STEREOBENCH_ALL_FIELDS(InnovationSum, all, used)
STEREOBENCH_ALL_FIELDS(InnovationScore, run, by_landmark)
STEREOBENCH_ALL_FIELDS(ConsistencyScore, innovations, path, map, particles)
STEREOBENCH_ALL_FIELDS(FilterScore, failed, truth_from_estimate, trajectory, ate_aligned_at_sightings_rms_m,
                       map, map_aligned, map_path_aligned, normalised_errors, consistency)
STEREOBENCH_ALL_FIELDS(BoundScore, pose_rms_m, heading_rms_rad, landmark_rms_m)
STEREOBENCH_ALL_FIELDS(BoundScores, filtering, smoothing)
STEREOBENCH_ALL_FIELDS(MapEstimate, filter, path, landmarks)
STEREOBENCH_ALL_FIELDS(ScoredRun, filter, particles, score, association, counters, errors_m, innovations)

inline void to_json(nlohmann::json& json, const MapPicture& map) {
  json = {{"true_path", map.true_path}, {"landmarks", map.landmarks}, {"estimates", map.estimates}};
}
inline void from_json(const nlohmann::json& json, MapPicture& map) {
  json.at("true_path").get_to(map.true_path);
  json.at("landmarks").get_to(map.landmarks);
  json.at("estimates").get_to(map.estimates);
}

inline void to_json(nlohmann::json& json, const Snapshot& snapshot) {
  json = {{"step", snapshot.step},
          {"png", nlohmann::json::binary({snapshot.png.begin(), snapshot.png.end()})}};
}
inline void from_json(const nlohmann::json& json, Snapshot& snapshot) {
  json.at("step").get_to(snapshot.step);
  const auto& png = json.at("png").get_binary();
  snapshot.png.assign(png.begin(), png.end());
}

inline void to_json(nlohmann::json& json, const KeptPair& pair) {
  const auto binary = [](const std::string& bytes) {
    return nlohmann::json::binary({bytes.begin(), bytes.end()});
  };
  json = {pair.seed,
          pair.frame,
          pair.badness.faults,
          pair.badness.worst_nis,
          binary(pair.left_jpeg),
          binary(pair.right_jpeg)};
}
inline void from_json(const nlohmann::json& json, KeptPair& pair) {
  const auto text = [](const nlohmann::json& bytes) {
    return std::string(bytes.get_binary().begin(), bytes.get_binary().end());
  };
  pair = {json.at(0).get<std::uint64_t>(),
          json.at(1).get<std::size_t>(),
          {json.at(2).get<long>(), json.at(3).get<double>()},
          text(json.at(4)),
          text(json.at(5))};
}

STEREOBENCH_ALL_FIELDS(MapTrack, truth, seen_m, covariances)
STEREOBENCH_ALL_FIELDS(SensorLog, start, steps)
STEREOBENCH_ALL_FIELDS(SeedResult, seed, detector, vision, faults, blur, timing, steps, start_is_true,
                       identities_known, runs, batch, bound, bound_m2, csv, detections_gz, time_s, map, track,
                       snapshots, pairs, log)

std::string to_bytes(const SeedResult& result) {
  return bytes_of(result);
}

SeedResult seed_result_from_bytes(std::string_view bytes) {
  return json_of(bytes).get<SeedResult>();
}

}  // namespace stereobench::harness
