#include "vision/outline/light_source.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "vision/tuning/shading.h"

namespace stereobench::vision {
namespace {

// How (c0, l) becomes l - m c0.
Eigen::Matrix<double, 3, 4> beyond_ratio(const Eigen::Vector3d& ratio) {
  Eigen::Matrix<double, 3, 4> beyond;
  beyond << -ratio, Eigen::Matrix3d::Identity();
  return beyond;
}

// Of a ball's m, its c0 being unknown too.
Eigen::Matrix3d ratio_covariance(const Eigen::Matrix4d& information, const Eigen::Vector4d& colours,
                                 double noise_variance) {
  const Eigen::Matrix<double, 3, 4> beyond = beyond_ratio(colours.tail<3>() / colours[0]);
  return beyond * information.inverse() * beyond.transpose() * (noise_variance / (colours[0] * colours[0]));
}

}  // namespace

SharedLightSource::SharedLightSource(const Eigen::Matrix3d& ratio,
                                     const std::array<Eigen::Matrix3d, 3>& information)
    : ratio_(ratio) {
  for (int channel = 0; channel < 3; ++channel) {
    const auto i = static_cast<std::size_t>(channel);
    const Eigen::Matrix<double, 3, 4> beyond = beyond_ratio(ratio.col(channel));
    information_[i] = beyond.transpose() * information[i] * beyond;
  }
}

LightColours SharedLightSource::colours(const Eigen::Matrix4d& information,
                                        const LightColours& products) const {
  LightColours colours;
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::Matrix4d both = information + information_[static_cast<std::size_t>(channel)];
    colours.col(channel) = both.inverse() * products.col(channel);
  }
  return colours;
}

void LightSourcePool::count(const BallLight& light, double sign) {
  if (!light.shows_light_source) return;
  const Eigen::Matrix3d least_scatter =
      kLightSource.least_scatter * kLightSource.least_scatter * Eigen::Matrix3d::Identity();
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::Vector4d colours = light.colours.col(channel);
    if (!(colours[0] > kLightSource.dark_sigmas * std::sqrt(noise_variance_))) continue;
    const Eigen::Vector3d ratio = colours.tail<3>() / colours[0];
    const Eigen::Matrix3d information =
        (ratio_covariance(light.information, colours, noise_variance_) + least_scatter).inverse();
    Channel& sums = channels_[static_cast<std::size_t>(channel)];
    sums.information += sign * information;
    sums.information2 += sign * information * information;
    sums.evidence += sign * information * ratio;
    sums.squares += sign * ratio.dot(information * ratio);
    sums.balls += sign;
  }
}

bool LightSourcePool::tells_light_source(const BallLight& light) const {
  Eigen::Index brightest = 0;
  const double c0 = light.colours.row(0).maxCoeff(&brightest);
  if (!light.shows_light_source || !(c0 > 0.0) || !(light.information(0, 0) > kLightSource.many_samples))
    return false;
  return ratio_covariance(light.information, light.colours.col(brightest), noise_variance_).trace() <
         kLightSource.well_known * kLightSource.well_known;
}

std::optional<SharedLightSource> LightSourcePool::without(const BallLight& own) const {
  if (tells_light_source(own)) return std::nullopt;
  LightSourcePool others = *this;
  others.count(own, -1.0);
  Eigen::Matrix3d ratio = Eigen::Matrix3d::Zero();
  std::array<Eigen::Matrix3d, 3> information;
  information.fill(Eigen::Matrix3d::Zero());
  bool is_known = false;
  for (int channel = 0; channel < 3; ++channel) {
    const auto i = static_cast<std::size_t>(channel);
    const Channel& sums = others.channels_[i];
    if (sums.balls < kLightSource.fewest_balls) continue;
    const Eigen::Matrix3d of_mean = sums.information.inverse();
    ratio.col(channel) = of_mean * sums.evidence;
    const double scatter = sums.squares - sums.evidence.dot(ratio.col(channel));
    const double by_chance = 3.0 * (sums.balls - 1.0);
    const double weight = (sums.information - of_mean * sums.information2).trace();
    const double between = weight > 0.0 ? std::max(0.0, scatter - by_chance) / weight : 0.0;
    const double spread = between + kLightSource.least_scatter * kLightSource.least_scatter;
    const double levels2 = std::max(noise_variance_, own.colours(0, channel) * own.colours(0, channel));
    information[i] = (of_mean + spread * Eigen::Matrix3d::Identity()).inverse() * (noise_variance_ / levels2);
    is_known = true;
  }
  if (!is_known) return std::nullopt;
  return SharedLightSource(ratio, information);
}

}  // namespace stereobench::vision
