/// Whole balls by their depth: errors, beside what is stated of them and the least that there can be.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "harness/detector_noise/noise_fit.h"
#include "tests/studies/verdict.h"

namespace stereobench {

/// Looks around in calibration scenes before plain walls, balls of exactly 9 cm radius 0.5 to 15 m away.
/// @param seeds one calibration scene each
std::vector<Section> study_depths(const std::vector<std::uint64_t>& seeds, int jobs);

/// The same with balls that are made to a millimetre, whose size tells next to nothing.
Section study_tolerance(const std::vector<std::uint64_t>& seeds, int jobs);

/// A section for each thing that is measured, a line for each range of depths. Parts of balls are left out.
std::vector<Section> depth_sections(std::span<const harness::CalibrationBin> bins);

}  // namespace stereobench
