#include "tests/studies/depth_study.h"

#include <cmath>

#include <fmt/format.h>

#include "harness/calibration/galleries.h"
#include "harness/commands/scenario_arguments.h"

namespace stereobench {
namespace {

using harness::CalibrationBin;

constexpr worlds::GalleryDepths kDepths = {0.5, 15.0};
constexpr int kBins = 6;
constexpr double k95 = 1.96;  // standard deviations of a normal either side
constexpr double kPerMilli = 1e3;

long used(const CalibrationBin& bin) {
  return bin.samples - bin.refused;
}

/// Something that is measured at each range of depths, and its 95 % interval where one is known.
struct Quantity {
  const char* title;
  Limit limit;
  double (*measured)(const CalibrationBin& bin);
  double (*half_width)(const CalibrationBin& bin) = [](const CalibrationBin&) { return 0.0; };
};

constexpr auto kStated = static_cast<Eigen::Index>(harness::NoiseKind::kStated);

/// The intervals of sd, NIS and correlation are those of independent normal errors.
const Quantity kQuantities[] = {
    {"balls measured", {}, [](const CalibrationBin& bin) { return static_cast<double>(bin.samples); }},
    {"of these beyond the filters' gate, not counted below",
     {},
     [](const CalibrationBin& bin) { return static_cast<double>(bin.refused); }},
    {"disparity bias [px]",
     {-0.003, 0.003},
     [](const CalibrationBin& bin) { return bin.disparity_error_px.mean; },
     [](const CalibrationBin& bin) { return bin.disparity_error_px.half_width; }},
    {"range sd / Cramer-Rao bound",
     {.at_most = 1.25},
     [](const CalibrationBin& bin) { return bin.over_bound.x(); },
     [](const CalibrationBin& bin) {
       return k95 * bin.over_bound.x() / std::sqrt(2.0 * static_cast<double>(used(bin)));
     }},
    {"bearing sd [mrad]",
     {.at_most = 0.02},
     [](const CalibrationBin& bin) { return kPerMilli * bin.sd.y(); }},
    {"bearing bias [mrad]",
     {-0.005, 0.005},
     [](const CalibrationBin& bin) { return kPerMilli * bin.bias.y(); },
     [](const CalibrationBin& bin) {
       return k95 * kPerMilli * bin.sd.y() / std::sqrt(static_cast<double>(used(bin)));
     }},
    {"error of fitted radii, rms [px]",
     {.at_most = 0.1},
     [](const CalibrationBin& bin) { return bin.radius_rms_px; }},
    {"NIS / 2 as stated",
     {0.9, 1.1},
     [](const CalibrationBin& bin) { return bin.half_nis[kStated]; },
     [](const CalibrationBin& bin) { return k95 / std::sqrt(static_cast<double>(used(bin))); }},
    {"correlation of range and bearing",
     {},
     [](const CalibrationBin& bin) { return bin.correlation.x(); },
     [](const CalibrationBin& bin) { return k95 / std::sqrt(static_cast<double>(used(bin))); }},
    {"correlation as stated, mean", {}, [](const CalibrationBin& bin) { return bin.correlation.y(); }},
};

worlds::Scenario eyes() {
  harness::ScenarioArguments arguments;
  arguments.scenario = STEREOBENCH_SOURCE_DIR "/assets/scenarios/ball_circle.yaml";
  arguments.overrides = {
      "world={floor: tiles, ball_radius_m: 0.09, balls: [{colour: 0, at_m: [2, 0, 0.09]}]}"};
  return harness::read_scenario(arguments);
}

}  // namespace

std::vector<Section> study_depths(const std::vector<std::uint64_t>& seeds, int jobs) {
  std::vector<harness::CalibrationSample> samples;
  for (const harness::CalibrationTake& take :
       harness::take_galleries(eyes(), {kDepths, true}, seeds, renderer::Backend::kOsmesa, jobs))
    samples.insert(samples.end(), take.samples.begin(), take.samples.end());
  const harness::FittedNoise as_stated;
  return depth_sections(
      harness::bin_samples(samples, as_stated, kDepths.nearest_m, kDepths.farthest_m, kBins));
}

std::vector<Section> depth_sections(std::span<const CalibrationBin> bins) {
  std::vector<Section> sections;
  for (const Quantity& quantity : kQuantities) {
    Section section{quantity.title, {}};
    for (const CalibrationBin& bin : bins) {
      if (!bin.whole) continue;
      section.lines.push_back({fmt::format("{:.2f} .. {:.2f} m", bin.nearest_m, bin.farthest_m),
                               quantity.measured(bin), quantity.half_width(bin), quantity.limit});
    }
    sections.push_back(section);
  }
  return sections;
}

}  // namespace stereobench
