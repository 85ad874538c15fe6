#include "slam/models/measurement.h"

namespace stereobench::slam {

bool is_valid(const RangeBearing& sighting) {
  const Eigen::Matrix2d& r = sighting.covariance;
  if (!std::isfinite(sighting.range_m) || !std::isfinite(sighting.bearing_rad) || !r.allFinite() ||
      !sighting.sd_scale.allFinite())
    return false;
  if (sighting.range_m < 0.0 || r(0, 0) < 0.0 || r(1, 1) < 0.0 || sighting.sd_scale.minCoeff() <= 0.0)
    return false;
  const double scale = std::sqrt(r(0, 0) * r(1, 1));
  constexpr double kRounding = 1e-9;
  return std::abs(r(0, 1) - r(1, 0)) <= kRounding * scale && std::abs(r(0, 1)) <= (1.0 + kRounding) * scale;
}

}  // namespace stereobench::slam
