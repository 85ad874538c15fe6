#include <array>
#include <numbers>
#include <span>

#include "vision/distortion.h"
#include "worlds/oracle.h"
#include "worlds/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr Interval kSize_m = {1e-3, 1e4};
constexpr Interval kNoise = {0.0, 100.0};
constexpr Interval kTurn_deg = {-45.0, 45.0};

vision::Distortion read_distortion(const YamlValue& value, const vision::Intrinsics& camera) {
  const Eigen::Matrix<double, 5, 1> k = read_vector<5>(value, {-100.0, 100.0});
  const vision::Distortion lens = {.k1 = k[0], .k2 = k[1], .p1 = k[2], .p2 = k[3], .k3 = k[4]};
  if (!vision::directions_seen(lens, camera))
    value.refuse("expected a lens that does not fold its picture, nor looks more than 80 degrees aside");
  return lens;
}

}  // namespace

vision::StereoRig read_rig(const YamlValue& value) {
  const YamlMap map(value, {"width_px", "height_px", "focal_px", "cx_px", "cy_px", "baseline_m", "height_m",
                            "pitch_down_deg", "right_turn_deg", "distortion"});
  vision::StereoRig rig;
  rig.camera.width_px = map.at("width_px").integer(16, 4096);
  rig.camera.height_px = map.at("height_px").integer(16, 4096);
  rig.camera.focal_px = map.number("focal_px", {1.0, 1e5});
  const double right_px = rig.camera.width_px - 1;
  const double bottom_px = rig.camera.height_px - 1;
  rig.camera.cx_px = map.number("cx_px", {0.0, right_px}, right_px / 2.0);
  rig.camera.cy_px = map.number("cy_px", {0.0, bottom_px}, bottom_px / 2.0);
  rig.baseline_m = map.number("baseline_m", {1e-3, 10.0});
  rig.height_m = map.number("height_m", {1e-3, 100.0});
  rig.pitch_down_rad = map.number("pitch_down_deg", {-80.0, 80.0}, 0.0) * kDegree;
  if (const auto turn = map.find("right_turn_deg"))
    rig.right_turn_rad = read_vector<3>(*turn, kTurn_deg) * kDegree;
  if (const auto lens = map.find("distortion")) rig.distortion = read_distortion(*lens, rig.camera);
  return rig;
}

vision::StereoRig read_believed_rig(const YamlValue& value, const vision::StereoRig& truth) {
  const YamlMap map(value, {"focal_px", "cx_px", "cy_px", "baseline_m", "height_m", "pitch_down_deg",
                            "right_turn_deg", "distortion"});
  vision::StereoRig rig = truth;
  rig.camera.focal_px = map.number("focal_px", {1.0, 1e5}, rig.camera.focal_px);
  rig.camera.cx_px = map.number("cx_px", {0.0, rig.camera.width_px - 1.0}, rig.camera.cx_px);
  rig.camera.cy_px = map.number("cy_px", {0.0, rig.camera.height_px - 1.0}, rig.camera.cy_px);
  rig.baseline_m = map.number("baseline_m", {1e-3, 10.0}, rig.baseline_m);
  rig.height_m = map.number("height_m", {1e-3, 100.0}, rig.height_m);
  rig.pitch_down_rad = map.number("pitch_down_deg", {-80.0, 80.0}, rig.pitch_down_rad / kDegree) * kDegree;
  if (const auto turn = map.find("right_turn_deg"))
    rig.right_turn_rad = read_vector<3>(*turn, kTurn_deg) * kDegree;
  if (const auto lens = map.find("distortion")) rig.distortion = read_distortion(*lens, rig.camera);
  return rig;
}

slam::OdometryNoise read_odometry_noise(const YamlValue& value) {
  const YamlMap map(value, {"v_constant_mps", "v_per_v", "v_per_w", "w_constant_degps", "w_per_v", "w_per_w",
                            "correlation_s"});
  slam::OdometryNoise noise;
  noise.v_constant_mps = map.number("v_constant_mps", kNoise, 0.0);
  noise.v_per_v = map.number("v_per_v", kNoise, 0.0);
  noise.v_per_w = map.number("v_per_w", kNoise, 0.0);
  noise.w_constant_radps = map.number("w_constant_degps", {0.0, 1e4}, 0.0) * kDegree;
  noise.w_per_v = map.number("w_per_v", kNoise, 0.0);
  noise.w_per_w = map.number("w_per_w", kNoise, 0.0);
  noise.correlation_s = map.number("correlation_s", {0.0, 1e3}, 0.0);
  return noise;
}

namespace {

constexpr Interval kScale = {1e-3, 1e3};

MeasurementNoise read_stated_noise(const YamlValue& value) {
  const YamlMap map(value, {"kind", "range_sd_scale", "bearing_sd_scale"});
  return {.stated_sd_scale = {map.number("range_sd_scale", kScale, 1.0),
                              map.number("bearing_sd_scale", kScale, 1.0)}};
}

MeasurementNoise read_constant_noise(const YamlValue& value) {
  const YamlMap map(value, {"kind", "range_sd_m", "bearing_sd_deg"});
  return {.law = slam::NoiseLaw{.range_sd_m = map.number("range_sd_m", kNoise),
                                .bearing_sd_rad = map.number("bearing_sd_deg", {0.0, 180.0}) * kDegree}};
}

MeasurementNoise read_stereo_noise(const YamlValue& value, const std::optional<vision::StereoRig>& rig) {
  const YamlMap map(value, {"kind", "range_sd_m", "disparity_sd_px", "bearing_sd_px"});
  if (!rig) value.refuse("expected a rig beside the stereo law");
  const double focal_px = rig->camera.focal_px;
  return {.law = slam::NoiseLaw{
              .range_sd_m = map.number("range_sd_m", kNoise, 0.0),
              .range_sd_per_m2 = map.number("disparity_sd_px", kNoise) / (focal_px * rig->baseline_m),
              .bearing_sd_rad = map.number("bearing_sd_px", kNoise) / focal_px}};
}

constexpr std::array<std::string_view, 4> kNoiseKinds = {"per_observation", "constant", "stereo", "file"};

std::size_t noise_kind(const YamlValue& value, std::size_t kinds) {
  const YamlMap map(value, {"kind", "range_sd_m", "bearing_sd_deg", "disparity_sd_px", "bearing_sd_px",
                            "range_sd_scale", "bearing_sd_scale", "file"});
  return map.at("kind").choice(std::span(kNoiseKinds).first(kinds));
}

/// A law that is written where it is asked for, and not in a file.
MeasurementNoise read_noise_law(const YamlValue& value, const std::optional<vision::StereoRig>& rig) {
  const std::size_t kind = noise_kind(value, kNoiseKinds.size() - 1);
  if (kind == 0) return read_stated_noise(value);
  return kind == 1 ? read_constant_noise(value) : read_stereo_noise(value, rig);
}

}  // namespace

MeasurementNoise read_measurement_noise(const YamlValue& value, const std::optional<vision::StereoRig>& rig,
                                        const std::filesystem::path& folder) {
  if (noise_kind(value, kNoiseKinds.size()) + 1 < kNoiseKinds.size()) return read_noise_law(value, rig);
  const YamlValue file = YamlMap(value, {"kind", "file"}).at("file");
  const std::filesystem::path path = folder / file.text();
  if (!std::filesystem::is_regular_file(path))
    file.fail("expected a file that `stereobench calibrate` wrote");
  const YamlDocument document = load_yaml(path, {});
  return read_noise_law(YamlValue(document, "", document.root, document.root.Mark()), rig);
}

namespace {

constexpr Interval kFieldOfView_deg = {0.1, 360.0};
constexpr Interval kMisses = {0.0, 0.99};
constexpr Interval kFalse = {0.0, 100.0};

}  // namespace

OracleSensor read_oracle(const YamlValue& value) {
  const YamlMap map(value, {"range_sd_m", "bearing_sd_deg", "max_range_m", "field_of_view_deg",
                            "miss_probability", "false_per_look"});
  OracleSensor sensor;
  sensor.range_sd_m = map.number("range_sd_m", kNoise);
  sensor.bearing_sd_rad = map.number("bearing_sd_deg", {0.0, 180.0}) * kDegree;
  sensor.max_range_m = map.number("max_range_m", kSize_m);
  sensor.field_of_view_rad = map.number("field_of_view_deg", kFieldOfView_deg) * kDegree;
  sensor.miss_probability = map.number("miss_probability", kMisses, 0.0);
  sensor.false_per_look = map.number("false_per_look", kFalse, 0.0);
  return sensor;
}

slam::SensorSector read_believed_oracle(const YamlValue& value, const OracleSensor& oracle) {
  const YamlMap map(value, {"max_range_m", "field_of_view_deg", "miss_probability", "false_per_look"});
  slam::SensorSector believed = sector_of(oracle);
  believed.range_m = map.number("max_range_m", {0.0, kSize_m.most}, believed.range_m);
  if (const auto view = map.find("field_of_view_deg"))
    believed.half_angle_rad = view->number(kFieldOfView_deg) * kDegree / 2.0;
  believed.miss_probability = map.number("miss_probability", kMisses, believed.miss_probability);
  believed.false_per_look = map.number("false_per_look", kFalse, believed.false_per_look);
  return believed;
}

}  // namespace stereobench::worlds
