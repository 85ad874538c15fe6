/// What a calibration gave, as a table and as files.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/detector_noise/noise_fit.h"
#include "vision/types.h"

namespace stereobench::harness {

/// A detector's noise, fitted to one half of the calibration scenes and held against the other.
struct CalibrationResult {
  std::string scenario;
  std::string detector;
  std::vector<std::uint64_t> fitted_seeds;
  std::vector<std::uint64_t> held_out_seeds;
  FittedNoise noise;
  std::vector<CalibrationBin> bins;  ///< of the calibration scenes held out
  VisionScore score;                 ///< of the calibration scenes held out
};

/// @param takes of all seeds, one each; every other one is held out
CalibrationResult calibrate(std::span<const CalibrationTake> takes, const std::vector<std::uint64_t>& seeds,
                            double nearest_m, double farthest_m);

/// One row a range of depths, one for parts of balls.
std::string calibration_table(const CalibrationResult& result);

/// The content of calibration.json.
nlohmann::ordered_json calibration_json(const CalibrationResult& result);

/// The content of noise.yaml: what a scenario's believed_measurement_noise can name.
/// @param kind kScaled or kStereo
/// @param rig as it is believed to be, which the stereo law is about
std::string noise_yaml(const CalibrationResult& result, NoiseKind kind, const vision::StereoRig& rig);

}  // namespace stereobench::harness
