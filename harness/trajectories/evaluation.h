/// A trajectory that was made elsewhere, scored.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/trajectories/alignment.h"
#include "harness/trajectories/pairing.h"
#include "harness/trajectories/pose_errors.h"

namespace stereobench::harness {

struct EvaluationRules {
  PairingRules pairing;
  std::optional<AlignmentKind> align;  ///< none: kSe2 where a file has poses in the plane alone, else kSe3
  std::optional<Plane> plane;          ///< of kSe2 and kSim2; none: kXy
  Delta delta;
  std::vector<double> segments_m = {100, 200, 300, 400, 500, 600, 700, 800};  ///< as KITTI has them
};

struct Evaluation {
  TrajectoryPairs pairs;  ///< the estimate aligned
  std::size_t estimate_poses = 0;
  std::size_t truth_poses = 0;
  PairingRules pairing;
  AlignmentKind align = AlignmentKind::kNone;
  std::optional<Plane> plane;  ///< that all is in; none: space
  Alignment alignment;
  PoseErrors absolute;
  Delta delta;
  PoseErrors relative;
  std::vector<SegmentErrors> segments;
};

/// @throws std::runtime_error, one line, where the trajectories cannot be paired or aligned, and for rules
/// that have no meaning for them
Evaluation evaluate(const Trajectory& estimate, const Trajectory& truth, const EvaluationRules& rules);

/// "se3" and so on.
std::string text_of(AlignmentKind kind);

/// "xy" and so on.
std::string text_of(Plane plane);

/// @param estimate, truth what they are called
nlohmann::ordered_json evaluation_json(const Evaluation& evaluation, const std::string& estimate,
                                       const std::string& truth);

/// A line a pair: time_s (`pose`, its number, where there are no times), translation_m, rotation_rad of the
/// absolute error.
std::string errors_csv(const Evaluation& evaluation);

/// The errors in tables, for people.
std::string evaluation_table(const Evaluation& evaluation);

}  // namespace stereobench::harness
