#include "harness/dataset/formats/container/pair_parts.h"

#include <array>
#include <string>

#include <fmt/format.h>

#include "harness/dataset/truth/bop_numbers.h"
#include "harness/io/text_file.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;
using vision::Side;

std::string part_of(const char* kind, std::size_t step, const char* extension) {
  return fmt::format("{}/{}/{:06}{}", kPartsFolder, kind, step, extension);
}

std::string picture_name(std::size_t step, Side side) {
  return part_of(side == Side::kLeft ? "left" : "right", step, ".png");
}

std::string balls_name(std::size_t step) {
  return part_of("balls", step, ".json");
}

Json pixels_json(const renderer::PixelSet& pixels) {
  if (pixels.count == 0) return nullptr;
  return {{"px_count_visib", pixels.count}, {"bbox_visib", bop_box(pixels.box)}};
}

Json visible_balls(DatasetPair& pair) {
  const auto left = renderer::pixels_by_id(pair.ball_id(Side::kLeft)),
             right = renderer::pixels_by_id(pair.ball_id(Side::kRight));
  Json balls = Json::array();
  for (std::size_t id = 1; id < left.size(); ++id)
    if (left[id].count + right[id].count > 0)
      balls.push_back(
          {{"ball_id", id - 1}, {"left", pixels_json(left[id])}, {"right", pixels_json(right[id])}});
  return balls;
}

}  // namespace

std::vector<DatasetFile> pair_parts(DatasetPair& pair) {
  std::vector<DatasetFile> parts;
  for (const Side side : kBothSides)
    parts.push_back(camera_file(picture_name(pair.step(), side), pair, side));
  parts.push_back({balls_name(pair.step()), [&pair] { return visible_balls(pair).dump(); }});
  return parts;
}

std::filesystem::path picture_part(const std::filesystem::path& folder, std::size_t step, Side side) {
  return folder / picture_name(step, side);
}

Json visible_balls_part(const std::filesystem::path& folder, std::size_t step) {
  return Json::parse(read_text(folder / balls_name(step)));
}

}  // namespace stereobench::harness
