
#include "slam/math/angles.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kNoise = {0.0, 100.0};
constexpr Interval kScale = {1e-3, 1e3};

enum class Kind { kPerObservation, kConstant, kStereo, kFile };

MeasurementNoise read_stated_noise(const YamlMap& map) {
  return {.stated_sd_scale = {map.number("range_sd_scale", 1.0), map.number("bearing_sd_scale", 1.0)}};
}

MeasurementNoise read_constant_noise(const YamlMap& map) {
  return {.law = slam::NoiseLaw{.range_sd_m = map.number("range_sd_m"),
                                .bearing_sd_rad = map.number("bearing_sd_deg") * slam::kRadPerDegree}};
}

MeasurementNoise read_stereo_noise(const YamlMap& map, const vision::StereoRig& rig) {
  const double focal_px = rig.intrinsics.focal_px;
  return {.law =
              slam::NoiseLaw{.range_sd_m = map.number("range_sd_m", 0.0),
                             .range_sd_per_m2 = map.number("disparity_sd_px") / (focal_px * rig.baseline_m),
                             .bearing_sd_rad = map.number("bearing_sd_px") / focal_px}};
}

/// A law that is written where it is asked for, and not in a file.
MeasurementNoise read_noise_law(const YamlValue& value, const std::optional<vision::StereoRig>& rig) {
  const YamlMap map(value, measurement_noise_keys());
  switch (static_cast<Kind>(map.choice("kind"))) {
    case Kind::kPerObservation:
      return read_stated_noise(map);
    case Kind::kConstant:
      return read_constant_noise(map);
    case Kind::kStereo:
      if (!rig) value.refuse("expected a rig beside the stereo law");
      return read_stereo_noise(map, *rig);
    case Kind::kFile:
      break;
  }
  map.at("kind").fail("expected a law, and no further file");
}

}  // namespace

const KeyGroup& measurement_noise_keys() {
  static const KeyGroup keys = {
      .kind_key = "kind",
      .keys = {
          choice("kind", {"per_observation", "constant", "stereo", "file"},
                 "Whether sightings state their noise, or a law says it of all.")
              .needed(),
          number("range_sd_m", kNoise,
                 "Standard deviation of a range, in metres; of `stereo`, its constant part.")
              .only_for({"constant", "stereo"})
              .needed_for({"constant"})
              .otherwise("0"),
          number("bearing_sd_deg", {0.0, 180.0}, "Standard deviation of a bearing, in degrees.")
              .only_for({"constant"})
              .needed_for({"constant"}),
          number("disparity_sd_px", kNoise,
                 "Standard deviation of a disparity, in pixels: that of a range grows with its square.")
              .only_for({"stereo"})
              .needed_for({"stereo"}),
          number("bearing_sd_px", kNoise, "Standard deviation of a column, in pixels.")
              .only_for({"stereo"})
              .needed_for({"stereo"}),
          number("range_sd_scale", kScale, "Factor on the standard deviation of ranges that sightings state.")
              .only_for({"per_observation"})
              .otherwise("1"),
          number("bearing_sd_scale", kScale,
                 "Factor on the standard deviation of bearings that sightings state.")
              .only_for({"per_observation"})
              .otherwise("1"),
          text("file", "What `stereobench calibrate` wrote, relative to the scenario's folder.")
              .only_for({"file"})
              .needed_for({"file"}),
      }};
  return keys;
}

MeasurementNoise read_measurement_noise(const YamlValue& value, const std::optional<vision::StereoRig>& rig,
                                        const std::filesystem::path& folder) {
  const YamlMap map(value, measurement_noise_keys());
  if (static_cast<Kind>(map.choice("kind")) != Kind::kFile) return read_noise_law(value, rig);
  const YamlValue file = map.at("file");
  const std::filesystem::path path = folder / file.text();
  if (!std::filesystem::is_regular_file(path))
    file.fail("expected a file that `stereobench calibrate` wrote");
  const YamlDocument document = load_yaml(path);
  const YamlValue law(document, "", document.root, document.root.Mark());
  check_keys(law, measurement_noise_keys());
  return read_noise_law(law, rig);
}

}  // namespace stereobench::worlds
