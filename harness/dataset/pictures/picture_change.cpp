#include "harness/dataset/pictures/picture_change.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "worlds/yaml/excerpt.h"

namespace stereobench::harness {
namespace {

constexpr int kMostPixels = 1 << 15;
constexpr int kMostPairs = 1'000'000;

/// Whole numbers between commas. @return empty where it is not exactly that, or one is above `most`
template <std::size_t Count>
std::optional<std::array<int, Count>> whole_numbers(std::string_view text, int most) {
  std::array<int, Count> numbers{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i < Count; ++i) {
    if (i > 0 && (at == end || *at++ != ',')) return {};
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc() || numbers[i] < 0 || numbers[i] > most) return {};
    at = next;
  }
  return at == end ? std::optional(numbers) : std::nullopt;
}

[[noreturn]] void refuse_word(const char* expected, std::string_view text) {
  throw std::runtime_error(fmt::format("{} (got '{}')", expected, worlds::excerpt(text)));
}

void check_crop(const vision::Intrinsics& camera, const cv::Rect& crop) {
  const cv::Rect whole(0, 0, camera.width_px, camera.height_px);
  if ((crop & whole) != crop)
    throw std::runtime_error(
        fmt::format("--crop: {},{},{},{} reaches out of the pictures, which are {} x {} px", crop.x, crop.y,
                    crop.width, crop.height, whole.width, whole.height));
}

void check_scale(const vision::Intrinsics& camera, const std::optional<cv::Rect>& crop, int divide) {
  const cv::Size size = crop ? crop->size() : cv::Size(camera.width_px, camera.height_px);
  const cv::Size fits(size.width - size.width % divide, size.height - size.height % divide);
  if (size == fits) return;
  if (fits.empty())
    throw std::runtime_error(
        fmt::format("--scale: 1/{} of {} x {} px is less than a pixel", divide, size.width, size.height));
  const cv::Point first = crop ? crop->tl() : cv::Point(0, 0);
  throw std::runtime_error(
      fmt::format("--scale: {} x {} px are no multiple of {}; cut them with --crop {},{},{},{}", size.width,
                  size.height, divide, first.x, first.y, fits.width, fits.height));
}

void check_truth(const DatasetDrive& drive, const PictureChange& change) {
  if ((change.crop || change.divide > 1) && drive.shutter.readout_s != 0.0)
    throw std::runtime_error(fmt::format(
        "{}: rows of a rolling shutter (shutter.readout_s) look one after another, and poses hold "
        "for the middle row of the whole picture; leave it out",
        change.crop ? "--crop" : "--scale"));
  if (change.divide > 1 && drive.shutter.right_delay_s != 0.0 &&
      std::ranges::count(drive.truth.kinds, TruthKind::kFlow) > 0)
    throw std::runtime_error(
        "--scale: the flow of a right camera that looks late (shutter.right_delay_s) is not known between "
        "pixels; leave --scale or --truth flow out");
}

}  // namespace

std::size_t parse_every(std::string_view text) {
  const auto number = whole_numbers<1>(text, kMostPairs);
  if (!number || number->front() < 1)
    refuse_word("--every: expected a whole number from 1 on, as 10 for each tenth pair", text);
  return static_cast<std::size_t>(number->front());
}

cv::Rect parse_crop(std::string_view text) {
  const auto numbers = whole_numbers<4>(text, kMostPixels);
  if (!numbers || (*numbers)[2] < 1 || (*numbers)[3] < 1)
    refuse_word("--crop: expected X,Y,W,H in pixels, as 128,96,640,480", text);
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

int parse_scale(std::string_view text) {
  const auto number = text.starts_with("1/") ? whole_numbers<1>(text.substr(2), kMostPixels) : std::nullopt;
  if (!number || number->front() < 1) refuse_word("--scale: expected 1/N, as 1/2", text);
  return number->front();
}

nlohmann::ordered_json change_json(const PictureChange& change) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (change.every > 1) json["every"] = change.every;
  if (change.crop) json["crop"] = {change.crop->x, change.crop->y, change.crop->width, change.crop->height};
  if (change.divide > 1) json["scale"] = fmt::format("1/{}", change.divide);
  if (change.kind != PictureKind::kColour) json["kind"] = name_of(change.kind);
  return json;
}

std::vector<std::pair<std::string, std::string>> change_options(const nlohmann::ordered_json& json) {
  std::vector<std::pair<std::string, std::string>> options;
  for (const auto& [key, value] : json.items()) {
    if (value.is_array())
      options.emplace_back(key, fmt::format("{}", fmt::join(value.get<std::vector<int>>(), ",")));
    else
      options.emplace_back(key == "kind" ? "picture" : key,
                           value.is_string() ? value.get<std::string>() : value.dump());
  }
  return options;
}

vision::StereoRig changed(vision::StereoRig rig, const PictureChange& change) {
  vision::Intrinsics& camera = rig.intrinsics;
  if (change.crop) {
    camera.width_px = change.crop->width;
    camera.height_px = change.crop->height;
    camera.cx_px -= change.crop->x;
    camera.cy_px -= change.crop->y;
  }
  if (change.divide == 1) return rig;
  camera.width_px /= change.divide;
  camera.height_px /= change.divide;
  camera.focal_px /= change.divide;
  camera.cx_px = (camera.cx_px + 0.5) / change.divide - 0.5;
  camera.cy_px = (camera.cy_px + 0.5) / change.divide - 0.5;
  return rig;
}

DatasetDrive changed(DatasetDrive drive, const PictureChange& change) {
  if (change.crop) check_crop(drive.rig.intrinsics, *change.crop);
  check_scale(drive.rig.intrinsics, change.crop, change.divide);
  check_truth(drive, change);
  drive.rig = changed(drive.rig, change);
  drive.believed_rig = changed(drive.believed_rig, change);
  if (change.kind != PictureKind::kColour) drive.picture_kind = change.kind;
  if (change.kind == PictureKind::kLinear16) drive.encoding = worlds::Encoding::kLinear;
  const std::vector<std::size_t> taken = steps_with_pictures(drive);
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (i % change.every != 0) drive.steps[taken[i]].pictures.reset();
  return drive;
}

}  // namespace stereobench::harness
