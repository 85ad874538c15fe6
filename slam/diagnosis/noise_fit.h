/// Whether a log is as noisy as a filter was told.
#pragma once

#include <functional>
#include <span>

#include <Eigen/Core>

#include "slam/filter_config.h"
#include "slam/reference/batch.h"

namespace stereobench::slam {

/// Natural logarithms of factors on the standard deviations that a filter is told, of forward speed, turn
/// rate, range and bearing: 0 where it is told the truth.
using LogFactors = Eigen::Vector4d;
inline constexpr int kNoiseFactors = 4;

/// What logs say of factors on the noise: their log-likelihood to second order around some.
struct NoiseEvidence {
  LogFactors slope = LogFactors::Zero();
  /// Minus the second derivatives; rows of what logs cannot tell are zero.
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  long refused = 0;  ///< sightings that contradicted their landmarks and are left out

  NoiseEvidence& operator+=(const NoiseEvidence& other);
};

/// @return settings whose noise is larger by the factors, a noise law's as well
FilterConfig with_factors(FilterConfig config, const LogFactors& factors);

/// Replays a log with some factors on the noise and with each a little off.
///
/// The likelihood is the product of the densities of an iterated EKF's innovations (Schweppe, IEEE TAC 1965).
/// Which sighting is whose, and which are refused, is decided with the factors and then held fast, else it
/// would jump. What two factors share is taken from the slopes by frame (Berndt, Hall, Hall and Hausman,
/// 1974).
///
/// @param config as the filter is told
/// @param start world_from_robot before the first control
NoiseEvidence noise_evidence(const FilterConfig& config, const Pose& start, std::span<const BatchStep> steps,
                             const LogFactors& factors);

/// The factors that make logs most probable.
struct NoiseFit {
  LogFactors factors = LogFactors::Zero();
  NoiseEvidence evidence;  ///< around them
  /// Standard deviations of the factors' logarithms. A factor of which the log says nothing has 2, by which
  /// it was known beforehand.
  LogFactors deviations = LogFactors::Zero();
  int steps = 0;  ///< of the search
  bool converged = false;
};

/// Looks for the most probable factors by Newton's method, from what the filter is told. A factor that logs
/// hardly tell stays near 1: a priori each is within a factor of 7 in 68 % of cases.
///
/// The search ends a tenth of a squared standard deviation, or 2 %, before the maximum.
///
/// @param evidence_at the sum over logs of noise_evidence
NoiseFit fit_noise(const std::function<NoiseEvidence(const LogFactors&)>& evidence_at);

}  // namespace stereobench::slam
