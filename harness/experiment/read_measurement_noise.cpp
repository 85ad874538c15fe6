#include "harness/experiment/experiment_parts.h"
#include "slam/math/angles.h"

namespace stereobench::harness {
namespace {

using worlds::choice;
using worlds::Fields;
using worlds::Interval;
using worlds::number;
using worlds::text;
using worlds::YamlMap;
using worlds::YamlValue;

constexpr Interval kNoise = {0.0, 100.0};
constexpr Interval kScale = {1e-3, 1e3};

enum class Kind { kPerObservation, kConstant, kStereo, kFile };

/// What the lines of a law say.
struct Lines {
  Kind kind = Kind::kPerObservation;
  double range_sd_m = 0.0;
  double bearing_sd_rad = 0.0;
  double disparity_sd_px = 0.0;
  double bearing_sd_px = 0.0;
  double range_sd_scale = 1.0;
  double bearing_sd_scale = 1.0;
  std::filesystem::path file;
};

slam::NoiseLaw stereo_law(const Lines& lines, const vision::StereoRig& rig) {
  const double focal_px = rig.intrinsics.focal_px;
  return {.range_sd_m = lines.range_sd_m,
          .range_sd_per_m2 = lines.disparity_sd_px / (focal_px * rig.baseline_m),
          .bearing_sd_rad = lines.bearing_sd_px / focal_px};
}

void read_file(const YamlValue& file, Lines& lines) {
  lines.file = file.folder() / file.text();
}

const Fields<Lines>& line_keys() {
  static const Fields<Lines> keys(
      "kind",
      {
          choice("kind", {"per_observation", "constant", "stereo", "file"},
                 "Whether sightings state their noise, or a law says it of all.")
              .needed()
              .fills(&Lines::kind),
          number("range_sd_m", kNoise,
                 "Standard deviation of a range, in metres; of `stereo`, its constant part.")
              .only_for({"constant", "stereo"})
              .needed_for({"constant"})
              .fills(&Lines::range_sd_m),
          number("bearing_sd_deg", {0.0, 180.0}, "Standard deviation of a bearing, in degrees.")
              .only_for({"constant"})
              .needed_for({"constant"})
              .times(slam::kRadPerDegree)
              .fills(&Lines::bearing_sd_rad),
          number("disparity_sd_px", kNoise,
                 "Standard deviation of a disparity, in pixels: that of a range grows with its square.")
              .only_for({"stereo"})
              .needed_for({"stereo"})
              .fills(&Lines::disparity_sd_px),
          number("bearing_sd_px", kNoise, "Standard deviation of a column, in pixels.")
              .only_for({"stereo"})
              .needed_for({"stereo"})
              .fills(&Lines::bearing_sd_px),
          number("range_sd_scale", kScale, "Factor on the standard deviation of ranges that sightings state.")
              .only_for({"per_observation"})
              .fills(&Lines::range_sd_scale),
          number("bearing_sd_scale", kScale,
                 "Factor on the standard deviation of bearings that sightings state.")
              .only_for({"per_observation"})
              .fills(&Lines::bearing_sd_scale),
          text("file", "What `stereobench calibrate` wrote, relative to the scenario's folder.")
              .only_for({"file"})
              .needed_for({"file"})
              .by<Lines>(read_file),
      });
  return keys;
}

/// A law that is written where it is asked for, and not in a file.
MeasurementNoise noise_of(const Lines& lines, const YamlValue& value,
                          const std::optional<vision::StereoRig>& rig) {
  switch (lines.kind) {
    case Kind::kPerObservation:
      return {.stated_sd_scale = {lines.range_sd_scale, lines.bearing_sd_scale}};
    case Kind::kConstant:
      return {.law = slam::NoiseLaw{.range_sd_m = lines.range_sd_m, .bearing_sd_rad = lines.bearing_sd_rad}};
    case Kind::kStereo:
      if (!rig) value.refuse("expected a rig beside the stereo law");
      return {.law = stereo_law(lines, *rig)};
    case Kind::kFile:
      break;
  }
  YamlMap(value, line_keys()).at("kind").fail("expected a law, and no further file");
}

}  // namespace

const worlds::KeyGroup& measurement_noise_keys() {
  return line_keys();
}

MeasurementNoise read_measurement_noise(const YamlValue& value, const std::optional<vision::StereoRig>& rig) {
  const Lines lines = line_keys().read(value);
  if (lines.kind != Kind::kFile) return noise_of(lines, value, rig);
  if (!std::filesystem::is_regular_file(lines.file))
    YamlMap(value, line_keys()).at("file").fail("expected a file that `stereobench calibrate` wrote");
  const worlds::YamlDocument document = worlds::load_yaml(lines.file, {}, line_keys());
  const YamlValue law(document, "", document.root, document.root.Mark());
  check_keys(law, line_keys());
  return noise_of(line_keys().read(law), law, rig);
}

}  // namespace stereobench::harness
