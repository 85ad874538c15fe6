#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include <opencv2/imgproc.hpp>
#include <zlib.h>

#include "renderer/pictures/fast_deflate.h"
#include "renderer/pictures/png_picture.h"

namespace stereobench::renderer {
namespace {

using PngBytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kUnfiltered = 0, kDifferenceToTheLeft = 1;

void append_number(PngBytes& bytes, std::uint32_t number) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

void append_chunk(PngBytes& bytes, std::string_view name, const PngBytes& content) {
  append_number(bytes, static_cast<std::uint32_t>(content.size()));
  const std::size_t begin = bytes.size();
  bytes.insert(bytes.end(), name.begin(), name.end());
  bytes.insert(bytes.end(), content.begin(), content.end());
  append_number(bytes, static_cast<std::uint32_t>(
                           ::crc32(0, bytes.data() + begin, static_cast<uInt>(bytes.size() - begin))));
}

/// A row as PNG has it: red first, and of 16 bits the higher byte first.
cv::Mat in_order_of_png(const cv::Mat& row) {
  cv::Mat ordered;
  if (row.channels() == 1)
    ordered = row;
  else
    cv::cvtColor(row, ordered, row.channels() == 3 ? cv::COLOR_BGR2RGB : cv::COLOR_BGRA2RGBA);
  if (row.depth() != CV_16U) return ordered;
  cv::Mat swapped = ordered.clone();
  static_assert(std::endian::native == std::endian::little);
  for (auto* word = swapped.data; word < swapped.data + swapped.total() * swapped.elemSize(); word += 2)
    std::swap(word[0], word[1]);
  return swapped;
}

/// The rows, each behind the number of its filter.
PngBytes filtered_rows(const cv::Mat& picture, std::uint8_t filter) {
  const std::size_t width = static_cast<std::size_t>(picture.cols) * picture.elemSize();
  PngBytes rows((width + 1) * static_cast<std::size_t>(picture.rows));
  std::uint8_t* to = rows.data();
  for (int v = 0; v < picture.rows; ++v) {
    const cv::Mat ordered = in_order_of_png(picture.row(v));
    const std::uint8_t* const from = ordered.data;
    const std::size_t pixel = filter == kDifferenceToTheLeft ? picture.elemSize() : width;
    *to++ = filter;
    std::memcpy(to, from, pixel);
    for (std::size_t i = pixel; i < width; ++i) to[i] = static_cast<std::uint8_t>(from[i] - from[i - pixel]);
    to += width;
  }
  return rows;
}

PngBytes stored(const PngBytes& bytes) {
  uLongf size = ::compressBound(static_cast<uLong>(bytes.size()));
  PngBytes packed(size);
  if (::compress2(packed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), Z_NO_COMPRESSION) !=
      Z_OK)
    throw std::runtime_error("cannot be written as PNG");
  packed.resize(size);
  return packed;
}

PngBytes header_of(const cv::Mat& picture) {
  constexpr std::array<std::uint8_t, 5> kColourOfChannels = {0, 0, 0, 2,
                                                             6};  // grey, colour, colour with alpha
  PngBytes header;
  append_number(header, static_cast<std::uint32_t>(picture.cols));
  append_number(header, static_cast<std::uint32_t>(picture.rows));
  header.push_back(picture.depth() == CV_8U ? 8 : 16);
  header.push_back(kColourOfChannels.at(static_cast<std::size_t>(picture.channels())));
  header.insert(header.end(), 3, 0);  // deflate, filters by rows, not interlaced
  return header;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const cv::Mat& picture, PngPacking packing) {
  const int channels = picture.channels();
  const bool suitable = !picture.empty() && (picture.depth() == CV_8U || picture.depth() == CV_16U) &&
                        (channels == 1 || channels == 3 || channels == 4);
  if (!suitable)
    throw std::invalid_argument("encode_png: not a picture of 8 or 16 bits and 1, 3 or 4 channels");
  const bool packs = packing == PngPacking::kRuns;
  const PngBytes rows = filtered_rows(picture, packs ? kDifferenceToTheLeft : kUnfiltered);
  PngBytes packed = packs ? deflate_fast(rows) : PngBytes();
  if (!packs || packed.size() > rows.size()) packed = stored(rows);  // noise alone
  constexpr std::size_t kAroundIt = 100;
  PngBytes bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  bytes.reserve(packed.size() + kAroundIt);
  append_chunk(bytes, "IHDR", header_of(picture));
  append_chunk(bytes, "IDAT", packed);
  append_chunk(bytes, "IEND", {});
  return bytes;
}

}  // namespace stereobench::renderer
