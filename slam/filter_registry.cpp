#include "slam/filter_registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <Eigen/Eigenvalues>

#include "slam/block/block_slam.h"
#include "slam/dead_reckoning.h"
#include "slam/ekf/ekf_slam.h"
#include "slam/fastslam/fast_slam.h"
#include "slam/from_uncertain_start.h"
#include "slam/models/noise_law.h"
#include "slam/smoother/smoother.h"

namespace stereobench::slam {
namespace {

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("make_filter: ") + what);
}

bool is_sd(double value) {
  return std::isfinite(value) && value >= 0.0;
}

bool is_covariance(const Eigen::Matrix3d& matrix) {
  constexpr double kRounding = 1e-9;
  if (!matrix.allFinite() || !matrix.isApprox(matrix.transpose(), kRounding)) return false;
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix).eigenvalues();
  return values.minCoeff() >= -kRounding * std::abs(values.maxCoeff());
}

void check(const OdometryNoise& noise) {
  require(is_sd(noise.v_constant_mps) && is_sd(noise.v_per_v) && is_sd(noise.v_per_w) &&
              is_sd(noise.w_constant_radps) && is_sd(noise.w_per_v) && is_sd(noise.w_per_w),
          "odometry_noise must be finite and >= 0");
}

void check(const SensorSector& sector) {
  require(is_sd(sector.range_m) && is_sd(sector.half_angle_rad) && is_sd(sector.false_per_look),
          "sector must be finite and >= 0");
  require((sector.range_m > 0.0) == (sector.half_angle_rad > 0.0),
          "sector must have both a range and an angle, or neither");
  require(sector.miss_probability >= 0.0 && sector.miss_probability <= 1.0,
          "sector.miss_probability must be in [0, 1]");
}

void check(const FilterConfig& config) {
  check(config.odometry_noise);
  require(config.particles >= 1, "particles must be >= 1");
  require(config.draw_every >= 1, "draw_every must be >= 1");
  require(is_sd(config.range_floor_m) && is_sd(config.bearing_floor_rad),
          "noise floors must be finite and >= 0");
  require(config.resample_below >= 0.0 && config.resample_below <= 1.0, "resample_below must be in [0, 1]");
  require(config.gate_probability > 0.0 && config.gate_probability <= 1.0,
          "gate_probability must be in (0, 1]");
  require(is_sd(config.colour_spacing_m), "colour_spacing_m must be finite and >= 0");
  if (const auto& law = config.noise_law) {
    require(is_sd(law->range_sd_m) && is_sd(law->range_sd_per_m2) && is_sd(law->bearing_sd_rad),
            "noise_law must be finite and >= 0");
  }
  check(config.sector);
  require(is_covariance(config.start_covariance), "start_covariance must be finite and semidefinite");
  const UnscentedParameters& unscented = config.unscented;
  require(std::isfinite(unscented.alpha) && unscented.alpha > 0.0, "unscented.alpha must be > 0");
  require(std::isfinite(unscented.beta) && std::isfinite(unscented.kappa) && unscented.kappa > -2.0,
          "unscented.beta and kappa must be finite, kappa > -2");
}

/// One row a filter: name, title, whether it maps landmarks, whether it is usual, how it starts.
constexpr auto kKinds = std::to_array<FilterKind>({
    {"dead_reckoning", "dead reckoning", false, true,
     [](const FilterConfig& config, const Pose& start, std::uint64_t) -> Filter {
       return DeadReckoning(config, start);
     }},
    {"ekf", "EKF-SLAM", true, false,
     [](const FilterConfig& config, const Pose& start, std::uint64_t) -> Filter {
       return EkfSlam(config, start);
     }},
    {"iekf", "iterated EKF-SLAM", true, false,
     [](const FilterConfig& config, const Pose& start, std::uint64_t) -> Filter {
       return EkfSlam(without_floor(config), start, Linearisation::kIterated);
     }},
    {"smoother", "incremental smoothing", true, true,
     [](const FilterConfig& config, const Pose& start, std::uint64_t) -> Filter {
       return Smoother(without_floor(config), start);
     }},
    {"fastslam1", "FastSLAM 1.0", true, false,
     [](const FilterConfig& config, const Pose& start, std::uint64_t seed) -> Filter {
       return LinearisedFastSlam(config, start, seed, Proposal::kMotion);
     }},
    {"fastslam2", "FastSLAM 2.0", true, false,
     [](const FilterConfig& config, const Pose& start, std::uint64_t seed) -> Filter {
       return LinearisedFastSlam(config, start, seed, Proposal::kPosterior);
     }},
    {"ufastslam", "UFastSLAM", true, false,
     [](const FilterConfig& config, const Pose& start, std::uint64_t seed) -> Filter {
       return UnscentedFastSlam(config, start, seed, Proposal::kPosterior);
     }},
    {"fastslam2_iterated", "FastSLAM 2.0, iterated", true, true,
     [](const FilterConfig& config, const Pose& start, std::uint64_t seed) -> Filter {
       return LinearisedFastSlam(with_low_floor(config), start, seed, Proposal::kPosterior,
                                 Updates::kIterated);
     }},
    {"ufastslam_iterated", "UFastSLAM, iterated", true, true,
     [](const FilterConfig& config, const Pose& start, std::uint64_t seed) -> Filter {
       return UnscentedFastSlam(with_low_floor(config), start, seed, Proposal::kPosterior,
                                Updates::kIterated);
     }},
    {"ufastslam_kim", "UFastSLAM, stacked", true, false,
     [](const FilterConfig& config, const Pose& start, std::uint64_t seed) -> Filter {
       return UnscentedFastSlam(config, start, seed, Proposal::kPosterior, Updates::kAtOnce);
     }},
    {"fastslam2_block", "FastSLAM 2.0 in blocks", true, false,
     [](const FilterConfig& config, const Pose& start, std::uint64_t seed) -> Filter {
       return BlockSlam(without_floor(config), start, seed, Linearisation::kIterated);
     }},
    {"ufastslam_block", "UFastSLAM in blocks", true, false,
     [](const FilterConfig& config, const Pose& start, std::uint64_t seed) -> Filter {
       return BlockSlam(without_floor(config), start, seed, Linearisation::kSigmaPoints);
     }},
});

}  // namespace

std::span<const FilterKind> filter_kinds() {
  return kKinds;
}

const FilterKind* find_filter_kind(std::string_view name) {
  const auto* const found = std::ranges::find(kKinds, name, &FilterKind::name);
  return found == kKinds.end() ? nullptr : found;
}

std::vector<std::string> filter_names() {
  std::vector<std::string> names;
  for (const FilterKind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

std::vector<std::string> usual_filter_names() {
  std::vector<std::string> names;
  for (const FilterKind& kind : kKinds)
    if (kind.is_usual) names.emplace_back(kind.name);
  return names;
}

Filter make_filter(const std::string& name, const FilterConfig& config, const Pose& start,
                   std::uint64_t seed) {
  check(config);
  require(std::isfinite(start.x_m) && std::isfinite(start.y_m) && std::isfinite(start.heading_rad),
          "the start pose must be finite");
  if (const FilterKind* const kind = find_filter_kind(name)) {
    Filter filter = kind->start(config, start, seed);
    if (config.start_covariance.isZero(0.0)) return filter;
    return FromUncertainStart(std::move(filter), UncertainStart(start, config.start_covariance));
  }
  std::string known;
  for (const std::string& filter : filter_names()) known += (known.empty() ? "" : ", ") + filter;
  throw std::invalid_argument("make_filter: no filter '" + name + "'; there are " + known);
}

}  // namespace stereobench::slam
