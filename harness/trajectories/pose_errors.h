/// How far an estimated trajectory is from the true one.
#pragma once

#include <string>
#include <vector>

#include "harness/trajectories/types.h"

namespace stereobench::harness {

/// One error a pose or a pair of poses: its parts that are a shift and a turn.
struct PoseErrors {
  std::vector<double> translation_m;
  std::vector<double> rotation_rad;
};

/// Of a list of errors; NaN where there is none.
struct ErrorStatistics {
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double sd = 0.0;  ///< with n
  double min = 0.0;
  double max = 0.0;
  double sse = 0.0;  ///< sum of squares
};

ErrorStatistics statistics_of(std::vector<double> errors);

/// The absolute pose error: the distance of the positions, and the angle between the orientations (Sturm et
/// al., IROS 2012, eq. 3; Kuemmerle et al., Autonomous Robots 27, 2009).
PoseErrors absolute_errors(const TrajectoryPairs& aligned);

/// Between which poses a relative error is.
struct Delta {
  enum class Unit { kPoses, kMetres, kSeconds };

  double length = 1.0;
  Unit unit = Unit::kPoses;
  /// From every pose on, instead of from where the last pair ended. In metres a pair then ends at the pose
  /// that is nearest to its length, and there is none where that misses it by more than a tenth.
  bool all_pairs = false;
};

/// Reads "1", "10m" or "0.5s". @throws std::runtime_error that says what was expected
Delta parse_delta(const std::string& text);

/// The form that parse_delta reads.
std::string text_of(const Delta& delta);

/// The same for people: "1 pose", "5 poses", "10m".
std::string span_text(const Delta& delta);

/// The relative pose error: inverse(inverse(Q_i) Q_j) inverse(P_i) P_j of truth Q and estimate P (Sturm et
/// al., eq. 1). A pair ends at the first pose that is as far from its start as asked for, or further: in
/// poses, in seconds, or in metres along the estimate's path. Spans are chosen as in the program evo.
PoseErrors relative_errors(const TrajectoryPairs& aligned, const Delta& delta);

/// The error over pieces of one length, per metre of them (Geiger, Lenz and Urtasun, CVPR 2012).
struct SegmentErrors {
  double length_m = 0.0;
  long count = 0;
  double translation_percent = 0.0;  ///< mean over the pieces; NaN where there are none
  double rotation_deg_per_m = 0.0;
};

/// Starts a piece at each tenth pose. A piece ends at the first pose beyond its length of the truth's path.
/// @return one a length; that of all pieces together last, with a length of 0
std::vector<SegmentErrors> segment_errors(const TrajectoryPairs& aligned,
                                          const std::vector<double>& lengths_m);

/// How far each pose is from the first one along a path.
std::vector<double> path_lengths_m(const std::vector<PoseInSpace>& poses);

}  // namespace stereobench::harness
