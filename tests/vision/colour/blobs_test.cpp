#include "vision/colour/blobs.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/vision/painter.h"
#include "vision/colour/colour_table.h"
#include "vision/palette.h"

namespace stereobench::vision {
namespace {

cv::Vec3b shade_of(std::size_t colour, double shading) {
  const PaletteColour& c = kPalette[colour];
  const auto level = [&](std::uint8_t full) { return static_cast<std::uint8_t>(full * shading + 0.5); };
  return {level(c.b), level(c.g), level(c.r)};
}

TEST(ColourTable, KnowsEveryPaletteColourInAnyShade) {
  for (std::size_t colour = 0; colour < kPalette.size(); ++colour) {
    for (double shading = 0.45; shading <= 1.0; shading += 0.01) {
      const cv::Vec3b bgr = shade_of(colour, shading);
      ASSERT_EQ(palette_table().classify(bgr[0], bgr[1], bgr[2]), colour) << "shading " << shading;
    }
  }
}

TEST(ColourTable, TakesGreysAndPaleColoursForBackground) {
  for (int level = 0; level < 256; ++level) {
    const auto high = static_cast<std::uint8_t>(level);
    const auto low = static_cast<std::uint8_t>(level * 3 / 4);
    ASSERT_EQ(palette_table().classify(high, high, high), kBackground);
    ASSERT_EQ(palette_table().classify(low, high, high), kBackground);
    ASSERT_EQ(palette_table().classify(high, high, low), kBackground);
  }
}

// Mutations: a level more; cells compared by their middles.
TEST(ColourTable, SaysTheLeastSpreadOfItsColours) {
  int least = 256;
  for (int b = 0; b < 256; ++b) {
    for (int g = 0; g < 256; ++g) {
      for (int r = 0; r < 256; ++r) {
        const auto [low, high] = std::minmax({b, g, r});
        if (high - low >= least) continue;
        const auto level = [](int value) { return static_cast<std::uint8_t>(value); };
        if (palette_table().classify(level(b), level(g), level(r)) != kBackground) least = high - low;
      }
    }
  }
  EXPECT_EQ(palette_table().least_spread_levels(), least);
  EXPECT_EQ(ColourTable([](const Eigen::Vector3d&) { return kBackground; }).least_spread_levels(), 256);
  EXPECT_EQ(ColourTable([](const Eigen::Vector3d&) { return std::uint8_t{0}; }).least_spread_levels(), 0);
}

// A random picture of few colours, so that patches of all shapes come up; every other one is mostly grey.
cv::Mat random_picture(std::uint64_t seed, int rows, int columns) {
  painter::Dice dice(seed);
  const double coloured = seed % 2 == 0 ? 0.6 : 0.02;
  cv::Mat image(rows, columns, CV_8UC3, cv::Scalar(128, 128, 128));
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const double roll = dice.uniform();
      if (roll < coloured)
        image.at<cv::Vec3b>(y, x) = shade_of(roll < 0.6 * coloured ? 0 : 1, dice.uniform(0.5, 1.0));
    }
  }
  return image;
}

// Flood filling with a stack: the reference that needs no cleverness.
std::vector<Blob> flood_filled(const cv::Mat& image) {
  cv::Mat left(image.rows, image.cols, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const auto& p = image.at<cv::Vec3b>(y, x);
      left.at<std::uint8_t>(y, x) = palette_table().classify(p[0], p[1], p[2]);
    }
  }
  std::vector<Blob> blobs;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const std::uint8_t colour = left.at<std::uint8_t>(y, x);
      if (colour == kBackground) continue;
      Blob blob{colour, 0, 0.0, 0.0, x, x, y, y};
      std::vector<cv::Point> stack = {{x, y}};
      while (!stack.empty()) {
        const cv::Point p = stack.back();
        stack.pop_back();
        if (p.x < 0 || p.y < 0 || p.x >= image.cols || p.y >= image.rows) continue;
        if (left.at<std::uint8_t>(p) != colour) continue;
        left.at<std::uint8_t>(p) = kBackground;
        ++blob.area_px;
        blob.sum_x += p.x;
        blob.sum_y += p.y;
        blob.min_x = std::min(blob.min_x, p.x);
        blob.max_x = std::max(blob.max_x, p.x);
        blob.min_y = std::min(blob.min_y, p.y);
        blob.max_y = std::max(blob.max_y, p.y);
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) stack.emplace_back(p.x + dx, p.y + dy);
        }
      }
      blobs.push_back(blob);
    }
  }
  return blobs;
}

// Catches: corners that do not connect, runs at the last column that never end, moments half a pixel off.
// Mutations: the pixels after a grey stretch passed over; a run that does not end where grey begins.
TEST(Blobs, AreThoseOfFloodFilling) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const cv::Mat image = random_picture(seed, 37, 53);
    const std::vector<Blob> expected = flood_filled(image);
    const auto blobs = find_blobs(image, 1);
    ASSERT_EQ(blobs.size(), expected.size());
    for (std::size_t i = 0; i < blobs.size(); ++i) {
      ASSERT_EQ(blobs[i].colour, expected[i].colour);
      ASSERT_EQ(blobs[i].area_px, expected[i].area_px);
      ASSERT_EQ(blobs[i].sum_x, expected[i].sum_x);
      ASSERT_EQ(blobs[i].sum_y, expected[i].sum_y);
      ASSERT_EQ(blobs[i].min_x, expected[i].min_x);
      ASSERT_EQ(blobs[i].max_x, expected[i].max_x);
      ASSERT_EQ(blobs[i].min_y, expected[i].min_y);
      ASSERT_EQ(blobs[i].max_y, expected[i].max_y);
    }
  }
}

// Whichever channel it is that differs, and wherever among the pixels that are looked at together.
// Mutations: pixels told apart from their second byte on; the last five of those looked at together passed
// over.
TEST(Blobs, OneColouredPixelIsSeenWhereverItIs) {
  int seen = 0;
  for (int x = 0; x < 40; ++x) {
    for (int channel = 0; channel < 3; ++channel) {
      for (const int level : {0, 255}) {
        cv::Mat image(1, 40, CV_8UC3, cv::Scalar(128, 128, 128));
        auto& pixel = image.at<cv::Vec3b>(0, x);
        pixel[channel] = static_cast<std::uint8_t>(level);
        const bool is_coloured = palette_table().classify(pixel[0], pixel[1], pixel[2]) != kBackground;
        ASSERT_EQ(find_blobs(image, 1).size(), is_coloured ? 1U : 0U) << x;
        seen += is_coloured;
      }
    }
  }
  EXPECT_GE(seen, 40 * 3);
}

TEST(Blobs, AreTheSameInAnImageWithRowPadding) {
  const cv::Mat wide = random_picture(7, 30, 60);
  const cv::Mat part = wide(cv::Rect(5, 3, 41, 20));
  ASSERT_FALSE(part.isContinuous());
  const auto blobs = find_blobs(part, 3);
  const auto expected = find_blobs(part.clone(), 3);
  ASSERT_EQ(blobs.size(), expected.size());
  for (std::size_t i = 0; i < blobs.size(); ++i) ASSERT_EQ(blobs[i].sum_x, expected[i].sum_x);
}

TEST(Blobs, BelowTheSmallestAreaAreLeftOut) {
  const cv::Mat image = random_picture(8, 40, 40);
  for (const Blob& blob : find_blobs(image, 5)) EXPECT_GE(blob.area_px, 5);
  EXPECT_TRUE(find_blobs(image, 40L * 40L + 1).empty());
  EXPECT_TRUE(find_blobs(cv::Mat(20, 20, CV_8UC3, cv::Scalar(90, 90, 90)), 1).empty());
}

}  // namespace
}  // namespace stereobench::vision
