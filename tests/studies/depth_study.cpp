#include "tests/studies/depth_study.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/commands/scenario_arguments.h"
#include "harness/detector_noise/calibration_scenes.h"

namespace stereobench {
namespace {

using harness::CalibrationBin;

constexpr worlds::CalibrationDepths kDepths = {0.5, 15.0};
constexpr int kBins = 6;
constexpr double k95 = 1.96;  // standard deviations of a normal either side
constexpr double kPerMilli = 1e3;
constexpr double kOfUnknownSize = 1.25;
constexpr double kBearingSd_mrad = 0.0013;  // at 1 m
constexpr double kRadiusRms_px = 0.0024;    // at 1 m

long used(const CalibrationBin& bin) {
  return bin.samples - bin.refused;
}

double standard_error(double sd, const CalibrationBin& bin) {
  return sd / std::sqrt(static_cast<double>(used(bin)));
}

/// A bias of nothing, within three standard errors of the mean.
Limit unbiased(double standard_error) {
  return {-3.0 * standard_error, 3.0 * standard_error};
}

double half_width_of_sd(double sd, const CalibrationBin& bin) {
  return k95 * sd / std::sqrt(2.0 * static_cast<double>(used(bin)));
}

/// Errors of an outline of r px go with 1 / sqrt(r), and r with 1 / depth: so the errors grow with the root
/// of the depth.
/// @param at_1_m what is measured, in full, and three standard errors
Limit growing_with_depth(double at_1_m, const CalibrationBin& bin) {
  return {.at_most = at_1_m * std::sqrt(std::sqrt(bin.nearest_m * bin.farthest_m))};
}

Limit no_limit(const CalibrationBin&) {
  return {};
}

/// Something that is measured at each range of depths, its limit there, and its 95 % interval where one is
/// known. Limits lie within three standard errors of what is measured with the default seeds.
struct Quantity {
  const char* title;
  double (*measured)(const CalibrationBin& bin);
  Limit (*limit)(const CalibrationBin& bin) = no_limit;
  double (*half_width)(const CalibrationBin& bin) = [](const CalibrationBin&) { return 0.0; };
};

constexpr auto kStated = static_cast<Eigen::Index>(harness::NoiseKind::kStated);

/// The intervals of sd, NIS and correlation are those of independent normal errors.
const Quantity kQuantities[] = {
    {"balls measured", [](const CalibrationBin& bin) { return static_cast<double>(bin.samples); }},
    {"share of these beyond the filters' gate, not counted below",
     [](const CalibrationBin& bin) {
       return static_cast<double>(bin.refused) / static_cast<double>(bin.samples);
     },
     [](const CalibrationBin&) { return Limit{.at_most = 0.01}; }},
    {"disparity bias [px]", [](const CalibrationBin& bin) { return bin.disparity_error_px.mean; },
     [](const CalibrationBin& bin) { return unbiased(bin.disparity_error_px.half_width / k95); },
     [](const CalibrationBin& bin) { return bin.disparity_error_px.half_width; }},
    {"range sd / Cramer-Rao bound", [](const CalibrationBin& bin) { return bin.over_bound.x(); },
     [](const CalibrationBin&) { return Limit{.at_most = 1.4}; },
     [](const CalibrationBin& bin) { return half_width_of_sd(bin.over_bound.x(), bin); }},
    {"bearing sd [mrad]", [](const CalibrationBin& bin) { return kPerMilli * bin.sd.y(); },
     [](const CalibrationBin& bin) { return growing_with_depth(kBearingSd_mrad, bin); }},
    {"bearing bias [mrad]", [](const CalibrationBin& bin) { return kPerMilli * bin.bias.y(); },
     [](const CalibrationBin& bin) { return unbiased(kPerMilli * standard_error(bin.sd.y(), bin)); },
     [](const CalibrationBin& bin) { return k95 * kPerMilli * standard_error(bin.sd.y(), bin); }},
    {"error of fitted radii, rms [px]", [](const CalibrationBin& bin) { return bin.radius_rms_px; },
     [](const CalibrationBin& bin) { return growing_with_depth(kRadiusRms_px, bin); }},
    {"NIS / 2 as stated", [](const CalibrationBin& bin) { return bin.half_nis[kStated]; },
     [](const CalibrationBin&) {
       return Limit{0.9, 1.1};
     },
     [](const CalibrationBin& bin) { return k95 * standard_error(1.0, bin); }},
    {"correlation of range and bearing, beyond what is stated",
     [](const CalibrationBin& bin) { return bin.correlation.x() - bin.correlation.y(); },
     [](const CalibrationBin& bin) { return unbiased(standard_error(1.0, bin)); },
     [](const CalibrationBin& bin) { return k95 * standard_error(1.0, bin); }},
};

/// @param radius_sd_m tolerance of the balls
harness::Experiment cameras(double radius_sd_m) {
  harness::ScenarioArguments arguments;
  arguments.scenario = STEREOBENCH_SOURCE_DIR "/assets/scenarios/ball_circle.yaml";
  arguments.overrides = {
      fmt::format("world={{floor: tiles, ball_radius_m: 0.09, ball_radius_sd_m: {}, balls: "
                  "[{{colour: 0, at_m: [2, 0, 0.09]}}]}}",
                  radius_sd_m)};
  return harness::read_experiment(arguments);
}

std::vector<CalibrationBin> measured_bins(double radius_sd_m, const std::vector<std::uint64_t>& seeds,
                                          int jobs) {
  std::vector<harness::CalibrationSample> samples;
  const harness::Experiment experiment = cameras(radius_sd_m);
  for (const harness::CalibrationTake& take : harness::take_calibration_scenes(
           {experiment, {kDepths, true}, renderer::Backend::kSoftware, seeds}, jobs))
    samples.insert(samples.end(), take.samples.begin(), take.samples.end());
  const harness::FittedNoise as_stated;
  return harness::bin_samples(samples, as_stated, kDepths.nearest_m, kDepths.farthest_m, kBins);
}

std::string depths_of(const CalibrationBin& bin) {
  return fmt::format("{:.2f} .. {:.2f} m", bin.nearest_m, bin.farthest_m);
}

}  // namespace

std::vector<Section> study_depths(const std::vector<std::uint64_t>& seeds, int jobs) {
  return depth_sections(measured_bins(0.0, seeds, jobs));
}

Section study_tolerance(const std::vector<std::uint64_t>& seeds, int jobs) {
  constexpr double kTolerance_m = 0.001;
  Section section{"sizes to 1 mm: range sd / bound for unknown size", {}};
  for (const CalibrationBin& bin : measured_bins(kTolerance_m, seeds, jobs)) {
    if (!bin.whole) continue;
    const double ratio = bin.over_unknown_size.x();
    section.lines.push_back(
        {depths_of(bin), ratio, half_width_of_sd(ratio, bin), Limit{.at_most = kOfUnknownSize}});
  }
  return section;
}

std::vector<Section> depth_sections(std::span<const CalibrationBin> bins) {
  std::vector<Section> sections;
  for (const Quantity& quantity : kQuantities) {
    Section section{quantity.title, {}};
    for (const CalibrationBin& bin : bins) {
      if (!bin.whole) continue;
      section.lines.push_back(
          {depths_of(bin), quantity.measured(bin), quantity.half_width(bin), quantity.limit(bin)});
    }
    sections.push_back(section);
  }
  return sections;
}

}  // namespace stereobench
