/// Fixed pictures that vision is measured on while its tuning varies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/drive/recording.h"
#include "tests/studies/photograph_score.h"
#include "tests/vision/painter.h"
#include "worlds/types.h"

namespace stereobench::ablation {

/// What vision made of some pictures.
struct Outcome {
  long wanted = 0;      ///< balls that have to be found
  long found = 0;       ///< of these
  long trusted = 0;     ///< observations that are to be trusted
  long wrong = 0;       ///< of these, those of nothing, of a ball twice or of another colour
  double rms = 0.0;     ///< error of the range, mm; of photographs of a centre, px
  double nis = 0.0;     ///< mean of e' R^-1 e / 2: 1 where covariances are consistent
  double cpu_s = 0.0;   ///< that vision took
  double digest = 0.0;  ///< of all errors: the same where all are the same to the bit
};

/// A drive's frames with their truth, in memory.
struct DrivenFrames {
  worlds::Scenario scenario;
  worlds::World world;
  std::vector<std::size_t> steps;
  std::vector<slam::Pose> poses;
  std::vector<vision::StereoPair> pairs;
  std::vector<renderer::StereoFrame> truth;
};

/// Renders every so manyth frame of a shipped scenario.
/// @param overrides as of `--set`
DrivenFrames drive(const std::string& scenario, std::vector<std::string> overrides, std::size_t stride,
                   std::uint64_t seed);

/// Balls of which 10 to 70 % are hidden, painted.
struct HiddenBalls {
  vision::StereoRig rig;
  std::vector<vision::painter::Scene> scenes;
  std::vector<vision::StereoPair> pairs;
};

/// @param seeds of each of the three kinds of hider
HiddenBalls hidden_balls(std::uint64_t seeds);

std::vector<photograph::Photograph> photographs(std::uint64_t count);

/// Finds the balls, with tuning as it is.
Outcome outcome_of(const DrivenFrames& frames);
Outcome outcome_of(const HiddenBalls& balls);
Outcome outcome_of(const std::vector<photograph::Photograph>& photographs);

}  // namespace stereobench::ablation
