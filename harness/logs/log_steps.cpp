#include "harness/logs/log_steps.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "slam/models/motion.h"

namespace stereobench::harness {

namespace {

constexpr std::int64_t kLongestStep_ns = 1'000'000'000;
constexpr std::int64_t kLongestTruthGap_ns = 1'000'000'000;
constexpr double kLongestLog_s = 1e6;  // eleven days; steps of a second each have to fit into memory

double seconds(std::int64_t duration_ns) {
  return static_cast<double>(duration_ns) * 1e-9;
}

/// One instant for each group of sightings, and one at each end of the odometry.
std::vector<std::int64_t> needed_instants(const RecordedStreams& streams) {
  std::vector<std::int64_t> instants;
  for (const LoggedSighting& sighting : streams.sightings) {
    const bool same = !instants.empty() && sighting.stamp_ns - instants.back() <= kSameInstant_ns;
    if (!same) instants.push_back(sighting.stamp_ns);
  }
  const std::int64_t first_ns = streams.odometry.front().stamp_ns;
  const std::int64_t last_ns = streams.odometry.back().stamp_ns;
  if (instants.empty() || first_ns < instants.front()) instants.insert(instants.begin(), first_ns);
  if (last_ns > instants.back() + kSameInstant_ns) instants.push_back(last_ns);
  return instants;
}

void check_span(const std::vector<std::int64_t>& instants) {
  const double span_s = seconds(instants.back() - instants.front());
  if (span_s <= kLongestLog_s) return;
  std::size_t longest = 1;
  for (std::size_t i = 1; i < instants.size(); ++i)
    if (instants[i] - instants[i - 1] > instants[longest] - instants[longest - 1]) longest = i;
  throw std::runtime_error(fmt::format(
      "expected a log of at most {:.0f} s (got {:.0f} s); nothing was measured between {:.9g} s and {:.9g} "
      "s: is a time in another unit or of another clock?",
      kLongestLog_s, span_s, seconds(instants[longest - 1]), seconds(instants[longest])));
}

/// Adds instants so that no step is longer than the longest, all parts of a gap being equal.
std::vector<std::int64_t> fill_gaps(const std::vector<std::int64_t>& instants) {
  check_span(instants);
  std::vector<std::int64_t> filled = {instants.front()};
  for (std::size_t i = 1; i < instants.size(); ++i) {
    const std::int64_t begin_ns = instants[i - 1];
    const std::int64_t gap_ns = instants[i] - begin_ns;
    const std::int64_t parts = (gap_ns + kLongestStep_ns - 1) / kLongestStep_ns;
    for (std::int64_t part = 1; part < parts; ++part) {
      filled.push_back(begin_ns + gap_ns / parts * part);
    }
    filled.push_back(instants[i]);
  }
  return filled;
}

/// A part of what was held. Errors of the motion are independent from moment to moment: the displacement of a
/// part has its share of the variance, so the variance of its mean velocity is larger by whole / part.
slam::Control part_of(const OdometryReading& held, double duration_s) {
  slam::Control part{held.v_mps, held.w_radps, duration_s, held.lateral_mps, held.covariance};
  if (part.covariance) *part.covariance *= held.lasts_s / duration_s;
  return part;
}

/// What was held from one instant to another.
std::vector<slam::Control> held_between(const std::vector<OdometryReading>& odometry, std::int64_t from_ns,
                                        std::int64_t to_ns) {
  const auto later = [](std::int64_t stamp, const OdometryReading& r) { return stamp < r.stamp_ns; };
  auto next = std::upper_bound(odometry.begin(), odometry.end(), from_ns, later);
  std::vector<slam::Control> controls;
  for (std::int64_t at_ns = from_ns; at_ns < to_ns; ++next) {
    const OdometryReading held = next == odometry.begin() ? OdometryReading{} : *(next - 1);
    const std::int64_t end_ns = next == odometry.end() ? to_ns : std::min(next->stamp_ns, to_ns);
    if (end_ns > at_ns) controls.push_back(part_of(held, seconds(end_ns - at_ns)));
    at_ns = end_ns;
    if (next == odometry.end()) break;
  }
  return controls;
}

std::optional<slam::Pose> truth_at(const std::vector<StampedPose>& truth, std::int64_t stamp_ns) {
  const auto earlier = [](const StampedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; };
  const auto after = std::lower_bound(truth.begin(), truth.end(), stamp_ns, earlier);
  if (after == truth.end()) return {};
  if (after->stamp_ns == stamp_ns) return after->pose;
  if (after == truth.begin()) return {};
  const StampedPose& a = *(after - 1);
  const StampedPose& b = *after;
  if (b.stamp_ns - a.stamp_ns > kLongestTruthGap_ns) return {};
  const double part = seconds(stamp_ns - a.stamp_ns) / seconds(b.stamp_ns - a.stamp_ns);
  const double turn_rad = slam::wrap_angle(b.pose.heading_rad - a.pose.heading_rad);
  return slam::Pose{a.pose.x_m + part * (b.pose.x_m - a.pose.x_m),
                    a.pose.y_m + part * (b.pose.y_m - a.pose.y_m),
                    slam::wrap_angle(a.pose.heading_rad + part * turn_rad)};
}

/// Gives each sighting to the step it is nearest to.
void deal_out(const std::vector<LoggedSighting>& sightings, std::vector<LogStep>& steps) {
  std::size_t step = 0;
  for (const LoggedSighting& sighting : sightings) {
    const auto distance = [&](std::size_t i) { return std::abs(steps[i].stamp_ns - sighting.stamp_ns); };
    while (step + 1 < steps.size() && distance(step + 1) < distance(step)) ++step;
    steps[step].measurements.push_back(sighting.measurement);
  }
}

}  // namespace

MeasurementLog steps_from_streams(const RecordedStreams& streams) {
  const std::vector<std::int64_t> instants =
      streams.instants_ns ? *streams.instants_ns : fill_gaps(needed_instants(streams));
  MeasurementLog log;
  log.landmarks = streams.landmarks;
  log.steps.reserve(instants.size());
  for (std::size_t i = 0; i < instants.size(); ++i) {
    LogStep step;
    step.stamp_ns = instants[i];
    if (i > 0) step.odometry = held_between(streams.odometry, instants[i - 1], instants[i]);
    step.truth = truth_at(streams.truth, instants[i]);
    log.steps.push_back(std::move(step));
  }
  deal_out(streams.sightings, log.steps);
  log.start = log.steps.front().truth.value_or(slam::Pose{});
  log.start_is_true = log.steps.front().truth.has_value();
  return log;
}

}  // namespace stereobench::harness
