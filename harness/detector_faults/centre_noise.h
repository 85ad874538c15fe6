/// Errors of centres: what is added to the pixels of a detection, and what becomes of its place.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include <Eigen/Core>

#include "harness/detector/ball_geometry.h"
#include "harness/experiment/detector_faults.h"

namespace stereobench::harness {

/// Columns and rows of the left camera, then of the right, px.
using CentreShift = Eigen::Vector4d;

/// The random part of the errors of centres. A ball's errors depend on its key and the frames' times alone,
/// and not on whether it was seen before.
class CentreNoise {
 public:
  /// @param stamps_ns of the drive's frames
  CentreNoise(const DetectorFaults& faults, std::uint64_t seed, std::vector<std::int64_t> stamps_ns);

  /// @param frame for each detection not before the one that was asked for last; others take longer
  /// @param detection see detection_key
  CentreShift at(std::size_t frame, std::uint64_t detection);

 private:
  /// Errors of sd 1 that last, at a frame.
  struct Lasting {
    std::size_t frame = 0;
    CentreShift shift = CentreShift::Zero();
  };
  CentreShift fresh(std::size_t frame, std::uint64_t detection) const;
  CentreShift lasting(std::size_t frame, std::uint64_t detection);

  DetectorFaults faults_;
  std::uint64_t seed_;
  std::vector<std::int64_t> stamps_ns_;
  std::map<std::uint64_t, Lasting> lasting_;  ///< by detection
};

/// Variance of each coordinate of a centre by what is random of the errors: noise with its tail, and rounding
/// (uniform), px^2.
double centre_variance_px2(const DetectorFaults& faults);

/// Whether anything moves centres.
bool moves_centres(const DetectorFaults& faults);

enum class CentreFate {
  kMoved,
  kLeft,  ///< it has no pixels that could be moved: no camera can see what is at its place
  kLost,  ///< its pixels are no ball's any more that is ahead
};

/// Moves a detection's centres: by the noise and the bias, to multiples of quantise_px. Its place moves by
/// the difference of what both pairs of centres triangulate to, so that a detector's own better estimate is
/// kept; range and bearing follow, and its covariance as `covariance` says.
/// @param noise of CentreNoise
/// @return what became of it; `seen` is as it was unless it was moved
CentreFate move_centres(const DetectorFaults& faults, const BallGeometry& geometry, const CentreShift& noise,
                        vision::BallObservation& seen);

}  // namespace stereobench::harness
