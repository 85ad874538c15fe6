#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "slam/math/angles.h"
#include "vision/camera/distortion.h"
#include "vision/camera/pinhole_rig.h"
#include "worlds/oracle.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kSize_m = {1e-3, 1e4};
constexpr Interval kNoise = {0.0, 100.0};
constexpr Interval kFocal_px = {1.0, 1e5};
constexpr Interval kCentre_px = {0.0, 4095.0};
constexpr Interval kBaseline_m = {1e-3, 10.0};
constexpr Interval kHeight_m = {1e-3, 100.0};
constexpr Interval kPitch_deg = {-80.0, 80.0};
constexpr Interval kTurn_deg = {-45.0, 45.0};
constexpr Interval kLens = {-100.0, 100.0};
constexpr Interval kAspect = {0.5, 2.0};
constexpr double kLeastRows_px = 0.1;
constexpr Interval kRows_px = {kLeastRows_px, 2048.0};

/// Refuses a camera without a lens that looks further aside than any may, by what is written of its shape.
void check_field(const YamlMap& map, const vision::StereoRig& rig) {
  const vision::Intrinsics& camera = rig.intrinsics;
  if (!(rig.distortion == vision::Distortion{}) || vision::directions_seen({}, camera)) return;
  const double furthest_px = std::max({camera.cx_px + 0.5, camera.width_px - 0.5 - camera.cx_px,
                                       camera.cy_px + 0.5, camera.height_px - 0.5 - camera.cy_px});
  const auto focal = map.find("focal_px");
  const auto blamed = focal ? focal : map.find("cx_px") ? map.find("cx_px") : map.at("cy_px");
  blamed->fail(
      fmt::format("expected a focal length of at least {:.2f} px, or a pixel looks more than 80 degrees "
                  "aside",
                  std::ceil(100.0 * furthest_px / vision::kWidestTangent) / 100.0));
}

void read_distortion(const YamlMap& map, vision::StereoRig& rig) {
  const auto value = map.find("distortion");
  const auto aspect = map.find("pixel_aspect");
  const Eigen::Matrix<double, 5, 1> otherwise(rig.distortion.k1, rig.distortion.k2, rig.distortion.p1,
                                              rig.distortion.p2, rig.distortion.k3);
  const Eigen::Matrix<double, 5, 1> k = read_vector<5>(map, "distortion", otherwise);
  rig.distortion = {.k1 = k[0],
                    .k2 = k[1],
                    .p1 = k[2],
                    .p2 = k[3],
                    .k3 = k[4],
                    .pixel_aspect = map.number("pixel_aspect", rig.distortion.pixel_aspect)};
  if ((value || aspect) && !vision::directions_seen(rig.distortion, rig.intrinsics))
    (value ? value : aspect)
        ->refuse("expected a lens that does not fold its picture, nor looks more than 80 degrees aside");
}

/// A centre of the picture lies within it.
double read_centre_px(const YamlMap& map, std::string_view key, double last_px, double otherwise_px) {
  const auto value = map.find(key);
  return value ? value->number({0.0, last_px}) : map.number(key, otherwise_px);
}

/// What the true rig and the believed one have in common. @param rig defaults
void read_rig_parts(const YamlMap& map, vision::StereoRig& rig) {
  vision::Intrinsics& camera = rig.intrinsics;
  camera.cx_px = read_centre_px(map, "cx_px", camera.width_px - 1.0, camera.cx_px);
  camera.cy_px = read_centre_px(map, "cy_px", camera.height_px - 1.0, camera.cy_px);
  rig.pitch_down_rad =
      map.number("pitch_down_deg", rig.pitch_down_rad / slam::kRadPerDegree) * slam::kRadPerDegree;
  if (map.find("right_turn_deg"))
    rig.right_turn_rad = read_vector<3>(map, "right_turn_deg") * slam::kRadPerDegree;
  read_distortion(map, rig);
  check_field(map, rig);
}

}  // namespace

const KeyGroup& rig_keys() {
  static const KeyGroup keys = {
      .keys = {
          whole("width_px", 16, 4096, "Columns of a picture.").needed(),
          whole("height_px", 16, 4096, "Rows of a picture.").needed(),
          number("focal_px", kFocal_px, "Focal length, in pixels.").needed(),
          number("cx_px", kCentre_px, "Column of the principal point, in pixels.")
              .otherwise_says("(width_px - 1) / 2"),
          number("cy_px", kCentre_px, "Row of the principal point, in pixels.")
              .otherwise_says("(height_px - 1) / 2"),
          number("baseline_m", kBaseline_m, "Distance between the two cameras, in metres.").needed(),
          number("height_m", kHeight_m, "Height of the cameras above the floor, in metres.").needed(),
          number("pitch_down_deg", kPitch_deg, "How far the cameras look down, in degrees.").otherwise("0"),
          number("right_turn_deg", kTurn_deg,
                 "Turn of the right camera out of its place, about the camera's x, y and z, in degrees.")
              .vector(3)
              .otherwise("[0, 0, 0]"),
          number("distortion", kLens, "Lens coefficients in OpenCV's order: k1, k2, p1, p2, k3.")
              .vector(5)
              .otherwise("[0, 0, 0, 0, 0]"),
          number("pixel_aspect", kAspect, "A pixel's width over its height: fy / fx; focal_px is fx.")
              .otherwise("1"),
      }};
  return keys;
}

vision::StereoRig read_rig(const YamlValue& value) {
  const YamlMap map(value, rig_keys());
  vision::StereoRig rig;
  rig.intrinsics.width_px = map.whole("width_px");
  rig.intrinsics.height_px = map.whole("height_px");
  rig.intrinsics.focal_px = map.number("focal_px");
  rig.intrinsics.cx_px = (rig.intrinsics.width_px - 1) / 2.0;
  rig.intrinsics.cy_px = (rig.intrinsics.height_px - 1) / 2.0;
  rig.baseline_m = map.number("baseline_m");
  rig.height_m = map.number("height_m");
  rig.pitch_down_rad = 0.0;
  read_rig_parts(map, rig);
  return rig;
}

void check_lens(const YamlValue& value, const vision::StereoRig& rig) {
  if (rig.distortion == vision::Distortion{}) return;
  const vision::Intrinsics pinhole = vision::pinhole_rig(rig).value().intrinsics;
  if (vision::can_be_drawn(pinhole)) return;
  vision::Distortion distorted = rig.distortion;
  distorted.pixel_aspect = 1.0;
  const YamlMap map(value, rig_keys());
  map.at(distorted == vision::Distortion{} ? "pixel_aspect" : "distortion")
      .refuse(fmt::format("expected fewer pixels, or a lens that looks less far aside: drawn straight, with "
                          "{} pixels for one, its picture has {} x {}, and {} each way is the most",
                          vision::kPinholeDensity, pinhole.width_px, pinhole.height_px,
                          vision::kLargestPinhole_px));
}

const KeyGroup& believed_rig_keys() {
  static const KeyGroup keys = {
      .keys = {
          number("focal_px", kFocal_px, "Focal length, in pixels.").otherwise_as("rig.focal_px"),
          number("cx_px", kCentre_px, "Column of the principal point, in pixels.").otherwise_as("rig.cx_px"),
          number("cy_px", kCentre_px, "Row of the principal point, in pixels.").otherwise_as("rig.cy_px"),
          number("baseline_m", kBaseline_m, "Distance between the two cameras, in metres.")
              .otherwise_as("rig.baseline_m"),
          number("height_m", kHeight_m, "Height of the cameras above the floor, in metres.")
              .otherwise_as("rig.height_m"),
          number("pitch_down_deg", kPitch_deg, "How far the cameras look down, in degrees.")
              .otherwise_as("rig.pitch_down_deg"),
          number("right_turn_deg", kTurn_deg,
                 "Turn of the right camera out of its place, about the camera's x, y and z, in degrees.")
              .vector(3)
              .otherwise_as("rig.right_turn_deg"),
          number("distortion", kLens, "Lens coefficients in OpenCV's order: k1, k2, p1, p2, k3.")
              .vector(5)
              .otherwise_as("rig.distortion"),
          number("pixel_aspect", kAspect, "A pixel's width over its height: fy / fx; focal_px is fx.")
              .otherwise_as("rig.pixel_aspect"),
          number("rows_within_px", kRows_px,
                 "Rows that the rig may be off by: balls are matched within so many; at most half a picture.")
              .otherwise("10"),
      }};
  return keys;
}

vision::StereoRig read_believed_rig(const YamlValue& value, const vision::StereoRig& truth) {
  const YamlMap map(value, believed_rig_keys());
  vision::StereoRig rig = truth;
  rig.intrinsics.focal_px = map.number("focal_px", rig.intrinsics.focal_px);
  rig.baseline_m = map.number("baseline_m", rig.baseline_m);
  rig.height_m = map.number("height_m", rig.height_m);
  read_rig_parts(map, rig);
  return rig;
}

double read_rows_within_px(const YamlValue& value, const vision::Intrinsics& camera, double otherwise_px) {
  const YamlMap map(value, believed_rig_keys());
  const auto rows = map.find("rows_within_px");
  return rows ? rows->number({kLeastRows_px, 0.5 * camera.height_px}) : otherwise_px;
}

const KeyGroup& odometry_noise_keys() {
  static const KeyGroup keys = {
      .keys = {
          number("v_constant_mps", kNoise, "Standard deviation of the forward speed: constant part, in m/s.")
              .otherwise("0"),
          number("v_per_v", kNoise, "The same per m/s of forward speed.").otherwise("0"),
          number("v_per_w", kNoise, "The same per rad/s of turn rate.").otherwise("0"),
          number("w_constant_degps", {0.0, 1e4},
                 "Standard deviation of the turn rate: constant part, in degrees per second.")
              .otherwise("0"),
          number("w_per_v", kNoise, "The same, in rad/s, per m/s of forward speed.").otherwise("0"),
          number("w_per_w", kNoise, "The same, in rad/s, per rad/s of turn rate.").otherwise("0"),
          number("correlation_s", {0.0, 1e3}, "How long an error lasts, in seconds.").otherwise("0"),
      }};
  return keys;
}

slam::OdometryNoise read_odometry_noise(const YamlValue& value) {
  const YamlMap map(value, odometry_noise_keys());
  slam::OdometryNoise noise;
  noise.v_constant_mps = map.number("v_constant_mps", 0.0);
  noise.v_per_v = map.number("v_per_v", 0.0);
  noise.v_per_w = map.number("v_per_w", 0.0);
  noise.w_constant_radps = map.number("w_constant_degps", 0.0) * slam::kRadPerDegree;
  noise.w_per_v = map.number("w_per_v", 0.0);
  noise.w_per_w = map.number("w_per_w", 0.0);
  noise.correlation_s = map.number("correlation_s", 0.0);
  return noise;
}

namespace {

constexpr Interval kFieldOfView_deg = {0.1, 360.0};
constexpr Interval kMisses = {0.0, 0.99};
constexpr Interval kFalse = {0.0, 100.0};

}  // namespace

const KeyGroup& oracle_keys() {
  static const KeyGroup keys = {
      .keys = {
          number("range_sd_m", kNoise, "Standard deviation of a range, in metres.").needed(),
          number("bearing_sd_deg", {0.0, 180.0}, "Standard deviation of a bearing, in degrees.").needed(),
          number("max_range_m", kSize_m, "How far it sees, in metres.").needed(),
          number("field_of_view_deg", kFieldOfView_deg, "Whole angle of its sector, in degrees.").needed(),
          number("miss_probability", kMisses, "Probability that it misses a ball in view.").otherwise("0"),
          number("false_per_look", kFalse, "Mean number of sightings of nothing in a look.").otherwise("0"),
      }};
  return keys;
}

const KeyGroup& believed_oracle_keys() {
  static const KeyGroup keys = {
      .keys = {
          number("max_range_m", {0.0, kSize_m.most},
                 "How far filters believe it to see, in metres; 0: no limit.")
              .otherwise_as("oracle.max_range_m"),
          number("field_of_view_deg", kFieldOfView_deg, "Whole angle of its believed sector, in degrees.")
              .otherwise_as("oracle.field_of_view_deg"),
          number("miss_probability", kMisses, "Believed probability that it misses a ball in view.")
              .otherwise_as("oracle.miss_probability"),
          number("false_per_look", kFalse, "Believed mean number of sightings of nothing in a look.")
              .otherwise_as("oracle.false_per_look"),
      }};
  return keys;
}

OracleSensor read_oracle(const YamlValue& value) {
  const YamlMap map(value, oracle_keys());
  OracleSensor sensor;
  sensor.range_sd_m = map.number("range_sd_m");
  sensor.bearing_sd_rad = map.number("bearing_sd_deg") * slam::kRadPerDegree;
  sensor.max_range_m = map.number("max_range_m");
  sensor.field_of_view_rad = map.number("field_of_view_deg") * slam::kRadPerDegree;
  sensor.miss_probability = map.number("miss_probability", 0.0);
  sensor.false_per_look = map.number("false_per_look", 0.0);
  return sensor;
}

slam::SensorSector read_believed_oracle(const YamlValue& value, const OracleSensor& oracle) {
  const YamlMap map(value, believed_oracle_keys());
  slam::SensorSector believed = sector_of(oracle);
  believed.range_m = map.number("max_range_m", believed.range_m);
  if (map.find("field_of_view_deg"))
    believed.half_angle_rad = map.number("field_of_view_deg") * slam::kRadPerDegree / 2.0;
  believed.miss_probability = map.number("miss_probability", believed.miss_probability);
  believed.false_per_look = map.number("false_per_look", believed.false_per_look);
  return believed;
}

}  // namespace stereobench::worlds
