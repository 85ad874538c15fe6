/// An evaluation to look at.
#pragma once

#include <string>

#include "harness/trajectories/evaluation.h"

namespace stereobench::harness {

/// Draws the position error over time. @return the bytes of a PNG file
std::string error_picture_of(const Evaluation& evaluation, const std::string& estimate);

/// Draws both paths from where they extend the most. @return the bytes of a PNG file
std::string path_picture_of(const Evaluation& evaluation, const std::string& estimate);

}  // namespace stereobench::harness
