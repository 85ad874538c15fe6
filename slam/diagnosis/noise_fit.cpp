#include "slam/diagnosis/noise_fit.h"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "slam/diagnosis/decided_log.h"
#include "slam/math/elementary.h"
#include "slam/models/noise_law.h"

namespace stereobench::slam {
namespace {

constexpr int kMostSteps = 20;
constexpr double kConverged = 0.1;  ///< squared length of a step, in standard deviations of the factors

/// The search also ends where no factor changes by more than 2 %. With coarse sensors the likelihood jumps
/// where the mode of a frame does, and the search would go to and fro over such a jump for ever.
constexpr double kFineStep = 0.02;

constexpr double kLongestStep = 1.0;  ///< of a factor's logarithm
constexpr double kPriorSd = 2.0;      ///< of a factor's logarithm, around 0

/// How far off the replays are that give slopes: far enough that rounding, and a frame that is linearised
/// elsewhere, do not show; near enough that the fourth derivative does not.
constexpr double kOff = 0.04;

FilterConfig told(const FilterConfig& config, const LogFactors& factors) {
  return without_floor(with_factors(config, factors));
}

using FrameLikelihoods = Eigen::VectorXd;  ///< natural logarithm, by frame

FrameLikelihoods likelihoods(const FilterConfig& config, const Pose& start, const DecidedLog& log) {
  std::vector<double> frames;
  replay(config, start, log, [&](const EkfSlam& filter, std::size_t) {
    double sum = 0.0;
    for (const ExpectedSighting& expected : filter.expected())
      if (expected.exists) sum += expected.log_likelihood;
    frames.push_back(sum);
  });
  return Eigen::Map<const FrameLikelihoods>(frames.data(), static_cast<Eigen::Index>(frames.size()));
}

/// @param by_frame slopes: a row a frame, a column a factor
Eigen::Matrix4d information_of(const LogFactors& curvature, const Eigen::MatrixXd& by_frame) {
  Eigen::Matrix4d products =
      Eigen::Matrix4d::Zero();  // added frame by frame: the same bits on every processor
  for (Eigen::Index k = 0; k < by_frame.rows(); ++k) {
    const LogFactors slope = by_frame.row(k);
    products += slope * slope.transpose();
  }
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (int i = 0; i < kNoiseFactors; ++i) {
    for (int j = 0; j < kNoiseFactors; ++j) {
      if (!(products(i, i) > 0.0) || !(products(j, j) > 0.0)) continue;
      const auto size = [&](int k) { return curvature[k] > 0.0 ? curvature[k] : products(k, k); };
      information(i, j) = products(i, j) * std::sqrt(size(i) / products(i, i) * size(j) / products(j, j));
    }
  }
  return information;
}

}  // namespace

FilterConfig with_factors(FilterConfig config, const LogFactors& factors) {
  const double speed = exponential(factors[0]), turn_rate = exponential(factors[1]);
  const Eigen::Vector2d sensor(exponential(factors[2]), exponential(factors[3]));
  OdometryNoise& odometry = config.odometry_noise;
  for (double* const sd : {&odometry.v_constant_mps, &odometry.v_per_v, &odometry.v_per_w}) *sd *= speed;
  for (double* const sd : {&odometry.w_constant_radps, &odometry.w_per_v, &odometry.w_per_w})
    *sd *= turn_rate;
  config.stated_sd_scale.array() *= sensor.array();
  if (config.noise_law) {
    config.noise_law->range_sd_m *= sensor[0];
    config.noise_law->range_sd_per_m2 *= sensor[0];
    config.noise_law->bearing_sd_rad *= sensor[1];
  }
  return config;
}

NoiseEvidence& NoiseEvidence::operator+=(const NoiseEvidence& other) {
  slope += other.slope;
  information += other.information;
  refused += other.refused;
  return *this;
}

NoiseEvidence noise_evidence(const FilterConfig& config, const Pose& start, std::span<const BatchStep> steps,
                             const LogFactors& factors) {
  const FilterConfig at = told(config, factors);
  const DecidedLog log = decide(at, start, steps);
  const FrameLikelihoods here = likelihoods(at, start, log);
  Eigen::MatrixXd by_frame(here.size(), kNoiseFactors);
  LogFactors curvature;
  for (int k = 0; k < kNoiseFactors; ++k) {
    const LogFactors off = LogFactors::Unit(k) * kOff;
    const FrameLikelihoods above = likelihoods(told(config, factors + off), start, log);
    const FrameLikelihoods below = likelihoods(told(config, factors - off), start, log);
    by_frame.col(k) = (above - below) / (2.0 * kOff);
    curvature[k] = -(above - 2.0 * here + below).sum() / (kOff * kOff);
  }
  return {.slope = by_frame.colwise().sum(),
          .information = information_of(curvature, by_frame),
          .refused = log.refused};
}

NoiseFit fit_noise(const std::function<NoiseEvidence(const LogFactors&)>& evidence_at) {
  constexpr double kPrior = 1.0 / (kPriorSd * kPriorSd);
  NoiseFit fit;
  for (;; ++fit.steps) {
    fit.evidence = evidence_at(fit.factors);
    const Eigen::Matrix4d information = fit.evidence.information + kPrior * Eigen::Matrix4d::Identity();
    fit.deviations = information.inverse().diagonal().cwiseSqrt();
    const LogFactors slope = fit.evidence.slope - kPrior * fit.factors;
    const LogFactors step = information.ldlt().solve(slope);
    if (!step.allFinite()) return fit;
    fit.factors += step.cwiseMax(-kLongestStep).cwiseMin(kLongestStep);
    fit.converged = step.dot(slope) < kConverged || step.cwiseAbs().maxCoeff() < kFineStep;
    if (fit.converged || fit.steps == kMostSteps) return fit;
  }
}

}  // namespace stereobench::slam
