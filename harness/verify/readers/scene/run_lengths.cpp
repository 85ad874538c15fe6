#include "harness/verify/readers/scene/run_lengths.h"

#include <algorithm>
#include <numeric>

namespace stereobench::harness {
namespace {

/// Numbers of five bits a letter, the least first, from '0' on; a sixth bit says that more follow. From the
/// third number on they are differences from the one before the last.
std::vector<std::int64_t> runs_of_text(const JsonValue& text) {
  constexpr int kBits = 5, kMostShift = 60;
  constexpr std::int64_t kGoesOn = 0x20, kIsNegative = 0x10, kDigits = 0x1f;
  std::vector<std::int64_t> runs;
  std::int64_t number = 0;
  int shift = 0;
  for (const char letter : text.text()) {
    const std::int64_t code = letter - '0';
    if (code < 0 || code >= 2 * kGoesOn || shift >= kMostShift)
      text.refuse("runs as pycocotools writes them");
    number |= (code & kDigits) << shift;
    shift += kBits;
    if ((code & kGoesOn) != 0) continue;
    if ((code & kIsNegative) != 0) number -= std::int64_t{1} << shift;
    if (runs.size() > 2) number += runs[runs.size() - 2];
    runs.push_back(number);
    number = 0, shift = 0;
  }
  if (shift != 0 || std::ranges::any_of(runs, [](std::int64_t run) { return run < 0; }))
    text.refuse("runs as pycocotools writes them");
  return runs;
}

}  // namespace

std::int64_t RunLengths::pixels() const {
  return std::accumulate(runs.begin(), runs.end(), std::int64_t{0});
}

std::int64_t RunLengths::pixels_of_mask() const {
  std::int64_t count = 0;
  for (std::size_t i = 1; i < runs.size(); i += 2) count += runs[i];
  return count;
}

RunLengths run_lengths_of(const JsonValue& segmentation) {
  constexpr std::int64_t kMostSize = 1 << 15, kMostPixels = kMostSize * kMostSize;
  const auto size = segmentation.at("size").list(2, 2);
  RunLengths lengths;
  lengths.size = {static_cast<int>(size[1].integer(0, kMostSize)),
                  static_cast<int>(size[0].integer(0, kMostSize))};
  const JsonValue counts = segmentation.at("counts");
  if (counts.is_text()) {
    lengths.runs = runs_of_text(counts);
  } else {
    for (const JsonValue& run : counts.list(0, static_cast<std::size_t>(kMostPixels)))
      lengths.runs.push_back(run.integer(0, kMostPixels));
  }
  return lengths;
}

cv::Mat mask_of(const RunLengths& runs) {
  cv::Mat columns(runs.size.width, runs.size.height, CV_8UC1);  // a row of this is a column of the picture
  auto* pixel = columns.ptr<std::uint8_t>();
  std::uint8_t level = 0;
  for (const std::int64_t run : runs.runs) {
    pixel = std::fill_n(pixel, run, level);
    level = level == 0 ? 255 : 0;
  }
  return columns.t();
}

}  // namespace stereobench::harness
