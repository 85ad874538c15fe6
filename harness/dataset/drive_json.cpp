#include "harness/dataset/drive_json.h"

#include <algorithm>
#include <array>

#include "vision/camera/rig.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kEncodings = {"linear", "srgb", "gamma"};

/// A number of a struct, and its key.
template <class Struct>
struct Number {
  const char* key;
  double Struct::*member;
};

constexpr std::array kIntrinsics = {Number<vision::Intrinsics>{"focal_px", &vision::Intrinsics::focal_px},
                                    Number<vision::Intrinsics>{"cx_px", &vision::Intrinsics::cx_px},
                                    Number<vision::Intrinsics>{"cy_px", &vision::Intrinsics::cy_px}};
constexpr std::array kMounting = {
    Number<vision::StereoRig>{"baseline_m", &vision::StereoRig::baseline_m},
    Number<vision::StereoRig>{"height_m", &vision::StereoRig::height_m},
    Number<vision::StereoRig>{"pitch_down_rad", &vision::StereoRig::pitch_down_rad}};
constexpr std::array kLens = {Number<vision::Distortion>{"k1", &vision::Distortion::k1},
                              Number<vision::Distortion>{"k2", &vision::Distortion::k2},
                              Number<vision::Distortion>{"p1", &vision::Distortion::p1},
                              Number<vision::Distortion>{"p2", &vision::Distortion::p2},
                              Number<vision::Distortion>{"k3", &vision::Distortion::k3},
                              Number<vision::Distortion>{"pixel_aspect", &vision::Distortion::pixel_aspect}};
constexpr std::array kShutter = {
    Number<worlds::Shutter>{"open_s", &worlds::Shutter::open_s},
    Number<worlds::Shutter>{"right_delay_s", &worlds::Shutter::right_delay_s},
    Number<worlds::Shutter>{"readout_s", &worlds::Shutter::readout_s},
    Number<worlds::Shutter>{"drop_probability", &worlds::Shutter::drop_probability},
    Number<worlds::Shutter>{"late_probability", &worlds::Shutter::late_probability},
    Number<worlds::Shutter>{"late_s", &worlds::Shutter::late_s}};

template <class Struct, std::size_t Count>
Json numbers_json(const Struct& value, const std::array<Number<Struct>, Count>& numbers) {
  Json json;
  for (const auto& [key, member] : numbers) json[key] = value.*member;
  return json;
}

template <class Struct, std::size_t Count>
void read_numbers(const JsonValue& json, const std::array<Number<Struct>, Count>& numbers, Struct& value) {
  constexpr double kMost = 1e9;
  for (const auto& [key, member] : numbers) value.*member = json.at(key).number(-kMost, kMost);
}

Json rig_json(const vision::StereoRig& rig) {
  Json json = {{"width_px", rig.intrinsics.width_px}, {"height_px", rig.intrinsics.height_px}};
  json.update(numbers_json(rig.intrinsics, kIntrinsics));
  json.update(numbers_json(rig, kMounting));
  json["right_turn_rad"] = {rig.right_turn_rad.x(), rig.right_turn_rad.y(), rig.right_turn_rad.z()};
  json["lens"] = numbers_json(rig.distortion, kLens);
  return json;
}

/// As scenarios have: folders are called so.
bool is_name(const std::string& text) {
  constexpr std::size_t kLongest = 64;
  return !text.empty() && text.size() <= kLongest &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
}

}  // namespace

Json drive_json(const DatasetDrive& drive) {
  return {{"name", drive.name},
          {"encoding", kEncodings.at(static_cast<std::size_t>(drive.encoding))},
          {"rig", rig_json(drive.rig)},
          {"believed_rig", rig_json(drive.believed_rig)},
          {"shutter", numbers_json(drive.shutter, kShutter)}};
}

vision::StereoRig read_rig(const JsonValue& json) {
  constexpr std::int64_t kLongest_px = 1 << 15;
  constexpr double kMostTurn_rad = 4.0;
  vision::StereoRig rig;
  rig.intrinsics.width_px = static_cast<int>(json.at("width_px").integer(1, kLongest_px));
  rig.intrinsics.height_px = static_cast<int>(json.at("height_px").integer(1, kLongest_px));
  read_numbers(json, kIntrinsics, rig.intrinsics);
  read_numbers(json, kMounting, rig);
  const auto turn = json.at("right_turn_rad").list(3, 3);
  for (std::size_t i = 0; i < 3; ++i)
    rig.right_turn_rad[static_cast<int>(i)] = turn[i].number(-kMostTurn_rad, kMostTurn_rad);
  read_numbers(json.at("lens"), kLens, rig.distortion);
  if (!vision::is_usable(rig)) json.refuse("a rig that can be computed with");
  return rig;
}

void read_drive(const JsonValue& json, DatasetDrive& drive) {
  drive.name = json.at("name").text();
  if (!is_name(drive.name)) json.at("name").refuse("a name of small letters, digits and _, at most 64");
  const std::string encoding = json.at("encoding").text();
  const auto* const known = std::ranges::find(kEncodings, encoding);
  if (known == kEncodings.end()) json.at("encoding").refuse("linear, srgb or gamma");
  drive.encoding = static_cast<worlds::Encoding>(known - kEncodings.begin());
  drive.rig = read_rig(json.at("rig"));
  drive.believed_rig = read_rig(json.at("believed_rig"));
  read_numbers(json.at("shutter"), kShutter, drive.shutter);
}

}  // namespace stereobench::harness
