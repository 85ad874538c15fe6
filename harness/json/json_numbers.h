/// Numbers as run.json has them: what does not exist is null.
#pragma once

#include <cmath>

#include <nlohmann/json.hpp>

#include "harness/statistics/statistics.h"

namespace stereobench::harness {

inline nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json summary_json(const Summary& summary) {
  return {{"mean", number(summary.mean)},
          {"sd", number(summary.sd)},
          {"max", number(summary.max)},
          {"ci95_half_width", number(summary.half_width)}};
}

}  // namespace stereobench::harness
