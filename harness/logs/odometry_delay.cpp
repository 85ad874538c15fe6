#include "harness/logs/odometry_delay.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "slam/models/measurement.h"
#include "slam/models/motion.h"

namespace stereobench::harness {
namespace {

constexpr std::int64_t kGrid_ns = 10'000'000;
constexpr std::int64_t kCoarseGrid_ns = 5 * kGrid_ns;
constexpr std::int64_t kEarliest_ns = -500'000'000;
constexpr std::int64_t kLatest_ns = 1'000'000'000;

/// Sightings closer than this share most of the sensor's error; beyond the other the odometry's grows.
constexpr std::int64_t kLeastApart_ns = 300'000'000;
constexpr std::int64_t kMostApart_ns = 1'000'000'000;

/// The odometry added up, so that the motion between any two instants is two look-ups.
class OdometryPath {
 public:
  explicit OdometryPath(const std::vector<OdometryReading>& readings) : readings_(readings) {
    poses_.reserve(readings.size());
    slam::Pose pose;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (i > 0) pose = advance_from(pose, i - 1, readings[i].stamp_ns);
      poses_.push_back(pose);
    }
  }

  slam::Pose at(std::int64_t stamp_ns) const {
    const auto later = [](std::int64_t stamp, const OdometryReading& r) { return stamp < r.stamp_ns; };
    const auto next = std::upper_bound(readings_.begin(), readings_.end(), stamp_ns, later);
    if (next == readings_.begin()) return {};
    const auto held = static_cast<std::size_t>(next - readings_.begin()) - 1;
    return advance_from(poses_[held], held, stamp_ns);
  }

 private:
  slam::Pose advance_from(const slam::Pose& pose, std::size_t held, std::int64_t to_ns) const {
    const OdometryReading& reading = readings_[held];
    const double duration_s = 1e-9 * static_cast<double>(to_ns - reading.stamp_ns);
    return slam::advance(pose, {reading.v_mps, reading.w_radps, duration_s, reading.lateral_mps});
  }

  const std::vector<OdometryReading>& readings_;
  std::vector<slam::Pose> poses_;
};

/// Two sightings of one landmark.
struct Pair {
  const LoggedSighting* earlier;
  const LoggedSighting* later;
};

std::vector<Pair> pairs_of(const std::vector<LoggedSighting>& sightings) {
  std::map<int, const LoggedSighting*> waiting;  // by landmark
  std::vector<Pair> pairs;
  for (const LoggedSighting& sighting : sightings) {
    if (sighting.measurement.landmark_id < 0) continue;
    const LoggedSighting*& earlier = waiting[sighting.measurement.landmark_id];
    if (earlier && sighting.stamp_ns - earlier->stamp_ns < kLeastApart_ns) continue;
    if (earlier && sighting.stamp_ns - earlier->stamp_ns <= kMostApart_ns)
      pairs.push_back({earlier, &sighting});
    earlier = &sighting;
  }
  return pairs;
}

/// How far the odometry's prediction of each later bearing is off, if the motion follows by a delay.
std::vector<double> bearing_errors(const std::vector<Pair>& pairs, const OdometryPath& path,
                                   std::int64_t delay_ns) {
  std::vector<double> errors;
  errors.reserve(pairs.size());
  for (const auto& [earlier, later] : pairs) {
    const slam::Pose then = path.at(earlier->stamp_ns - delay_ns);
    const slam::Pose now = path.at(later->stamp_ns - delay_ns);
    const slam::RangeBearing& seen = earlier->measurement;
    const Eigen::Vector2d place = slam::locate(then, {seen.range_m, seen.bearing_rad});
    const double expected_rad = slam::predict_sighting(now, place).y();
    errors.push_back(std::abs(slam::wrap_angle(later->measurement.bearing_rad - expected_rad)));
  }
  return errors;
}

double sum(const std::vector<double>& values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

/// The delay on a grid whose errors add up to the least.
std::int64_t best_delay_ns(const std::vector<Pair>& pairs, const OdometryPath& path, std::int64_t from_ns,
                           std::int64_t to_ns, std::int64_t step_ns) {
  std::int64_t best_ns = 0;
  double least = sum(bearing_errors(pairs, path, 0));
  for (std::int64_t delay_ns = from_ns; delay_ns <= to_ns; delay_ns += step_ns) {
    const double total = sum(bearing_errors(pairs, path, delay_ns));
    if (total < least) {
      least = total;
      best_ns = delay_ns;
    }
  }
  return best_ns;
}

/// @return whether the second errors are smaller than the first, pair by pair, beyond chance
bool is_better(const std::vector<double>& without, const std::vector<double>& with) {
  constexpr double kStandardErrors = 4.0;
  const auto count = static_cast<double>(without.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < without.size(); ++i) mean += (without[i] - with[i]) / count;
  double variance = 0.0;
  for (std::size_t i = 0; i < without.size(); ++i) {
    const double off = without[i] - with[i] - mean;
    variance += off * off / (count - 1.0);
  }
  return mean > kStandardErrors * std::sqrt(variance / count);
}

}  // namespace

OdometryDelay estimate_odometry_delay(const RecordedStreams& streams) {
  constexpr std::size_t kFewest = 30;  // pairs; below, a standard error means little
  const bool named = std::ranges::any_of(streams.sightings, [](const LoggedSighting& sighting) {
    return sighting.measurement.landmark_id >= 0;
  });
  if (!named && !streams.sightings.empty()) return {0.0, DelaySource::kNoIdentities};
  const std::vector<Pair> pairs = pairs_of(streams.sightings);
  if (pairs.size() < kFewest) return {0.0, DelaySource::kFewPairs};
  const OdometryPath path(streams.odometry);
  const std::int64_t near_ns = best_delay_ns(pairs, path, kEarliest_ns, kLatest_ns, kCoarseGrid_ns);
  const std::int64_t delay_ns =
      best_delay_ns(pairs, path, near_ns - kCoarseGrid_ns, near_ns + kCoarseGrid_ns, kGrid_ns);
  const bool worth_it = is_better(bearing_errors(pairs, path, 0), bearing_errors(pairs, path, delay_ns));
  if (!worth_it) return {0.0, DelaySource::kNoneBetter};
  return {1e-9 * static_cast<double>(delay_ns), DelaySource::kFound};
}

void delay_odometry(std::vector<OdometryReading>& odometry, double delay_s) {
  const std::int64_t delay_ns = std::llround(1e9 * delay_s);
  for (OdometryReading& reading : odometry) reading.stamp_ns += delay_ns;
}

}  // namespace stereobench::harness
