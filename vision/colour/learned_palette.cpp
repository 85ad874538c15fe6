#include "vision/colour/learned_palette.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <Eigen/LU>

#include "slam/math/elementary.h"
#include "vision/tuning/colours.h"

namespace stereobench::vision {
namespace {

/// The half of a Gaussian's points that lies closest to its mean has the whole's covariance over this:
/// P(chi2(2) <= m) / P(chi2(4) <= m), m the median of chi2(2).
constexpr double kHalfToWhole = 3.26;

const Eigen::Vector2d& grey() {
  static const Eigen::Vector2d value(1.0 / 3.0, 1.0 / 3.0);
  return value;
}

/// IEC 61966-2-1: level / 255 = 1.055 light^(1 / 2.4) - 0.055.
constexpr double kSrgbOffset_levels = 0.055 * 255.0;

/// The chromaticity of light, or of its power.
Eigen::Vector2d chromaticity_of(const Eigen::Vector3d& bgr, Levels levels) {
  const double offset = levels == Levels::kSrgb ? kSrgbOffset_levels : 0.0;
  return Eigen::Vector2d(bgr[2] + offset, bgr[1] + offset) / std::max(bgr.sum() + 3.0 * offset, 1.0);
}

bool has_colour(const Eigen::Vector3d& bgr, Levels levels) {
  return bgr.maxCoeff() >= kLearnedColours.least_level &&
         (chromaticity_of(bgr, levels) - grey()).norm() >= kLearnedColours.least_saturation;
}

struct Gaussian {
  Eigen::Vector2d mean;
  Eigen::Matrix2d covariance;

  double squared_deviations(const Eigen::Vector2d& at) const {
    const Eigen::Vector2d error = at - mean;
    return error.dot(covariance.inverse() * error);
  }
};

Gaussian gaussian_of(const std::vector<Eigen::Vector2d>& points, const std::vector<std::size_t>& chosen) {
  Gaussian result{Eigen::Vector2d::Zero(),
                  kLearnedColours.floor * kLearnedColours.floor * Eigen::Matrix2d::Identity()};
  const double share = 1.0 / static_cast<double>(chosen.size());
  for (const std::size_t i : chosen) result.mean += share * points[i];
  for (const std::size_t i : chosen)
    result.covariance += share * (points[i] - result.mean) * (points[i] - result.mean).transpose();
  return result;
}

/// Rousseeuw and Van Driessen's concentration steps (FAST-MCD) from the component-wise median.
Gaussian closest_half(const std::vector<Eigen::Vector2d>& points) {
  const std::size_t half = (points.size() + 1) / 2;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Gaussian current{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity()};
  for (int axis = 0; axis < 2; ++axis) {
    const auto middle = order.begin() + static_cast<long>(points.size() / 2);
    std::nth_element(order.begin(), middle, order.end(),
                     [&](auto a, auto b) { return points[a][axis] < points[b][axis]; });
    current.mean[axis] = points[*middle][axis];
  }
  for (int step = 0; step < kLearnedColours.concentrations; ++step) {
    std::vector<double> distances(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) distances[i] = current.squared_deviations(points[i]);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) {
      return distances[a] != distances[b] ? distances[a] < distances[b] : a < b;
    });
    current = gaussian_of(points, {order.begin(), order.begin() + static_cast<long>(half)});
  }
  return current;
}

}  // namespace

LearnedColour learn_colour(const std::string& name, std::span<const Eigen::Vector3d> bgr, Levels levels) {
  if (bgr.size() < kLearnedColours.fewest_pixels)
    throw std::invalid_argument(name + ": expected samples of at least 20 pixels");
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector3d> coloured;
  for (const Eigen::Vector3d& pixel : bgr) {
    if (!has_colour(pixel, levels)) continue;
    points.push_back(chromaticity_of(pixel, levels));
    coloured.push_back(pixel);
  }
  if (2 * points.size() < bgr.size()) throw std::invalid_argument(name + ": the samples have no colour");
  Gaussian half = closest_half(points);
  half.covariance *= kHalfToWhole;
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (half.squared_deviations(points[i]) <= kLearnedColours.gate_sds * kLearnedColours.gate_sds)
      inside.push_back(i);
  const Gaussian all = gaussian_of(points, inside);

  LearnedColour colour{name, all.mean, all.covariance};
  std::vector<double> brightest;
  for (const std::size_t i : inside) {
    brightest.push_back(coloured[i].maxCoeff());
    colour.bgr += coloured[i] / static_cast<double>(inside.size());
  }
  std::sort(brightest.begin(), brightest.end());
  const auto rank =
      static_cast<std::size_t>(kLearnedColours.darkest_share * static_cast<double>(brightest.size()));
  colour.darkest_level = kLearnedColours.darker * brightest[rank];
  return colour;
}

double deviations_from(const LearnedColour& colour, const Eigen::Vector2d& chromaticity) {
  return std::sqrt(Gaussian{colour.chromaticity, colour.covariance}.squared_deviations(chromaticity));
}

double separation(const LearnedColour& a, const LearnedColour& b) {
  const Eigen::Vector2d apart = b.chromaticity - a.chromaticity;
  if (apart.isZero(0.0)) return 0.0;
  const double of_a = 1.0 / std::sqrt(apart.dot(a.covariance.inverse() * apart));
  const double of_b = 1.0 / std::sqrt(apart.dot(b.covariance.inverse() * apart));
  return 1.0 / (of_a + of_b);
}

ColourTable table_of(std::span<const LearnedColour> colours, Levels levels) {
  if (colours.size() >= kBackground) throw std::invalid_argument("a palette has at most 254 colours");
  return ColourTable([&](const Eigen::Vector3d& bgr) {
    const Eigen::Vector2d at = chromaticity_of(bgr, levels);
    std::uint8_t best = kBackground;
    double least = 0.0;
    for (std::size_t i = 0; i < colours.size(); ++i) {
      const LearnedColour& colour = colours[i];
      const Gaussian gaussian{colour.chromaticity, colour.covariance};
      const double squared = gaussian.squared_deviations(at);
      const double from_grey = (at - grey()).norm();
      const bool is_possible = squared <= kLearnedColours.gate_sds * kLearnedColours.gate_sds &&
                               bgr.maxCoeff() >= colour.darkest_level &&
                               from_grey >= kLearnedColours.from_grey * (colour.chromaticity - grey()).norm();
      const double unlikely = squared + slam::logarithm(colour.covariance.determinant());
      if (!is_possible || (best != kBackground && unlikely >= least)) continue;
      best = static_cast<std::uint8_t>(i);
      least = unlikely;
    }
    return best;
  });
}

}  // namespace stereobench::vision
