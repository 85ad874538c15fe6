/// Light gathered from between pixels. Three weights each way are known by three moments: of light that is
/// constant, linear and quadratic.

#include "renderer/camera/remap.h"

#include <vector>

#include <gtest/gtest.h>

namespace stereobench::renderer {
namespace {

constexpr int kFirstRow = 7;  // of those that are there
constexpr int kWidth = 3001;
constexpr int kColumns = 113, kRows = 97;

/// Places anywhere around which there are pixels.
std::vector<PinholePlace> places(std::uint64_t seed) {
  std::vector<PinholePlace> at;
  cv::RNG random(seed);
  for (int u = 0; u < kWidth; ++u)
    at.push_back(
        place_at({random.uniform(1.0, kColumns - 4.0), kFirstRow + random.uniform(1.0, kRows - 3.0)},
                 {random.uniform(kLeastSpread, kMostSpread), random.uniform(kLeastSpread, kMostSpread)}));
  return at;
}

double spread_of(std::uint8_t number) {
  return kLeastSpread + (kMostSpread - kLeastSpread) * number / (kSpreads - 1);
}

double column_of(const PinholePlace& place) {
  return place.column + static_cast<double>(place.right_of) / kPhases;
}

double row_of(const PinholePlace& place) {
  return place.row + static_cast<double>(place.below) / kPhases;
}

/// A picture of what a function makes of a column and a row.
template <class Level, class Function>
cv::Mat picture_of(int type, Function light) {
  cv::Mat picture(kRows, kColumns, type);
  for (int v = 0; v < kRows; ++v)
    for (int u = 0; u < kColumns; ++u)
      for (int c = 0; c < 3; ++c)
        picture.ptr<Level>(v)[3 * u + c] = cv::saturate_cast<Level>(light(u, v + kFirstRow, c));
  return picture;
}

template <class Level>
std::vector<Level> gathered(const std::vector<PinholePlace>& at, const cv::Mat& picture) {
  std::vector<Level> light(3 * at.size());
  gather_light(at.data(), {picture, kFirstRow}, light.data(), static_cast<int>(at.size()));
  return light;
}

class Gather : public testing::TestWithParam<std::uint64_t> {};

// Mutations: floor instead of the nearest pixel; places rounded to 1/64 of a pixel.
TEST_P(Gather, PlacesAreKeptToOnePhase) {
  cv::RNG random(GetParam());
  for (int i = 0; i < 1000; ++i) {
    const double column = random.uniform(-20.0, 9000.0), row = random.uniform(-20.0, 9000.0);
    const double across = random.uniform(0.0, 1.0), down = random.uniform(0.0, 1.0);
    const PinholePlace place = place_at({column, row}, {across, down});
    EXPECT_NEAR(spread_of(place.across), std::clamp(across, kLeastSpread, kMostSpread), 0.501 / 64.0);
    EXPECT_NEAR(spread_of(place.down), std::clamp(down, kLeastSpread, kMostSpread), 0.501 / 64.0);
    EXPECT_NEAR(column_of(place), column, 0.5 / kPhases + 1e-9);
    EXPECT_NEAR(row_of(place), row, 0.5 / kPhases + 1e-9);
    EXPECT_LE(std::abs(place.column - column), 0.5 + 0.5 / kPhases);
    EXPECT_LE(std::abs(place.row - row), 0.5 + 0.5 / kPhases);
  }
}

// Mutations: no rounding; the ways to the next column and row taken for each other; weights of one way
// turned round; blue for green.
TEST_P(Gather, LightThatIsLinearIsKept) {
  const auto light = [](double column, double row, int c) {
    return 20000.0 + 300.0 * column - 150.0 * row + 5.0 * c;
  };
  const std::vector<PinholePlace> at = places(GetParam());
  const auto seen = gathered<std::uint16_t>(at, picture_of<std::uint16_t>(CV_16UC3, light));
  for (std::size_t u = 0; u < at.size(); ++u)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(seen[3 * u + static_cast<std::size_t>(c)], light(column_of(at[u]), row_of(at[u]), c),
                  0.5001)
          << u;
}

// What is quadratic grows by the spread. Mutations: the least spread at all places; both ways' spreads taken
// for each other.
TEST_P(Gather, BlursByTheSpread) {
  const auto across = [](double column, double, int) { return 4.0 * (column - 50.0) * (column - 50.0); };
  const auto down = [](double, double row, int) { return 4.0 * (row - 50.0) * (row - 50.0); };
  const auto both = [](double column, double row, int) { return 5.0 * column * row; };
  const std::vector<PinholePlace> at = places(GetParam());
  const auto seen_across = gathered<std::uint16_t>(at, picture_of<std::uint16_t>(CV_16UC3, across));
  const auto seen_down = gathered<std::uint16_t>(at, picture_of<std::uint16_t>(CV_16UC3, down));
  const auto seen_both = gathered<std::uint16_t>(at, picture_of<std::uint16_t>(CV_16UC3, both));
  for (std::size_t u = 0; u < at.size(); ++u) {
    const double column = column_of(at[u]), row = row_of(at[u]);
    ASSERT_NEAR(seen_across[3 * u], across(column, row, 0) + 4.0 * spread_of(at[u].across),
                4.0 / kPhases + 0.5)
        << u;
    ASSERT_NEAR(seen_down[3 * u + 1], down(column, row, 1) + 4.0 * spread_of(at[u].down), 4.0 / kPhases + 0.5)
        << u;
    ASSERT_NEAR(seen_both[3 * u + 2], both(column, row, 2), 0.5001) << u;
  }
}

// Noise, blacks and whites: what rounds and what saturates. Mutation: sums of 16 bits that wrap.
TEST_P(Gather, OfEightBitsIsThatOfSixteenRounded) {
  cv::Mat levels(kRows, kColumns, CV_8UC3), fine;
  cv::RNG random(GetParam());
  random.fill(levels, cv::RNG::UNIFORM, -80, 335);
  levels.convertTo(fine, CV_16U, 256.0);
  const std::vector<PinholePlace> at = places(GetParam() + 100);
  const auto seen = gathered<std::uint8_t>(at, levels);
  const auto expected = gathered<std::uint16_t>(at, fine);
  for (std::size_t i = 0; i < seen.size(); ++i)
    ASSERT_NEAR(seen[i], expected[i] / 256.0, 0.5 + 0.5 / 256.0) << i;
}

TEST_P(Gather, BlackAndWhiteStay) {
  const std::vector<PinholePlace> at = places(GetParam());
  for (const int level : {0, 255})
    for (const std::uint8_t seen :
         gathered<std::uint8_t>(at, cv::Mat(kRows, kColumns, CV_8UC3, cv::Scalar::all(level))))
      ASSERT_EQ(seen, level);
  for (const int level : {0, 65535})
    for (const std::uint16_t seen :
         gathered<std::uint16_t>(at, cv::Mat(kRows, kColumns, CV_16UC3, cv::Scalar::all(level))))
      ASSERT_EQ(seen, level);
}

TEST_P(Gather, PicksTheNearestPixels) {
  cv::Mat undistorted(kRows, kColumns, CV_32FC1);
  cv::RNG random(GetParam());
  random.fill(undistorted, cv::RNG::UNIFORM, -80, 335);
  const std::vector<PinholePlace> at = places(GetParam());
  std::vector<float> picked(at.size());
  pick(at.data(), {undistorted, kFirstRow}, picked.data(), kWidth);
  for (std::size_t u = 0; u < at.size(); ++u)
    ASSERT_EQ(picked[u], undistorted.at<float>(at[u].row - kFirstRow, at[u].column)) << u;
}

INSTANTIATE_TEST_SUITE_P(Seeds, Gather, testing::Range(std::uint64_t{0}, std::uint64_t{5}));

}  // namespace
}  // namespace stereobench::renderer
