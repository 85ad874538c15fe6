/// Motion blur that is a row of copies, since its instants are too few.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace stereobench::harness {

/// Pairs whose motion blur is coarser than a pixel: shutter.most_samples is too few for them.
struct CoarseBlur {
  long pairs = 0;           ///< that are so
  double most_step_px = 0;  ///< of all pairs that are blurred, see ExposedFrame

  void add(double step_px);
  CoarseBlur& operator+=(const CoarseBlur& other);
};

/// As run.json and dataset.json have it.
nlohmann::ordered_json blur_json(const CoarseBlur& blur);

}  // namespace stereobench::harness
