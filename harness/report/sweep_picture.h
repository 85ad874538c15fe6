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
  std::vector<SweepCurve> detection;  ///< each in a panel of its own, since each has a unit of its own
  std::vector<SweepCurve> ate_m;      ///< one for each filter, in one panel below
};

/// Draws detection errors above and ATE below, against the varied parameter, with bars for the intervals.
/// @return the bytes of a PNG file
/// @throws std::invalid_argument when a curve has another length than `values`
std::string draw_sweep_picture(const SweepPicture& picture);

}  // namespace stereobench::harness
