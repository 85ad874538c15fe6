#include "harness/trajectories/pose_errors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "harness/types.h"

namespace stereobench::harness {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kDeltaTolerance = 0.1;   // of a delta in metres
constexpr std::size_t kSegmentStep = 10;  // poses, as in the benchmark's own program

void add(PoseErrors& errors, const PoseInSpace& off) {
  errors.translation_m.push_back(off.position_m.norm());
  errors.rotation_rad.push_back(angle_of(off.rotation));
}

/// What the estimate's motion between two poses misses the true one by.
PoseInSpace motion_error(const TrajectoryPairs& pairs, std::size_t from, std::size_t to) {
  return between(between(pairs.truth[from], pairs.truth[to]),
                 between(pairs.estimate[from], pairs.estimate[to]));
}

/// How far along each pose is: numbers of poses, metres, or nanoseconds, which are exact.
std::vector<double> progress(const TrajectoryPairs& pairs, Delta::Unit unit) {
  if (unit == Delta::Unit::kMetres) return path_lengths_m(pairs.estimate);
  std::vector<double> length(pairs.truth.size());
  if (unit == Delta::Unit::kPoses) {
    std::iota(length.begin(), length.end(), 0.0);
    return length;
  }
  if (pairs.stamps_ns.empty())
    throw std::runtime_error("--delta: a file has no times; expected a number of poses or of metres");
  for (std::size_t i = 0; i < length.size(); ++i)
    length[i] = static_cast<double>(pairs.stamps_ns[i] - pairs.stamps_ns.front());
  return length;
}

/// @param length rising
/// @return the first index whose length is at least that much beyond an index's; none where there is none
std::optional<std::size_t> first_beyond(const std::vector<double>& length, std::size_t from, double delta) {
  const auto begin = length.begin() + static_cast<std::ptrdiff_t>(from);
  const auto found =
      std::partition_point(begin, length.end(), [&](double at) { return at - *begin < delta; });
  if (found == length.end()) return {};
  return static_cast<std::size_t>(found - length.begin());
}

/// @return the index after an index whose length is nearest to that much beyond it; none where that is
/// further off
///         than a tenth
std::optional<std::size_t> nearest_to(const std::vector<double>& length, std::size_t from, double delta) {
  const double aim = length[from] + delta;
  std::size_t to = first_beyond(length, from, delta).value_or(length.size() - 1);
  if (to > from + 1 && aim - length[to - 1] <= std::abs(length[to] - aim)) --to;
  if (std::abs(length[to] - aim) > kDeltaTolerance * delta) return {};
  return to;
}

}  // namespace

ErrorStatistics statistics_of(std::vector<double> errors) {
  if (errors.empty()) return {kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  std::ranges::sort(errors);
  const auto n = static_cast<double>(errors.size());
  ErrorStatistics statistics;
  double sum = 0.0;
  for (const double error : errors) {
    sum += error;
    statistics.sse += error * error;
  }
  statistics.mean = sum / n;
  statistics.rmse = std::sqrt(statistics.sse / n);
  double squares = 0.0;
  for (const double error : errors) squares += (error - statistics.mean) * (error - statistics.mean);
  statistics.sd = std::sqrt(squares / n);
  const std::size_t half = errors.size() / 2;
  statistics.median = errors.size() % 2 == 1 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
  statistics.min = errors.front();
  statistics.max = errors.back();
  return statistics;
}

PoseErrors absolute_errors(const TrajectoryPairs& aligned) {
  PoseErrors errors;
  for (std::size_t i = 0; i < aligned.truth.size(); ++i)
    add(errors, between(aligned.truth[i], aligned.estimate[i]));
  return errors;
}

Delta parse_delta(const std::string& text) {
  Delta delta;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, delta.length);
  const std::string unit(rest, end);
  const bool known = unit.empty() || unit == "m" || unit == "s";
  const bool whole = !unit.empty() || delta.length == std::floor(delta.length);
  if (error != std::errc() || !known || !whole || !(delta.length > 0.0) || !std::isfinite(delta.length))
    throw std::runtime_error(fmt::format(
        "--delta: expected a number of poses, metres or seconds, e.g. 1, 10m or 0.5s (got '{}')", text));
  if (unit == "m") delta.unit = Delta::Unit::kMetres;
  if (unit == "s") delta.unit = Delta::Unit::kSeconds;
  return delta;
}

std::string text_of(const Delta& delta) {
  const bool metres = delta.unit == Delta::Unit::kMetres;
  return fmt::format("{}{}", delta.length, delta.unit == Delta::Unit::kPoses ? "" : metres ? "m" : "s");
}

std::string span_text(const Delta& delta) {
  const std::string text = text_of(delta);
  if (delta.unit != Delta::Unit::kPoses) return text;
  return fmt::format("{} pose{}", text, text == "1" ? "" : "s");
}

PoseErrors relative_errors(const TrajectoryPairs& aligned, const Delta& delta) {
  PoseErrors errors;
  const std::vector<double> length = progress(aligned, delta.unit);
  const bool in_metres = delta.unit == Delta::Unit::kMetres;
  const bool in_seconds = delta.unit == Delta::Unit::kSeconds;
  const double apart = in_seconds ? std::round(delta.length * static_cast<double>(kSecond_ns)) : delta.length;
  if (delta.all_pairs) {
    for (std::size_t from = 0; from + 1 < length.size(); ++from) {
      const auto to = in_metres ? nearest_to(length, from, apart) : first_beyond(length, from, apart);
      if (to) add(errors, motion_error(aligned, from, *to));
    }
    return errors;
  }
  // In metres the first pair begins where one could end, as evo has it.
  std::optional<std::size_t> from = in_metres ? first_beyond(length, 0, apart) : 0;
  while (from) {
    const std::optional<std::size_t> to = first_beyond(length, *from, apart);
    if (to) add(errors, motion_error(aligned, *from, *to));
    from = to;
  }
  return errors;
}

std::vector<SegmentErrors> segment_errors(const TrajectoryPairs& aligned,
                                          const std::vector<double>& lengths_m) {
  const std::vector<double> path_m = path_lengths_m(aligned.truth);
  std::vector<SegmentErrors> segments;
  SegmentErrors all;
  for (const double length_m : lengths_m) {
    SegmentErrors of_one{.length_m = length_m};
    for (std::size_t from = 0; from < path_m.size(); from += kSegmentStep) {
      const auto to = std::ranges::upper_bound(path_m, path_m[from] + length_m);
      if (to == path_m.end()) break;
      const PoseInSpace off = motion_error(aligned, from, static_cast<std::size_t>(to - path_m.begin()));
      of_one.translation_percent += 100.0 * off.position_m.norm() / length_m;
      of_one.rotation_deg_per_m += angle_of(off.rotation) * 180.0 / std::numbers::pi / length_m;
      ++of_one.count;
    }
    segments.push_back(of_one);
    all.count += of_one.count;
    all.translation_percent += of_one.translation_percent;
    all.rotation_deg_per_m += of_one.rotation_deg_per_m;
  }
  segments.push_back(all);
  for (SegmentErrors& some : segments) {
    some.translation_percent =
        some.count > 0 ? some.translation_percent / static_cast<double>(some.count) : kNone;
    some.rotation_deg_per_m =
        some.count > 0 ? some.rotation_deg_per_m / static_cast<double>(some.count) : kNone;
  }
  return segments;
}

std::vector<double> path_lengths_m(const std::vector<PoseInSpace>& poses) {
  std::vector<double> lengths_m;
  for (std::size_t i = 0; i < poses.size(); ++i)
    lengths_m.push_back(i == 0 ? 0.0
                               : lengths_m.back() + (poses[i].position_m - poses[i - 1].position_m).norm());
  return lengths_m;
}

}  // namespace stereobench::harness
