/// The filters' names as types, for typed test suites.
#pragma once

#include "slam/filter_config.h"

namespace stereobench::slam {

struct DeadReckoningName {
  static constexpr const char* kName = "dead_reckoning";
};
struct EkfName {
  static constexpr const char* kName = "ekf";
};
struct IteratedEkfName {
  static constexpr const char* kName = "iekf";
};
struct SmootherName {
  static constexpr const char* kName = "smoother";
  static constexpr double kLeastSd = 1e-6;  // m and rad, of any motion
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

struct FastSlam2BlockName {
  static constexpr const char* kName = "fastslam2_block";
};
struct UFastSlamBlockName {
  static constexpr const char* kName = "ufastslam_block";
};

// A filter in blocks of three frames, so that short drives have many.
template <class Name>
struct InShortBlocks : Name {
  static constexpr int kDrawEvery = 3;
};

// The least standard deviation (m and rad) that a filter takes a motion for: 0 unless its name says so.
template <class Name>
constexpr double least_sd() {
  if constexpr (requires { Name::kLeastSd; }) return Name::kLeastSd;
  return 0.0;
}

// Settings that say of blocks what a name says of them.
template <class Name>
FilterConfig in_blocks_of(FilterConfig config) {
  if constexpr (requires { Name::kDrawEvery; }) config.draw_every = Name::kDrawEvery;
  return config;
}

}  // namespace stereobench::slam
