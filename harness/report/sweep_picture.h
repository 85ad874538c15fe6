/// What varying one parameter does to detection and to the filters.
#pragma once

#include <string>
#include <vector>

namespace stereobench::harness {

/// A mean with the ends of its 95 % interval; NaN: not known, not drawn.
struct MeanInterval {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// A quantity at each varied value.
struct SweepCurve {
  std::string name;                  ///< a filter's name, or e.g. "range rms [mm]"
  std::vector<MeanInterval> values;  ///< aligned with SweepPicture::values
};

struct SweepPicture {
  std::string title;
  std::string parameter;              ///< label of the horizontal axis, e.g. "camera.noise_sd_levels"
  std::vector<std::string> values;    ///< as the user wrote them; numeric axis when all of them are numbers
  bool log_parameter = false;         ///< needs numbers > 0, others are left out
  std::vector<SweepCurve> detection;  ///< at most two: the first is read on the left, the second on the right
  std::vector<SweepCurve> ate_m;      ///< one for each filter
};

/// Draws detection error above and ATE below, against the varied parameter.
/// @return the bytes of a PNG file
/// @throws std::invalid_argument when a curve has another length than `values`, or detection has over two
std::string draw_sweep_picture(const SweepPicture& picture);

}  // namespace stereobench::harness
