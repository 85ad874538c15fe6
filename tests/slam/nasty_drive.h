// A short drive through everything that a filter should survive, made from a seed.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "slam/filter_config.h"
#include "slam/math/random.h"
#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::slam {

struct NastyStep {
  std::vector<Control> controls;
  std::vector<std::vector<RangeBearing>> frames;  // the step's own, and some that come late or twice
  int impossible = 0;                             // controls and sightings that cannot be
};

// Noise from none to a million times what it should be, of the odometry (so that P is 0, of rank 1, 2 or 3),
// of the sensor and in what the filter believes of either; ranges of 0 and of a thousand kilometres; standing
// still, turning on the spot, driving straight on; landmarks known by identity, by colour, by both or by
// nothing, twice in a frame, seen where others are; frames that come late, twice or shuffled; and numbers
// that are none.
class NastyDrive {
 public:
  explicit NastyDrive(std::uint64_t seed) : random_(seed, Stream::kWorld) {
    config.odometry_noise = {0.1 * scale(), 0.05 * scale(), 0.0, 0.05 * scale(), 0.0, 0.02 * scale()};
    config.odometry_noise.correlation_s = pick<3>({0.0, 0.1, 1e3});
    config.range_floor_m = pick<3>({1e-3, 1e-3, 0.0});
    config.bearing_floor_rad = pick<3>({5e-5, 5e-5, 0.0});
    config.resample_below = pick<3>({0.0, 0.5, 1.0});
    config.gate_probability = pick<3>({0.9999, 0.5, 1.0});
    config.draw_every = 1 + static_cast<int>(seed % 7);
    config.colour_spacing_m = pick<2>({0.0, 4.0});
    if (one_in(3)) config.noise_law = {0.1 * scale(), 0.01 * scale(), 0.02 * scale()};
    for (Eigen::Vector2d& place : places_) place << 8.0 * random_.normal(), 8.0 * random_.normal();
    for (int k = 0; k < 20; ++k) steps.push_back(step());
  }

  FilterConfig config;
  std::vector<NastyStep> steps;

 private:
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  bool one_in(int n) { return random_.uniform() * n < 1.0; }
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(random_.uniform() * static_cast<double>(n));
  }
  template <std::size_t kSize>
  double pick(const std::array<double, kSize>& values) {
    return values[below(kSize)];
  }
  double scale() { return pick<6>({0.0, 1e-6, 1.0, 1.0, 1.0, 1e6}); }

  NastyStep step() {
    NastyStep next;
    for (std::size_t i = below(4); i > 0; --i) {
      Control control{pick<5>({0.0, 1.0, -1.0, 0.3, 1e3}), pick<6>({0.0, 0.0, 1e-12, 0.4, -3.0, 1e3}),
                      pick<4>({0.0, 0.1, 0.5, 1e-9})};
      truth_ = advance(truth_, control);
      if (one_in(20)) {
        control.duration_s = pick<3>({-0.5, kNan, kInfinity});
        ++next.impossible;
      }
      next.controls.push_back(control);
    }
    next.frames.push_back(frame(next.impossible));
    if (one_in(4) && !steps.empty()) {  // out of order: what was seen some steps before, or this once more
      const NastyStep& late = one_in(4) ? next : steps[below(steps.size())];
      next.frames.push_back(late.frames.front());
      next.impossible += impossible_in(next.frames.back());
    }
    return next;
  }

  std::vector<RangeBearing> frame(int& impossible) {
    std::vector<RangeBearing> seen;
    for (std::size_t i = below(6); i > 0; --i) seen.push_back(sighting());
    if (!seen.empty() && one_in(3)) seen.push_back(seen[below(seen.size())]);
    impossible += impossible_in(seen);
    return seen;
  }

  static int impossible_in(const std::vector<RangeBearing>& frame) {
    int count = 0;
    for (const RangeBearing& seen : frame) count += is_valid(seen) ? 0 : 1;
    return count;
  }

  RangeBearing sighting() {
    const std::size_t which = below(places_.size());
    const Eigen::Vector2d exact = predict_sighting(truth_, places_[which]);
    const double a = 0.1 * scale(), b = 0.02 * scale();
    RangeBearing seen;
    seen.range_m = std::abs(exact.x() + std::fmin(a, 10.0) * random_.normal());
    seen.bearing_rad = exact.y() + std::fmin(b, 1.0) * random_.normal();
    if (one_in(8)) seen.range_m = pick<4>({0.0, 1e-9, 1e6, 3.0});
    if (one_in(8)) seen.bearing_rad = pick<4>({M_PI, -M_PI, 7.0, 1e6});
    const double correlation = pick<4>({0.0, 0.0, 0.5, -1.0});
    seen.covariance << a * a, correlation * a * b, correlation * a * b, b * b;
    if (!one_in(3)) seen.landmark_id = static_cast<int>(which);
    if (!one_in(3)) seen.colour_class = static_cast<int>(which % 3);
    if (one_in(30)) seen.range_m = pick<3>({kNan, -1.0, kInfinity});
    if (one_in(30)) seen.bearing_rad = pick<2>({kNan, kInfinity});
    if (one_in(30)) seen.covariance(0, 0) = pick<2>({-1.0, kNan});
    return seen;
  }

  RandomStream random_;
  std::array<Eigen::Vector2d, 9> places_;
  Pose truth_;
};

}  // namespace stereobench::slam
