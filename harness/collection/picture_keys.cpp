#include "harness/collection/picture_keys.h"

#include <array>
#include <stdexcept>

namespace stereobench::harness {
namespace {

using worlds::YamlValue;

constexpr int kLargest = 1'000'000;

void read_crop(const YamlValue& value, PictureChange& change) {
  constexpr int kMostPixels = 1 << 15;
  std::array<int, 4> numbers{};
  const auto entries = value.list(numbers.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = entries[i].integer(i < 2 ? 0 : 1, kMostPixels);
  change.crop = cv::Rect(numbers[0], numbers[1], numbers[2], numbers[3]);
}

void read_scale(const YamlValue& value, PictureChange& change) {
  try {
    change.divide = parse_scale(value.text());
  } catch (const std::runtime_error&) {
    value.fail("expected 1/N, as 1/2");
  }
}

}  // namespace

const worlds::Fields<PictureChange>& picture_keys() {
  static const worlds::Fields<PictureChange> keys({
      worlds::whole("every", 1, kLargest, "Each so manieth pair.")
          .by<PictureChange>([](const YamlValue& value, PictureChange& change) {
            change.every = static_cast<std::size_t>(value.integer(1, kLargest));
          }),
      worlds::whole("crop", 0, kLargest, "The part that is kept: x, y, width and height, px.")
          .list(4, 4)
          .by<PictureChange>(read_crop),
      worlds::text("scale", "1/N: a pixel is the mean of N x N pixels.", "^1/[1-9][0-9]*$")
          .by<PictureChange>(read_scale),
      worlds::choice("kind", {"colour", "grey", "bayer-rggb", "linear16"}, "What pictures hold.")
          .fills(&PictureChange::kind),
  });
  return keys;
}

}  // namespace stereobench::harness
