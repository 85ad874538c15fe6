/// What the filters are called on command lines and in files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stereobench::slam {

/// @return the names that make_filter knows
inline std::vector<std::string> filter_names() {
  return {"dead_reckoning", "ekf",           "fastslam1",       "fastslam2",
          "ufastslam",      "ufastslam_kim", "fastslam2_block", "ufastslam_block"};
}

/// @return whether a filter uses sightings with an identity alone, and refuses all others
inline bool needs_identities(std::string_view name) {
  return name == "fastslam2_block" || name == "ufastslam_block";
}

/// @return those that are run where nobody says which
inline std::vector<std::string> usual_filter_names() {
  return {"dead_reckoning", "fastslam2", "ufastslam"};
}

}  // namespace stereobench::slam
