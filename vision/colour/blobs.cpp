#include "vision/colour/blobs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <opencv2/core/hal/intrin.hpp>

namespace stereobench::vision {
namespace {

// Pixels [begin, end) of one row that have one palette colour, and the blob they belong to.
struct ColourRun {
  int begin = 0;
  int end = 0;
  int colour = 0;
  std::size_t blob = 0;
};

// Disjoint sets of blobs that turn out to be one; each root carries the sums of its set.
class BlobForest {
 public:
  std::size_t add(const ColourRun& run, int row) {
    const long length = run.end - run.begin;
    const double sum_x = 0.5 * static_cast<double>(run.begin + run.end - 1) * static_cast<double>(length);
    parents_.push_back(blobs_.size());
    blobs_.push_back(Blob{run.colour, length, sum_x, static_cast<double>(row) * static_cast<double>(length),
                          run.begin, run.end - 1, row, row});
    return blobs_.size() - 1;
  }

  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    if (a > b) std::swap(a, b);  // the older one stays, so that the order is that of first pixels
    parents_[b] = a;
    Blob& into = blobs_[a];
    const Blob& from = blobs_[b];
    into.area_px += from.area_px;
    into.sum_x += from.sum_x;
    into.sum_y += from.sum_y;
    into.min_x = std::min(into.min_x, from.min_x);
    into.max_x = std::max(into.max_x, from.max_x);
    into.min_y = std::min(into.min_y, from.min_y);
    into.max_y = std::max(into.max_y, from.max_y);
  }

  ScratchVector<Blob> roots(long min_area_px) const {
    ScratchVector<Blob> result;
    for (std::size_t i = 0; i < blobs_.size(); ++i) {
      if (parents_[i] == i && blobs_[i].area_px >= min_area_px) result.push_back(blobs_[i]);
    }
    return result;
  }

 private:
  std::size_t root(std::size_t i) {
    while (parents_[i] != i) {
      parents_[i] = parents_[parents_[i]];
      i = parents_[i];
    }
    return i;
  }

  ScratchVector<std::size_t> parents_;
  ScratchVector<Blob> blobs_;
};

using Bytes = cv::v_uint8x16;

constexpr int kAtOnce = Bytes::nlanes;  // pixels

// The bytes that a pixel starts with.
constexpr std::array<std::uint8_t, kAtOnce> kStarts = [] {
  std::array<std::uint8_t, kAtOnce> starts{};
  for (std::size_t i = 0; i < starts.size(); i += 3) starts[i] = 255;
  return starts;
}();

// Whether the next kAtOnce pixels are all greyer than any colour of a table, as most of most images are.
bool is_grey(const std::uint8_t* bgr, const Bytes& least_spread) {
  Bytes spread = cv::v_setzero_u8();
  constexpr int kStartsAtOnce =
      6;  // in as many bytes as pixels; the last is looked at again as the next's first
  for (int pixel = 0; pixel + kStartsAtOnce <= kAtOnce; pixel += kStartsAtOnce - 1) {
    const Bytes b = cv::v_load(bgr + 3 * pixel);
    const Bytes g = cv::v_load(bgr + 3 * pixel + 1);
    const Bytes r = cv::v_load(bgr + 3 * pixel + 2);
    spread = cv::v_max(spread, cv::v_max(cv::v_max(b, g), r) - cv::v_min(cv::v_min(b, g), r));
  }
  return cv::v_check_all((spread & cv::v_load(kStarts.data())) < least_spread);
}

void find_runs(const std::uint8_t* bgr, int width, const ColourTable& table, ScratchVector<ColourRun>& runs) {
  runs.clear();
  const auto least_spread =
      cv::v_setall_u8(static_cast<std::uint8_t>(std::min(255, table.least_spread_levels())));
  std::uint8_t current = kBackground;
  for (int x = 0; x < width;) {
    if (current == kBackground) {
      while (x + kAtOnce <= width && is_grey(bgr + 3 * x, least_spread)) x += kAtOnce;
    }
    for (const int end = std::min(width, x + kAtOnce); x < end; ++x) {
      const std::uint8_t* pixel = bgr + 3 * x;
      const std::uint8_t colour = table.classify(pixel[0], pixel[1], pixel[2]);
      if (colour == current) continue;
      if (current != kBackground) runs.back().end = x;
      if (colour != kBackground) runs.push_back({x, width, colour, 0});
      current = colour;
    }
  }
}

// Both lists are sorted by column, so one sweep over both meets every touching pair.
void join_touching(const ScratchVector<ColourRun>& above, const ScratchVector<ColourRun>& below,
                   BlobForest& forest) {
  std::size_t first = 0;
  for (const ColourRun& run : below) {
    while (first < above.size() && above[first].end < run.begin) ++first;
    for (std::size_t i = first; i < above.size() && above[i].begin <= run.end; ++i) {
      if (above[i].colour == run.colour) forest.join(above[i].blob, run.blob);
    }
  }
}

}  // namespace

ScratchVector<Blob> find_blobs(const cv::Mat& image, long min_area_px, const ColourTable& table) {
  BlobForest forest;
  ScratchVector<ColourRun> above;
  ScratchVector<ColourRun> runs;
  for (int y = 0; y < image.rows; ++y) {
    find_runs(image.ptr<std::uint8_t>(y), image.cols, table, runs);
    for (ColourRun& run : runs) run.blob = forest.add(run, y);
    join_touching(above, runs, forest);
    std::swap(above, runs);
  }
  return forest.roots(min_area_px);
}

}  // namespace stereobench::vision
