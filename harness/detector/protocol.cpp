#include "harness/detector/protocol.h"

#include <algorithm>
#include <array>

#include "harness/json/json_line.h"
#include "vision/palette.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProtocol = "stereobench-detector";
constexpr int kVersion = 1;
constexpr double kMost = 1e9;
constexpr std::array<const char*, 3> kEncodings = {"linear", "srgb", "gamma"};  // as worlds::Encoding

Json rig_json(const vision::StereoRig& rig) {
  const Eigen::Vector3d& turn = rig.right_turn_rad;
  const vision::Distortion& lens = rig.distortion;
  return {{"width_px", rig.intrinsics.width_px},
          {"height_px", rig.intrinsics.height_px},
          {"focal_px", rig.intrinsics.focal_px},
          {"cx_px", rig.intrinsics.cx_px},
          {"cy_px", rig.intrinsics.cy_px},
          {"baseline_m", rig.baseline_m},
          {"height_m", rig.height_m},
          {"pitch_down_rad", rig.pitch_down_rad},
          {"right_turn_rad", {turn.x(), turn.y(), turn.z()}},
          {"distortion", {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}},
          {"pixel_aspect", lens.pixel_aspect}};
}

std::vector<double> numbers(const JsonValue& value, std::size_t count) {
  std::vector<double> read;
  for (const JsonValue& part : value.list(count, count)) read.push_back(part.number(-kMost, kMost));
  return read;
}

vision::StereoRig read_rig(const JsonValue& value) {
  value.allow({"width_px", "height_px", "focal_px", "cx_px", "cy_px", "baseline_m", "height_m",
               "pitch_down_rad", "right_turn_rad", "distortion", "pixel_aspect"});
  constexpr std::int64_t kLargestPicture_px = 1 << 16;
  vision::StereoRig rig;
  rig.intrinsics.width_px = static_cast<int>(value.at("width_px").integer(1, kLargestPicture_px));
  rig.intrinsics.height_px = static_cast<int>(value.at("height_px").integer(1, kLargestPicture_px));
  rig.intrinsics.focal_px = value.at("focal_px").number(kLeastPositive, kMost);
  rig.intrinsics.cx_px = value.at("cx_px").number(-kMost, kMost);
  rig.intrinsics.cy_px = value.at("cy_px").number(-kMost, kMost);
  rig.baseline_m = value.at("baseline_m").number(kLeastPositive, kMost);
  rig.height_m = value.at("height_m").number(-kMost, kMost);
  rig.pitch_down_rad = value.at("pitch_down_rad").number(-kMost, kMost);
  const std::vector<double> turn = numbers(value.at("right_turn_rad"), 3);
  rig.right_turn_rad = {turn[0], turn[1], turn[2]};
  const std::vector<double> k = numbers(value.at("distortion"), 5);
  rig.distortion = {.k1 = k[0],
                    .k2 = k[1],
                    .p1 = k[2],
                    .p2 = k[3],
                    .k3 = k[4],
                    .pixel_aspect = value.at("pixel_aspect").number(kLeastPositive, kMost)};
  return rig;
}

worlds::Encoding read_encoding(const JsonValue& value) {
  const auto found = std::find(kEncodings.begin(), kEncodings.end(), value.text());
  if (found == kEncodings.end()) value.refuse("linear, srgb or gamma");
  return static_cast<worlds::Encoding>(found - kEncodings.begin());
}

}  // namespace

std::string setup_line(const DetectorSetup& setup) {
  Json palette = Json::array();
  for (const vision::PaletteColour& colour : vision::kPalette)
    palette.push_back({colour.r, colour.g, colour.b});
  Json json = {{"protocol", kProtocol},
               {"version", kVersion},
               {"rig", rig_json(setup.rig)},
               {"ball_radius_m", setup.ball_radius_m},
               {"ball_radius_sd_m", setup.ball_radius_sd_m},
               {"rows_within_px", setup.rows_within_px},
               {"palette_rgb", std::move(palette)},
               {"noise_sd_levels", setup.noise_sd_levels},
               {"encoding", kEncodings[static_cast<std::size_t>(setup.encoding)]}};
  if (setup.encoding == worlds::Encoding::kGamma) json["gamma"] = setup.gamma;
  return json.dump();
}

DetectorSetup read_setup(const std::string& line) {
  const nlohmann::json json = parse_line(line);
  const JsonValue value(json, "");
  value.allow({"protocol", "version", "rig", "ball_radius_m", "ball_radius_sd_m", "rows_within_px",
               "palette_rgb", "noise_sd_levels", "encoding", "gamma"});
  if (value.at("protocol").text() != kProtocol) value.at("protocol").refuse(kProtocol);
  value.at("version").integer(kVersion, kVersion);
  DetectorSetup setup{.rig = read_rig(value.at("rig")),
                      .ball_radius_m = value.at("ball_radius_m").number(kLeastPositive, kMost),
                      .ball_radius_sd_m = value.at("ball_radius_sd_m").number(0.0, kMost),
                      .noise_sd_levels = value.at("noise_sd_levels").number(0.0, kMost),
                      .encoding = read_encoding(value.at("encoding"))};
  if (const auto rows = value.find("rows_within_px"))
    setup.rows_within_px = rows->number(kLeastPositive, kMost);
  if (setup.encoding == worlds::Encoding::kGamma)
    setup.gamma = value.at("gamma").number(kLeastPositive, kMost);
  return setup;
}

std::string request_line(const FrameRequest& request) {
  const Json json = {{"frame", request.frame},
                     {"stamp_ns", request.stamp_ns},
                     {"left", request.left.string()},
                     {"right", request.right.string()}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

FrameRequest read_request(const std::string& line) {
  const nlohmann::json json = parse_line(line);
  const JsonValue value(json, "");
  value.allow({"frame", "stamp_ns", "left", "right"});
  return {static_cast<std::size_t>(value.at("frame").integer(0, INT64_MAX)),
          value.at("stamp_ns").integer(INT64_MIN, INT64_MAX), value.at("left").text(),
          value.at("right").text()};
}

}  // namespace stereobench::harness
