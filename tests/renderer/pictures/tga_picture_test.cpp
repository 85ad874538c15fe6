/// TGA files of every kind, written here.
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/pictures/picture_reader.h"
#include "slam/math/random.h"
#include "tests/renderer/picture_complaint.h"

namespace stereobench::renderer {
namespace {

using test::complaint;

using Bytes = std::vector<std::uint8_t>;

enum class Kind { kPalette = 1, kColour = 2, kGrey = 3 };

struct Made {
  Kind kind = Kind::kColour;
  int bits = 24;
  bool packed = false;
  bool from_top = false;
  bool from_right = false;
  int unused_palette = 0;  ///< entries of one that a true colour has for nothing
  int first_entry = 0;
  int id_bytes = 0;
};

constexpr int kWidth = 13, kHeight = 9;

/// Colours that 15 bits hold exactly, with runs, in few enough colours for a palette.
cv::Mat colours() {
  cv::Mat bgr(kHeight, kWidth, CV_8UC3);
  slam::RandomStream random(5, slam::Stream::kWorld);
  cv::Vec3b colour;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    if (random.uniform() < 0.4) {
      for (int c = 0; c < 3; ++c) {
        const auto five = static_cast<int>(random.uniform() * 3) * 15;
        colour[c] = static_cast<std::uint8_t>((five * 255 + 15) / 31);
      }
    }
    bgr.at<cv::Vec3b>(i / kWidth, i % kWidth) = colour;
  }
  return bgr;
}

/// The bytes of one colour.
Bytes packed_colour(const cv::Vec3b& bgr, int bits) {
  if (bits == 24) return {bgr[0], bgr[1], bgr[2]};
  if (bits == 32) return {bgr[0], bgr[1], bgr[2], 77};
  unsigned word = 0;
  for (int c = 0; c < 3; ++c) word |= static_cast<unsigned>((bgr[c] * 31 + 127) / 255) << (5 * c);
  return {static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8U)};
}

/// Which of 27 colours it is.
int index_of(const cv::Vec3b& bgr) {
  const auto third = [](std::uint8_t level) { return level == 0 ? 0 : level < 200 ? 1 : 2; };
  return third(bgr[0]) + 3 * third(bgr[1]) + 9 * third(bgr[2]);
}

cv::Vec3b colour_of_index(int index) {
  const auto level = [](int third) { return static_cast<std::uint8_t>((third * 15 * 255 + 15) / 31); };
  return {level(index % 3), level(index / 3 % 3), level(index / 9)};
}

/// One value a pixel, in the file's order, as packets of runs and of others, or as they are.
Bytes pixels_of(const std::vector<Bytes>& values, bool packed) {
  Bytes bytes;
  const auto append = [&](const Bytes& value) { bytes.insert(bytes.end(), value.begin(), value.end()); };
  for (std::size_t i = 0; i < values.size();) {
    std::size_t run = 1;
    while (i + run < values.size() && run < 128 && values[i + run] == values[i]) ++run;
    if (packed) bytes.push_back(static_cast<std::uint8_t>(run > 1 ? 127 + run : 0));
    append(values[i]);
    i += packed ? run : 1;
  }
  return bytes;
}

Bytes tga(const cv::Mat& bgr, const Made& made) {
  const int entries = made.kind == Kind::kPalette ? 27 : made.unused_palette;
  Bytes file(18, 0);
  file[0] = static_cast<std::uint8_t>(made.id_bytes);
  file[1] = entries > 0 ? 1 : 0;
  file[2] = static_cast<std::uint8_t>(static_cast<int>(made.kind) + (made.packed ? 8 : 0));
  file[3] = static_cast<std::uint8_t>(made.first_entry);
  file[5] = static_cast<std::uint8_t>(entries);
  file[7] = entries > 0 ? 24 : 0;
  file[12] = kWidth;
  file[14] = kHeight;
  file[16] = static_cast<std::uint8_t>(made.bits);
  file[17] = static_cast<std::uint8_t>((made.from_right ? 16 : 0) + (made.from_top ? 32 : 0));
  file.insert(file.end(), static_cast<std::size_t>(made.id_bytes), 'x');
  for (int i = 0; i < entries; ++i)
    for (int c = 0; c < 3; ++c) file.push_back(colour_of_index(i)[c]);
  std::vector<Bytes> values;
  for (int i = 0; i < kHeight; ++i)
    for (int j = 0; j < kWidth; ++j) {
      const cv::Vec3b& pixel =
          bgr.at<cv::Vec3b>(made.from_top ? i : kHeight - 1 - i, made.from_right ? kWidth - 1 - j : j);
      if (made.kind == Kind::kPalette)
        values.push_back({static_cast<std::uint8_t>(index_of(pixel) + made.first_entry)});
      else if (made.kind == Kind::kGrey)
        values.push_back({pixel[1]});
      else
        values.push_back(packed_colour(pixel, made.bits));
    }
  const Bytes pixels = pixels_of(values, made.packed);
  file.insert(file.end(), pixels.begin(), pixels.end());
  return file;
}

std::vector<Made> every_kind() {
  std::vector<Made> kinds;
  for (const bool packed : {false, true}) {
    for (const int bits : {15, 16, 24, 32}) kinds.push_back({.bits = bits, .packed = packed});
    kinds.push_back({.packed = packed, .from_top = true});
    kinds.push_back({.packed = packed, .from_right = true});
    kinds.push_back({.packed = packed, .from_top = true, .from_right = true, .id_bytes = 40});
    kinds.push_back({.packed = packed, .unused_palette = 11});
    kinds.push_back({.kind = Kind::kPalette, .bits = 8, .packed = packed});
    kinds.push_back(
        {.kind = Kind::kPalette, .bits = 8, .packed = packed, .from_top = true, .first_entry = 7});
    kinds.push_back({.kind = Kind::kGrey, .bits = 8, .packed = packed});
  }
  return kinds;
}

// Mutations tried: the unused palette taken for pixels; packets that end with their row; rows from the top.
TEST(Tga, OfEveryKindIsRead) {
  const cv::Mat bgr = colours();
  cv::Mat green;
  cv::extractChannel(bgr, green, 1);
  int count = 0;
  for (const Made& kind : every_kind()) {
    const cv::Mat read = decode_picture(tga(bgr, kind));
    const cv::Mat& expected = kind.kind == Kind::kGrey ? green : bgr;
    ASSERT_EQ(read.type(), expected.type()) << count;
    ASSERT_EQ(read.size(), expected.size()) << count;
    EXPECT_EQ(cv::norm(read, expected, cv::NORM_INF), 0.0) << count;
    ++count;
  }
}

TEST(Tga, CutShortIsRefused) {
  for (const Made& kind : every_kind()) {
    const Bytes whole = tga(colours(), kind);
    for (std::size_t size = 18; size < whole.size(); ++size) {
      const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_EQ(complaint(part), "is no whole picture: it is cut short");
    }
  }
}

TEST(Tga, IsNotTakenAtItsWord) {
  const Bytes good = tga(colours(), {});
  EXPECT_EQ(complaint(good, 12), "is 13 x 9, more than 12 pixels");
  Bytes huge = tga(colours(), {.packed = true});
  huge[13] = huge[15] = 0x3F;  // 16,141 x 16,137 pixels, of which nothing is there
  EXPECT_EQ(complaint(huge), "is no whole picture: it is cut short");
  Bytes few = tga(colours(), {.kind = Kind::kPalette, .bits = 8});
  few[5] = 3;
  EXPECT_EQ(complaint(few), "is no whole picture: a pixel is of no colour of its palette");
  for (const auto& [at, value] : {std::pair{1, 2}, {2, 4}, {2, 0}, {16, 23}, {12, 0}, {17, 64}}) {
    Bytes odd = good;
    odd[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(value);
    EXPECT_THAT(complaint(odd), testing::StartsWith("is no picture that can be read")) << at;
  }
}

}  // namespace
}  // namespace stereobench::renderer
