#include "harness/drive/coarse_blur.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace stereobench::harness {

void CoarseBlur::add(double step_px) {
  constexpr double kSmooth_px = 1.0;
  if (step_px > kSmooth_px) ++pairs;
  most_step_px = std::max(most_step_px, step_px);
}

CoarseBlur& CoarseBlur::operator+=(const CoarseBlur& other) {
  pairs += other.pairs;
  most_step_px = std::max(most_step_px, other.most_step_px);
  return *this;
}

nlohmann::ordered_json blur_json(const CoarseBlur& blur) {
  return {{"coarse_pairs", blur.pairs}, {"most_step_px", blur.most_step_px}};
}

}  // namespace stereobench::harness
