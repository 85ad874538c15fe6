#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "harness/golden/golden_difference.h"

namespace stereobench::harness {
namespace {

constexpr double kTellable_px = 0.005;  // smaller shifts are not told to people
constexpr std::size_t kToldShifts = 3;

constexpr std::array<const char*, kPixelPlaces> kKeys = {"ball_edges", "balls", "meshes",
                                                         "walls",      "floor", "background"};

std::string places_text(const PictureDifference& picture) {
  std::vector<std::string> parts;
  for (std::size_t place = 0; place < kPixelPlaces; ++place)
    if (picture.changed[place] > 0)
      parts.push_back(fmt::format("{} {}", picture.changed[place], text_of(static_cast<PixelPlace>(place))));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string shifts_text(const PictureDifference& picture) {
  std::vector<std::string> parts;
  for (const BallShift& shift : picture.shifts)
    if (parts.size() < kToldShifts && shift.shift_px.norm() >= kTellable_px)
      parts.push_back(fmt::format("ball {} moved by ({:+.2f}, {:+.2f}) px", shift.ball, shift.shift_px.x(),
                                  shift.shift_px.y()));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// What changed in a picture; empty where nothing did.
std::string picture_text(const PictureDifference& picture) {
  const long changed = picture.all_changed();
  std::vector<std::string> parts;
  if (changed > 0)
    parts.push_back(fmt::format("{} of {} pixels differ by up to {} level{}: {}", changed, picture.pixels,
                                picture.most_levels, picture.most_levels == 1 ? "" : "s",
                                places_text(picture)));
  if (picture.identities > 0)
    parts.push_back(fmt::format("{} pixel{} something else", picture.identities,
                                picture.identities == 1 ? " shows" : "s show"));
  const std::string shifts = shifts_text(picture);
  if (!shifts.empty()) parts.push_back(shifts);
  if (parts.empty() && !picture.has_seen_the_same)
    parts.emplace_back(
        "the small picture is equal, and what the detector sees is not: by its noise, or in full size alone");
  return fmt::format("{}", fmt::join(parts, "; "));
}

nlohmann::ordered_json picture_json(const PictureDifference& picture) {
  using Json = nlohmann::ordered_json;
  Json changed = Json::object(), shifts = Json::array();
  for (std::size_t place = 0; place < kPixelPlaces; ++place) changed[kKeys[place]] = picture.changed[place];
  for (const BallShift& shift : picture.shifts)
    shifts.push_back({{"ball", shift.ball}, {"shift_px", {shift.shift_px.x(), shift.shift_px.y()}}});
  return {{"seen_equal", picture.has_seen_the_same},
          {"pixels", picture.pixels},
          {"changed", changed},
          {"beyond_limit", picture.beyond},
          {"most_levels", picture.most_levels},
          {"identities", picture.identities},
          {"shifts", shifts}};
}

}  // namespace

std::string difference_text(const GoldenDifference& difference) {
  std::string text;
  for (const auto& [side, picture] :
       {std::pair("left", &difference.left), std::pair("right", &difference.right)}) {
    const std::string line = picture_text(*picture);
    if (!line.empty())
      text +=
          fmt::format("{}, seed {} frame {}: {}\n", side, difference.name.seed, difference.name.step, line);
  }
  return text;
}

nlohmann::ordered_json difference_json(const GoldenDifference& difference) {
  return {{"seed", difference.name.seed},
          {"frame", difference.name.step},
          {"passes", difference.passes},
          {"left", picture_json(difference.left)},
          {"right", picture_json(difference.right)}};
}

}  // namespace stereobench::harness
