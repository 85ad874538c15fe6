#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "slam/math/angles.h"
#include "vision/camera/distortion.h"
#include "vision/camera/pinhole_rig.h"
#include "worlds/scenario/scenario_parts.h"

namespace stereobench::worlds {
namespace {

constexpr Interval kNoise = {0.0, 100.0};
constexpr Interval kFocal_px = {1.0, 1e5};
constexpr Interval kCentre_px = {0.0, 4095.0};
constexpr Interval kBaseline_m = {1e-3, 10.0};
constexpr Interval kHeight_m = {1e-3, 100.0};
constexpr Interval kPitch_deg = {-80.0, 80.0};
constexpr Interval kCameraTurn_deg = {-45.0, 45.0};
constexpr Interval kLens = {-100.0, 100.0};
constexpr Interval kAspect = {0.5, 2.0};
constexpr Interval kFieldOfView_deg = {0.1, 360.0};
constexpr Interval kMisses = {0.0, 0.99};
constexpr Interval kFalse = {0.0, 100.0};
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

/// Refuses lenses and pictures that cannot be computed with.
void check_rig(const YamlMap& map, vision::StereoRig& rig) {
  const auto value = map.find("distortion");
  const auto lens = value ? value : map.find("pixel_aspect");
  if (lens && !vision::directions_seen(rig.distortion, rig.intrinsics))
    lens->refuse("expected a lens that does not fold its picture, nor looks more than 80 degrees aside");
  check_field(map, rig);
}

using vision::Distortion;
using vision::Intrinsics;
using vision::StereoRig;

/// The coefficients of a lens, in OpenCV's order.
constexpr std::array<double Distortion::*, 5> kLensOrder = {&Distortion::k1, &Distortion::k2, &Distortion::p1,
                                                            &Distortion::p2, &Distortion::k3};

void read_lens(const YamlValue& value, StereoRig& rig) {
  const std::vector<YamlValue> entries = value.list(kLensOrder.size(), kLensOrder.size());
  for (std::size_t i = 0; i < entries.size(); ++i) rig.distortion.*kLensOrder[i] = entries[i].number(kLens);
}

YAML::Node written_lens(const StereoRig& rig) {
  std::vector<YAML::Node> entries;
  for (const auto coefficient : kLensOrder) entries.push_back(written(Key{}, rig.distortion.*coefficient));
  return flow_list(entries);
}

/// The size of a picture, whose principal point is its middle where nothing else is said.
Field<StereoRig> size(const Key& key, int Intrinsics::*size_px, double Intrinsics::*centre_px) {
  Field<StereoRig> field = key.needed().fills(&StereoRig::intrinsics, size_px);
  field.read = [=, read = field.read](const YamlValue& value, StereoRig& rig) {
    read(value, rig);
    rig.intrinsics.*centre_px = (rig.intrinsics.*size_px - 1) / 2.0;
  };
  return field;
}

/// The principal point lies within the picture.
Field<StereoRig> centre(const Key& key, double Intrinsics::*centre_px, int Intrinsics::*size_px) {
  Field<StereoRig> field = key.fills(&StereoRig::intrinsics, centre_px);
  field.read = [=](const YamlValue& value, StereoRig& rig) {
    rig.intrinsics.*centre_px = value.number({0.0, rig.intrinsics.*size_px - 1.0});
  };
  return field;
}

/// What vision believes of the rig is declared as the rig is; what is left out is as it is.
std::vector<Field<Scenario>> believed_rig_fields() {
  std::vector<Field<StereoRig>> fields;
  for (Field<StereoRig> field : rig_keys().fields()) {
    const bool is_size = field.key.kind == ValueKind::kWhole;
    field.key.required = false;
    field.key.fallback.clear();
    field.key.fallback_says.clear();
    field.key.same_as = fmt::format("rig.{}", field.key.name);
    if (!is_size) fields.push_back(std::move(field));
  }
  std::vector<Field<Scenario>> believed = lifted(&Scenario::believed_rig, fields);
  believed.push_back(
      number("rows_within_px", kRows_px,
             "Rows that the rig may be off by: balls are matched within so many; at most half a picture.")
          .fills(&Scenario::rows_within_px)
          .reading([](const YamlValue& value, Scenario& scenario) {
            scenario.rows_within_px = value.number({kLeastRows_px, 0.5 * scenario.rig.intrinsics.height_px});
          }));
  return believed;
}

}  // namespace

const Fields<StereoRig>& rig_keys() {
  static const Fields<StereoRig> keys(
      {
          size(whole("width_px", 16, 4096, "Columns of a picture."), &Intrinsics::width_px,
               &Intrinsics::cx_px),
          size(whole("height_px", 16, 4096, "Rows of a picture."), &Intrinsics::height_px,
               &Intrinsics::cy_px),
          number("focal_px", kFocal_px, "Focal length, in pixels.")
              .needed()
              .fills(&StereoRig::intrinsics, &Intrinsics::focal_px),
          centre(number("cx_px", kCentre_px, "Column of the principal point, in pixels.")
                     .otherwise_says("(width_px - 1) / 2"),
                 &Intrinsics::cx_px, &Intrinsics::width_px),
          centre(number("cy_px", kCentre_px, "Row of the principal point, in pixels.")
                     .otherwise_says("(height_px - 1) / 2"),
                 &Intrinsics::cy_px, &Intrinsics::height_px),
          number("baseline_m", kBaseline_m, "Distance between the two cameras, in metres.")
              .needed()
              .fills(&StereoRig::baseline_m),
          number("height_m", kHeight_m, "Height of the cameras above the floor, in metres.")
              .needed()
              .fills(&StereoRig::height_m),
          number("pitch_down_deg", kPitch_deg, "How far the cameras look down, in degrees.")
              .times(slam::kRadPerDegree)
              .fills(&StereoRig::pitch_down_rad),
          number("right_turn_deg", kCameraTurn_deg,
                 "Turn of the right camera out of its place, about the camera's x, y and z, in degrees.")
              .times(slam::kRadPerDegree)
              .fills(&StereoRig::right_turn_rad),
          number("distortion", kLens, "Lens coefficients in OpenCV's order: k1, k2, p1, p2, k3.")
              .vector(kLensOrder.size())
              .by<StereoRig>(read_lens, written_lens),
          number("pixel_aspect", kAspect, "A pixel's width over its height: fy / fx; focal_px is fx.")
              .fills(&StereoRig::distortion, &Distortion::pixel_aspect),
      },
      check_rig);
  return keys;
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
                          "{:.3g} pixels for one, its picture has {} x {}, and {} each way is the most",
                          pinhole.focal_px / rig.intrinsics.focal_px, pinhole.width_px, pinhole.height_px,
                          vision::kLargestPinhole_px));
}

const Fields<Scenario>& believed_rig_keys() {
  static const Fields<Scenario> keys(believed_rig_fields(), [](const YamlMap& map, Scenario& scenario) {
    check_rig(map, scenario.believed_rig);
  });
  return keys;
}

const Fields<slam::OdometryNoise>& odometry_noise_keys() {
  static const Fields<slam::OdometryNoise> keys({
      number("v_constant_mps", kNoise, "Standard deviation of the forward speed: constant part, in m/s.")
          .fills(&slam::OdometryNoise::v_constant_mps),
      number("v_per_v", kNoise, "The same per m/s of forward speed.").fills(&slam::OdometryNoise::v_per_v),
      number("v_per_w", kNoise, "The same per rad/s of turn rate.").fills(&slam::OdometryNoise::v_per_w),
      number("w_constant_degps", {0.0, 1e4},
             "Standard deviation of the turn rate: constant part, in degrees per second.")
          .times(slam::kRadPerDegree)
          .fills(&slam::OdometryNoise::w_constant_radps),
      number("w_per_v", kNoise, "The same, in rad/s, per m/s of forward speed.")
          .fills(&slam::OdometryNoise::w_per_v),
      number("w_per_w", kNoise, "The same, in rad/s, per rad/s of turn rate.")
          .fills(&slam::OdometryNoise::w_per_w),
      number("correlation_s", {0.0, 1e3}, "How long an error lasts, in seconds.")
          .fills(&slam::OdometryNoise::correlation_s),
  });
  return keys;
}

const Fields<StartNoise>& start_noise_keys() {
  static const Fields<StartNoise> keys({
      number("position_sd_m", kNoise, "Standard deviation of its x and of its y, in metres.")
          .fills(&StartNoise::position_sd_m),
      number("heading_sd_deg", {0.0, 180.0}, "Standard deviation of its heading, in degrees.")
          .times(slam::kRadPerDegree)
          .fills(&StartNoise::heading_sd_rad),
  });
  return keys;
}

const Fields<OracleSensor>& oracle_keys() {
  static const Fields<OracleSensor> keys({
      number("range_sd_m", kNoise, "Standard deviation of a range, in metres.")
          .needed()
          .fills(&OracleSensor::range_sd_m),
      number("bearing_sd_deg", {0.0, 180.0}, "Standard deviation of a bearing, in degrees.")
          .needed()
          .times(slam::kRadPerDegree)
          .fills(&OracleSensor::bearing_sd_rad),
      number("max_range_m", kSize_m, "How far it sees, in metres.")
          .needed()
          .fills(&OracleSensor::max_range_m),
      number("field_of_view_deg", kFieldOfView_deg, "Whole angle of its sector, in degrees.")
          .needed()
          .times(slam::kRadPerDegree)
          .fills(&OracleSensor::field_of_view_rad),
      number("miss_probability", kMisses, "Probability that it misses a ball in view.")
          .fills(&OracleSensor::miss_probability),
      number("false_per_look", kFalse, "Mean number of sightings of nothing in a look.")
          .fills(&OracleSensor::false_per_look),
  });
  return keys;
}

}  // namespace stereobench::worlds
