/// The page of a trajectory that was made elsewhere.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/experiment/types.h"
#include "harness/page/page.h"
#include "harness/trajectories/evaluation.h"

namespace stereobench::harness {

/// Gates, errors in tables and over time, and both paths on a map.
/// @param estimate, truth what they are called
/// @param words of the command line; empty: none is shown
Page evaluation_page(const Evaluation& evaluation, const std::string& estimate, const std::string& truth,
                     std::span<const Gate> gates, std::span<const std::string> words);

}  // namespace stereobench::harness
