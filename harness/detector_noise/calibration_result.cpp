#include "harness/detector_noise/calibration_result.h"

#include <numbers>

#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"

namespace stereobench::harness {
namespace {

constexpr int kBins = 6;

std::string depths(const CalibrationBin& bin) {
  return bin.whole ? fmt::format("{:.2f} .. {:.2f}", bin.nearest_m, bin.farthest_m) : "parts of balls";
}

nlohmann::ordered_json pair_json(const Eigen::Vector2d& pair) {
  return {number(pair.x()), number(pair.y())};
}

nlohmann::ordered_json bin_json(const CalibrationBin& bin) {
  return {{"whole", bin.whole},
          {"depth_m", {number(bin.nearest_m), number(bin.farthest_m)}},
          {"samples", bin.samples},
          {"refused", bin.refused},
          {"range_bias_m", number(bin.bias.x())},
          {"range_sd_m", number(bin.sd.x())},
          {"range_sd_over_bound", number(bin.over_bound.x())},
          {"range_sd_over_bound_unknown_size", number(bin.over_unknown_size.x())},
          {"bearing_bias_rad", number(bin.bias.y())},
          {"bearing_sd_rad", number(bin.sd.y())},
          {"bearing_sd_over_bound", number(bin.over_bound.y())},
          {"correlation", number(bin.correlation.x())},
          {"correlation_stated", number(bin.correlation.y())},
          {"half_nis_stated", number(bin.half_nis[0])},
          {"half_nis_per_observation", number(bin.half_nis[1])},
          {"half_nis_stereo", number(bin.half_nis[2])}};
}

}  // namespace

CalibrationResult calibrate(std::span<const CalibrationTake> takes, const std::vector<std::uint64_t>& seeds,
                            double nearest_m, double farthest_m) {
  CalibrationResult result;
  std::vector<CalibrationSample> whole, held_out;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    if (i % 2 == 0) {
      result.fitted_seeds.push_back(seeds[i]);
      for (const CalibrationSample& sample : takes[i].samples)
        if (sample.whole) whole.push_back(sample);
    } else {
      result.held_out_seeds.push_back(seeds[i]);
      held_out.insert(held_out.end(), takes[i].samples.begin(), takes[i].samples.end());
      result.score += takes[i].score;
    }
  }
  result.noise = fit_noise(whole);
  result.bins = bin_samples(held_out, result.noise, nearest_m, farthest_m, kBins);
  return result;
}

std::string calibration_table(const CalibrationResult& result) {
  AlignedTable table;
  table.header = {"depth [m]",    "balls",           "refused",         "range bias [mm]",
                  "sd [mm]",      "sd / bound",      "of unknown size", "bearing bias [mrad]",
                  "sd [mrad]",    "sd / bound",      "correlation",     "stated",
                  "NIS/2 stated", "per_observation", "stereo"};
  for (const CalibrationBin& bin : result.bins) {
    table.rows.push_back({depths(bin), std::to_string(bin.samples), std::to_string(bin.refused),
                          format_number(1e3 * bin.bias.x(), 2), format_number(1e3 * bin.sd.x()),
                          format_number(bin.over_bound.x()), format_number(bin.over_unknown_size.x()),
                          format_number(1e3 * bin.bias.y(), 2), format_number(1e3 * bin.sd.y()),
                          format_number(bin.over_bound.y()), format_number(bin.correlation.x(), 2),
                          format_number(bin.correlation.y(), 2), format_number(bin.half_nis[0]),
                          format_number(bin.half_nis[1]), format_number(bin.half_nis[2])});
  }
  return plain_text(table);
}

nlohmann::ordered_json calibration_json(const CalibrationResult& result) {
  nlohmann::ordered_json bins = nlohmann::ordered_json::array();
  for (const CalibrationBin& bin : result.bins) bins.push_back(bin_json(bin));
  const FittedNoise& noise = result.noise;
  return {{"schema", "stereobench.calibration/1"},
          {"scenario", result.scenario},
          {"detector", result.detector},
          {"fitted_seeds", result.fitted_seeds},
          {"held_out_seeds", result.held_out_seeds},
          {"recall", number(result.score.recall())},
          {"precision", number(result.score.precision())},
          {"misidentified", result.score.misidentified},
          {"spurious", result.score.spurious},
          {"flagged", result.score.flagged},
          {"per_observation", {{"sd_scale", pair_json(noise.stated_sd_scale)}}},
          {"stereo",
           {{"range_sd_m", noise.stereo.range_sd_m},
            {"range_sd_per_m2", noise.stereo.range_sd_per_m2},
            {"bearing_sd_rad", noise.stereo.bearing_sd_rad}}},
          {"bins", bins}};
}

std::string noise_yaml(const CalibrationResult& result, NoiseKind kind, const vision::StereoRig& rig) {
  const std::string about = fmt::format(
      "# The noise of sightings, as `stereobench calibrate` measured it on {} for {}.\n"
      "# In a scenario: believed_measurement_noise: {{kind: file, file: noise.yaml}}\n",
      result.scenario, result.detector);
  const FittedNoise& noise = result.noise;
  if (kind == NoiseKind::kStereo)
    return about + fmt::format("kind: stereo\nrange_sd_m: {}\ndisparity_sd_px: {}\nbearing_sd_px: {}\n",
                               noise.stereo.range_sd_m,
                               noise.stereo.range_sd_per_m2 * rig.intrinsics.focal_px * rig.baseline_m,
                               noise.stereo.bearing_sd_rad * rig.intrinsics.focal_px);
  return about + fmt::format("kind: per_observation\nrange_sd_scale: {}\nbearing_sd_scale: {}\n",
                             noise.stated_sd_scale.x(), noise.stated_sd_scale.y());
}

}  // namespace stereobench::harness
