#include "slam/diagnosis/sensor_sector.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "slam/association/frame_reader.h"
#include "slam/association/policy.h"
#include "slam/math/gaussian.h"
#include "slam/models/belief.h"
#include "slam/models/linearised.h"
#include "slam/models/measurement.h"

namespace stereobench::slam {
namespace {

constexpr double kWithinSector = 0.999;  ///< share of the sightings
constexpr double kWithin = 3.0;          ///< standard deviations between a place and the sector's border
constexpr long kFewestTriples = 50;      ///< that rates are read from
constexpr long kFewestFound = 10;        ///< of these in both frames
/// A sensor that is said to miss everything would make each sighting one of nothing.
constexpr double kMostMissed = 0.9;

/// A frame without what has an identity.
struct Look {
  std::vector<Sighting> sightings;
  PoseBelief from_last;  ///< the motion since the frame before
};

std::vector<Look> looks_of(const FilterConfig& config, std::span<const BatchStep> steps) {
  const Linearised model;
  FrameReader reader(config);
  FilterCounters counters;
  std::vector<Look> looks;
  PoseBelief motion;
  for (const BatchStep& step : steps) {
    for (const Control& control : step.controls)
      move(motion, model, control, config.odometry_noise, counters);
    if (std::ranges::all_of(step.sightings,
                            [](const RangeBearing& one) { return one.landmark_id != kUnknown; }))
      continue;
    Look look{reader.read(step.sightings, counters.rejected_inputs), std::exchange(motion, {})};
    std::erase_if(look.sightings, [](const Sighting& one) { return one.slot != kUnknown; });
    looks.push_back(std::move(look));
  }
  return looks;
}

/// @param index of range or bearing
/// @return what nearly all lie within
double extent(const std::vector<Look>& looks, int index) {
  std::vector<double> sizes;
  for (const Look& look : looks) {
    for (const Sighting& one : look.sightings)
      sizes.push_back(std::abs(one.observation.range_bearing[index]));
  }
  if (sizes.empty()) return 0.0;
  const auto last =
      static_cast<std::size_t>(std::ceil(kWithinSector * static_cast<double>(sizes.size() - 1)));
  std::ranges::nth_element(sizes, sizes.begin() + static_cast<std::ptrdiff_t>(last));
  return sizes[last];
}

/// What became of a sighting in a later frame.
enum class Fate { kOutside, kFound, kMissed };

/// @param motion since the sighting
Fate fate_of(const Sighting& sighting, const PoseBelief& motion, const Look& later,
             const SensorSector& sector, double gate) {
  const Linearised model;
  long repairs = 0;
  const LandmarkBelief there = model.found({}, sighting.observation, repairs);
  const PredictedMeasurement seen = model.expect(motion, there, sighting.observation, repairs);
  const Eigen::Vector2d sd = seen.covariance.diagonal().cwiseSqrt();
  if (seen.expected.x() + kWithin * sd.x() > sector.range_m ||
      std::abs(seen.expected.y()) + kWithin * sd.y() > sector.half_angle_rad)
    return Fate::kOutside;
  const Factor2 factor(seen.covariance, repairs);
  const bool found = std::ranges::any_of(later.sightings, [&](const Sighting& other) {
    const Eigen::Vector2d off = sighting_residual(other.observation.range_bearing, seen.expected);
    return other.colour_class == sighting.colour_class && factor.squared_length(off) <= gate;
  });
  return found ? Fate::kFound : Fate::kMissed;
}

void count(const Look& look, const Look& next, const Look& after, const SensorSector& sector, double gate,
           LookCounts& counts) {
  const PoseBelief to_after = follow(next.from_last, after.from_last);
  for (const Sighting& one : look.sightings) {
    const Fate first = fate_of(one, next.from_last, next, sector, gate);
    const Fate second = fate_of(one, to_after, after, sector, gate);
    if (first == Fate::kOutside || second == Fate::kOutside) continue;
    ++counts.triples;
    counts.once += first == Fate::kFound ? 1 : 0;
    counts.twice += first == Fate::kFound && second == Fate::kFound ? 1 : 0;
    counts.after_a_miss += first == Fate::kMissed && second == Fate::kFound ? 1 : 0;
  }
}

/// Solves the three equations for the rates; each is a probability, and so are the results.
///
/// @param per_look sightings, on average
void read_rates(const LookCounts& counts, double per_look, SensorSector& sector) {
  const auto share = [&](long some) {
    return static_cast<double>(some) / static_cast<double>(counts.triples);
  };
  const double seen = share(counts.twice) / share(counts.once);
  const double real = std::min(1.0, share(counts.once) / seen);
  const double missed = 1.0 - seen;
  const double again =
      real * missed > 0.0 ? std::min(1.0, share(counts.after_a_miss) / (real * missed)) : 1.0;
  sector.miss_probability = std::min(kMostMissed, std::max(missed, 1.0 - again));
  sector.false_per_look = (1.0 - real) * per_look;
}

}  // namespace

FoundSector find_sector(const FilterConfig& config, std::span<const BatchStep> steps) {
  const std::vector<Look> looks = looks_of(config, steps);
  FoundSector found;
  SensorSector sector{.range_m = extent(looks, 0), .half_angle_rad = extent(looks, 1)};
  if (!(sector.range_m > 0.0) || !(sector.half_angle_rad > 0.0)) return found;
  const double gate = AssociationPolicy(config).gate;
  std::size_t sightings = 0;
  for (const Look& look : looks) sightings += look.sightings.size();
  for (std::size_t k = 0; k + 2 < looks.size(); ++k)
    count(looks[k], looks[k + 1], looks[k + 2], sector, gate, found.looks);
  if (found.looks.triples < kFewestTriples || found.looks.twice < kFewestFound) return found;
  read_rates(found.looks, static_cast<double>(sightings) / static_cast<double>(looks.size()), sector);
  found.sector = sector;
  return found;
}

}  // namespace stereobench::slam
