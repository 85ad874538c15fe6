/// What the filters are called on command lines and in files.
#pragma once

#include <string>
#include <vector>

namespace stereobench::slam {

/// @return the names that make_filter knows
inline std::vector<std::string> filter_names() {
  return {"dead_reckoning", "ekf", "fastslam1", "fastslam2", "ufastslam", "ufastslam_kim"};
}

/// @return those that are run where nobody says which
inline std::vector<std::string> usual_filter_names() {
  return {"dead_reckoning", "fastslam2", "ufastslam"};
}

}  // namespace stereobench::slam
