#include "harness/io/cbor.h"
#include "harness/run/seed_result.h"
#include "harness/vision_scoring/vision_score_json.h"

namespace stereobench::slam {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Pose, x_m, y_m, heading_rad)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LandmarkEstimate, landmark_id, colour_class, position_m, covariance,
                                   origin)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FilterCounters, resamplings, covariance_repairs, weight_collapses,
                                   gated_measurements, rejected_inputs, joint_searches_cut)
}  // namespace stereobench::slam

namespace stereobench::harness {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LandmarkTruth, landmark_id, colour_class, position_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CoarseBlur, pairs, most_step_px)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(AssociationScore, correct, wrong, missed, imagined, duplicated, spurious)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TrajectoryScore, ate_rms_m, ate_max_m, ate_aligned_rms_m,
                                   ate_aligned_max_m, heading_rms_rad, rpe_rms_m, rpe_heading_rms_rad,
                                   final_drift, truth_from_estimate, scored_steps)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MapScore, rms_m, max_m, found_once, duplicated, missed, spurious)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EllipseCoverage, within, positions)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ParticleScore, effective_mean, effective_least, resamplings,
                                   ancestors_of_first, ancestors_of_quarter)

/// One a step: two numbers without names.
inline void to_json(nlohmann::json& json, const SquaredSum& sum) {
  json = {sum.sum, sum.degrees_of_freedom};
}
inline void from_json(const nlohmann::json& json, SquaredSum& sum) {
  json.at(0).get_to(sum.sum);
  json.at(1).get_to(sum.degrees_of_freedom);
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InnovationSum, all, used)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(InnovationScore, run, by_landmark)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ConsistencyScore, innovations, path, map, particles)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FilterScore, failed, truth_from_estimate, trajectory,
                                   ate_aligned_at_sightings_rms_m, map, map_aligned, map_path_aligned,
                                   normalised_errors, consistency)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoundScore, pose_rms_m, heading_rms_rad, landmark_rms_m)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(BoundScores, filtering, smoothing)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MapEstimate, filter, path, landmarks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ScoredRun, filter, particles, score, association, counters, errors_m)

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

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SeedResult, seed, detector, vision, blur, timing, steps, start_is_true,
                                   identities_known, runs, batch, bound, bound_m2, csv, time_s, map,
                                   snapshots)

std::string to_bytes(const SeedResult& result) {
  return bytes_of(result);
}

SeedResult seed_result_from_bytes(std::string_view bytes) {
  return json_of(bytes).get<SeedResult>();
}

}  // namespace stereobench::harness
