#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "harness/experiment/experiment_parts.h"
#include "vision/palette.h"

namespace stereobench::harness {
namespace {

using worlds::choice;
using worlds::Field;
using worlds::Fields;
using worlds::group;
using worlds::Interval;
using worlds::number;
using worlds::whole;
using worlds::YamlMap;
using worlds::YamlValue;

constexpr Interval kProbability = {0.0, 1.0};
constexpr Interval kNoise_px = {0.0, 1000.0};
constexpr Interval kFactor = {1e-3, 1e3};
constexpr double kMostRange_m = 1e4;
constexpr std::size_t kMostPoints = 50;

/// What is about pixels, or about what cameras see.
constexpr std::array<std::string_view, 8> kOfPictures = {
    "centre_sd_px", "centre_bias_px",  "heavy_tail",     "correlated_s",
    "quantise_px",  "miss_by_visible", "false_within_m", "covariance"};

/// What is about the names that detections have.
constexpr std::array<std::string_view, 2> kOfNames = {"identity_swap_probability", "confusion"};

const Fields<HeavyTail>& heavy_tail_keys() {
  static const Fields<HeavyTail> keys({
      number("share", kProbability, "Share of the detections whose error is larger.")
          .needed()
          .fills(&HeavyTail::share),
      number("sd_scale", {1.0, 1e3}, "How many times larger its standard deviation is.")
          .needed()
          .fills(&HeavyTail::sd_scale),
  });
  return keys;
}

std::vector<Field<DetectorFaults>> centre_fields() {
  return {
      number("centre_sd_px", kNoise_px,
             "Standard deviation that is added to each coordinate of a centre, in each camera, in pixels.")
          .fills(&DetectorFaults::centre_sd_px),
      number("centre_bias_px", {-kNoise_px.most, kNoise_px.most},
             "What is added to all centres: column and row of the left camera, then of the right, in pixels.")
          .list(2, 2, 2)
          .fills(&DetectorFaults::centre_bias_px),
      group("heavy_tail", heavy_tail_keys(), "Errors of centres that are larger than the others.")
          .fills(&DetectorFaults::heavy_tail),
      number("correlated_s", {0.0, 1e6},
             "How long the error of a ball's centre lasts, in seconds: to 1/e; 0: each frame has its own.")
          .fills(&DetectorFaults::correlated_s),
      number("quantise_px", kNoise_px, "Centres are rounded to multiples of it, in pixels; 0: they are not.")
          .fills(&DetectorFaults::quantise_px),
      number("range_scale", kFactor, "Factor on all ranges.").fills(&DetectorFaults::range_scale),
  };
}

std::vector<Field<DetectorFaults>> miss_fields() {
  return {
      number("miss_probability", kProbability, "Probability that a detection is lost.")
          .fills(&DetectorFaults::miss_probability),
      number("miss_by_visible", kProbability,
             "Further probability to be lost, by how much of the ball is seen: [fraction, probability], "
             "interpolated.")
          .list(1, kMostPoints, 2)
          .otherwise_says("none")
          .fills(&DetectorFaults::miss_by_visible),
      number("miss_by_range", {0.0, kMostRange_m},
             "Further probability to be lost, by range: [metres, probability], interpolated.")
          .list(1, kMostPoints, 2)
          .otherwise_says("none")
          .fills(&DetectorFaults::miss_by_range),
      whole("miss_burst_frames", 1, 1000000, "A ball that is lost is lost for so many frames.")
          .fills(&DetectorFaults::miss_burst_frames),
  };
}

std::vector<Field<DetectorFaults>> other_fields() {
  return {
      number("false_per_frame", {0.0, 100.0}, "Mean number of detections of nothing in a frame.")
          .fills(&DetectorFaults::false_per_frame),
      number("false_within_m", {0.5, kMostRange_m}, "How far away those are at most, in metres.")
          .fills(&DetectorFaults::false_within_m),
      number("identity_swap_probability", kProbability,
             "Probability that two detections of a frame, paired at random, have each other's name.")
          .fills(&DetectorFaults::identity_swap_probability),
      number(
          "confusion", kProbability,
          "Row: a colour of the palette; column: the probability that it is taken for that colour. Colours "
          "beyond are not confused.")
          .square(vision::kPalette.size())
          .otherwise_says("none")
          .fills(&DetectorFaults::confusion),
      whole("latency_frames", 0, 1000, "Detections arrive so many frames after the look.")
          .fills(&DetectorFaults::latency_frames),
      choice("covariance", {"honest", "as_stated"},
             "Whether detections state the error that was added to centres, or what the detector states.")
          .fills(&DetectorFaults::covariance),
      number("covariance_scale", {1e-6, 1e6}, "Factor on all stated covariances.")
          .fills(&DetectorFaults::covariance_scale),
  };
}

/// That the first numbers ascend and the second ones are probabilities.
void check_points(const YamlMap& map, std::string_view key, const std::vector<Eigen::Vector2d>& points) {
  const auto list = map.find(key);
  if (!list) return;
  const std::vector<YamlValue> entries = list->list(1, kMostPoints);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].y() > 1.0) entries[i].list(2, 2)[1].fail("expected a probability from 0 to 1");
    if (i > 0 && points[i].x() <= points[i - 1].x())
      entries[i].list(2, 2)[0].fail(fmt::format("expected a number above {}", points[i - 1].x()));
  }
}

void check_confusion(const YamlMap& map, const std::vector<std::vector<double>>& confusion) {
  constexpr double kRounding = 1e-9;
  const auto list = map.find("confusion");
  if (!list) return;
  const std::vector<YamlValue> rows = list->list(1, vision::kPalette.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double sum = 0.0;
    for (const double probability : confusion[i]) sum += probability;
    if (confusion[i].size() != rows.size())
      rows[i].fail(fmt::format("expected a list of {}, as there are rows", rows.size()));
    if (std::abs(sum - 1.0) > kRounding)
      rows[i].refuse(fmt::format("expected probabilities that sum to 1 (got a sum of {})", sum));
  }
}

void check_faults(const YamlMap& map, DetectorFaults& faults) {
  check_points(map, "miss_by_visible", faults.miss_by_visible);
  check_points(map, "miss_by_range", faults.miss_by_range);
  check_confusion(map, faults.confusion);
}

}  // namespace

const Fields<DetectorFaults>& detector_faults_keys() {
  static const Fields<DetectorFaults> keys(
      worlds::joined<DetectorFaults>({centre_fields(), miss_fields(), other_fields()}), check_faults);
  return keys;
}

DetectorFaults read_detector_faults(const YamlValue& value, const worlds::Scenario& scenario) {
  DetectorFaults faults = detector_faults_keys().read(value);
  const YamlMap map(value, detector_faults_keys());
  const bool is_oracle = scenario.sensor == worlds::SensorKind::kOracle;
  for (const std::string_view key : kOfPictures)
    if (const auto found = map.find(key); found && is_oracle)
      found->refuse(
          "the oracle has no pixels; oracle.range_sd_m, oracle.bearing_sd_deg and oracle.max_range_m are "
          "what it has instead");
  for (const std::string_view key : kOfNames)
    if (const auto found = map.find(key); found && scenario.identity == worlds::Identity::kNone)
      found->refuse("identity is none: detections have no name that could be wrong");
  if (const auto found = map.find("confusion");
      found && is_oracle && scenario.identity == worlds::Identity::kKnown)
    found->refuse("expected identity: colour_class; the oracle knows balls by number, and sees no colours");
  return faults;
}

}  // namespace stereobench::harness
