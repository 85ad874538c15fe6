#include "slam/fastslam/predictive_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "slam/math/elementary.h"
#include "slam/math/gaussian.h"
#include "slam/math/moments.h"
#include "slam/models/measurement.h"

namespace stereobench::slam {
namespace {

/// A frame beside what all particles made of it.
struct Expectations {
  std::span<const Sighting> frame;
  std::span<const Target> targets;
  std::span<const ExpectedSighting> expected;

  std::size_t at(std::size_t particle, std::size_t sighting) const {
    return particle * frame.size() + sighting;
  }
};

std::size_t heaviest(std::span<const double> log_weights) {
  return static_cast<std::size_t>(std::max_element(log_weights.begin(), log_weights.end()) -
                                  log_weights.begin());
}

/// The sightings in the order in which a particle used them, and after them those that it did not.
std::vector<std::size_t> order_of(const Expectations& all, std::size_t particle) {
  std::vector<std::pair<int, std::size_t>> by_age;
  for (std::size_t k = 0; k < all.frame.size(); ++k) {
    const std::size_t at = all.at(particle, k);
    const int age = all.expected[at].exists ? all.targets[at].landmark : std::numeric_limits<int>::max();
    by_age.emplace_back(age, k);
  }
  std::sort(by_age.begin(), by_age.end());
  std::vector<std::size_t> order;
  for (const auto& [age, k] : by_age) order.push_back(k);
  return order;
}

/// What the heaviest of the particles expects that expect anything.
Eigen::Vector2d centre_of(const Expectations& all, std::size_t k, std::span<const double> log_weights) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < log_weights.size(); ++i) {
    const bool better = log_weights[i] > log_weights[best] || !all.expected[all.at(best, k)].exists;
    if (all.expected[all.at(i, k)].exists && better) best = i;
  }
  return all.expected[all.at(best, k)].range_bearing;
}

/// @param log_weights of the particles before the sighting, up to a constant
/// @return nothing when it was not expected
std::optional<NormalisedInnovation> innovation(const Expectations& all, std::size_t k,
                                               std::span<const double> log_weights) {
  const double largest = log_weights[heaviest(log_weights)];
  const Eigen::Vector2d centre = centre_of(all, k, log_weights);
  Moments<2> moments;
  double total = 0.0;
  double refusing = 0.0;
  for (std::size_t i = 0; i < log_weights.size(); ++i) {
    const double weight = exponential(log_weights[i] - largest);
    if (!(weight > 0.0)) continue;
    total += weight;
    const ExpectedSighting& one = all.expected[all.at(i, k)];
    if (!one.exists) continue;
    moments.add(weight, sighting_residual(one.range_bearing, centre), one.covariance);
    if (all.targets[all.at(i, k)].outcome != Outcome::kUse) refusing += weight;
  }
  if (!(moments.total >= 0.5 * total) || !(total > 0.0)) return {};
  const Eigen::Vector2d mean = centre + moments.mean();
  long repaired = 0;  // of a report alone
  const double squared_length =
      Factor2(moments.covariance(), repaired)
          .squared_length(sighting_residual(all.frame[k].observation.range_bearing, mean));
  if (!std::isfinite(squared_length)) return {};
  return NormalisedInnovation{all.frame[k].index, squared_length, refusing >= 0.5 * moments.total};
}

}  // namespace

std::vector<NormalisedInnovation> normalised_innovations(std::span<const Sighting> frame,
                                                         std::span<const Target> targets,
                                                         std::span<const ExpectedSighting> expected,
                                                         std::span<const double> log_weights) {
  const Expectations all{frame, targets, expected};
  std::vector<double> weights(log_weights.begin(), log_weights.end());
  std::vector<NormalisedInnovation> innovations;
  for (const std::size_t k : order_of(all, heaviest(log_weights))) {
    if (const auto one = innovation(all, k, weights)) innovations.push_back(*one);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double worth = expected[all.at(i, k)].log_likelihood;
      weights[i] = std::isnan(worth) ? -std::numeric_limits<double>::infinity() : weights[i] + worth;
    }
  }
  return innovations;
}

}  // namespace stereobench::slam
