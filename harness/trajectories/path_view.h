/// The two paths of an evaluation, seen from a side.
#pragma once

#include <string>
#include <vector>

#include "harness/trajectories/evaluation.h"
#include "slam/types.h"

namespace stereobench::harness {

/// Both paths in two of the axes, one pose a pair. Headings look along the path.
struct PathView {
  std::vector<slam::Pose> truth;
  std::vector<slam::Pose> estimate;
  std::string to_the_right;  ///< name of the axis: "x", "y" or "z"
  std::string upwards;
};

/// The view from where the true path extends the most; that of the plane where the evaluation is in one.
PathView path_view(const Evaluation& evaluation);

}  // namespace stereobench::harness
