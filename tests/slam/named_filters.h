/// The filters' names as types, for typed test suites.
#pragma once

namespace stereobench::slam {

struct DeadReckoningName {
  static constexpr const char* kName = "dead_reckoning";
};
struct EkfName {
  static constexpr const char* kName = "ekf";
};
struct FastSlam1Name {
  static constexpr const char* kName = "fastslam1";
};
struct FastSlam2Name {
  static constexpr const char* kName = "fastslam2";
};
struct UFastSlamName {
  static constexpr const char* kName = "ufastslam";
};
struct UFastSlamKimName {
  static constexpr const char* kName = "ufastslam_kim";
};

}  // namespace stereobench::slam
