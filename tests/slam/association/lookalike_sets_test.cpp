// Sightings that are all off by one shift, laid over rows of landmarks.
#include "slam/association/lookalike_sets.h"

#include <gtest/gtest.h>

namespace stereobench::slam {
namespace {

constexpr double kNoise_m2 = 1e-4;  // of each sighting
constexpr double kSetProbability = 0.9999;
constexpr double kUnlikely = 14.0;

// What is seen at some places, held against a map, by a pose that may be off by some metres in x.
class Overlay {
 public:
  // @param seen where sightings point at, in x; all of them at y = 0
  Overlay(const std::vector<double>& seen, const std::vector<double>& map, double shift_sd_m) {
    shift_ << shift_sd_m * shift_sd_m, 0.0, 0.0, kNoise_m2;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      for (std::size_t j = 0; j < map.size(); ++j) {
        const Pairing pair{{seen[i] - map[j], 0.0}, shift_ + kNoise_m2 * Eigen::Matrix2d::Identity()};
        if (std::abs(pair.residual.x()) > 6.0 * shift_sd_m) continue;
        candidates_.push_back({static_cast<int>(i), static_cast<int>(j), 0.0, false, true});
        pairings_.push_back(pair);
      }
    }
  }

  // @param landmarks of the sightings, in their order
  bool fits_elsewhere(const std::vector<int>& landmarks) const {
    std::vector<std::size_t> set;
    for (std::size_t pair = 0; pair < candidates_.size(); ++pair) {
      const Candidate& one = candidates_[pair];
      if (landmarks[static_cast<std::size_t>(one.sighting)] == one.landmark) set.push_back(pair);
    }
    EXPECT_EQ(set.size(), landmarks.size());
    const Tie tie = [this](std::size_t, std::size_t) { return shift_; };
    return slam::fits_elsewhere(candidates_, pairings_, tie, set, kSetProbability, kUnlikely);
  }

 private:
  Eigen::Matrix2d shift_;
  std::vector<Candidate> candidates_;
  std::vector<Pairing> pairings_;
};

const std::vector<double> kEvenRow{0.0, 2.0, 4.0, 6.0, 8.0, 10.0};
const std::vector<double> kUnevenRow{0.0, 1.3, 3.9, 6.0, 9.1, 10.0};

// Four sightings lie near 2, 4, 6 and 8; from 0 and from 4 on they fit too. Mutations seen to turn this red:
// sightings that the other set does not explain count against it; it must explain all.
TEST(LookalikeSets, AreSeenInEvenRows) {
  EXPECT_TRUE(Overlay({2.5, 4.5, 6.5, 8.5}, kEvenRow, 1.0).fits_elsewhere({1, 2, 3, 4}));
  // One step back the last three have landmarks, and the first has none: the row has nothing before it.
  EXPECT_TRUE(Overlay({0.9, 2.9, 4.9, 6.9}, {0.0, 2.0, 4.0, 6.0}, 1.0).fits_elsewhere({0, 1, 2, 3}));
}

// One of three is half of them, rounded down; one of four is not. Mutation seen to turn this red: one pair is
// enough for another set.
TEST(LookalikeSets, AreNotSeenWhereAFewPairsFitByChance) {
  const std::vector<double> seen{1.4, 4.0, 6.1, 9.2};
  EXPECT_FALSE(Overlay(seen, kUnevenRow, 1.0).fits_elsewhere({1, 2, 3, 4}));
  EXPECT_TRUE(Overlay({1.4, 4.0, 6.1}, kUnevenRow, 1.0).fits_elsewhere({1, 2, 3}));
}

// A shift by four standard deviations is no rival of one that fits. Mutation seen to
// turn this red: costs are not compared.
TEST(LookalikeSets, AreNotSeenBeyondWhatTheirOddsAllow) {
  EXPECT_TRUE(Overlay({2.1, 4.1, 6.1}, kEvenRow, 0.8).fits_elsewhere({1, 2, 3}));
  EXPECT_FALSE(Overlay({2.0, 4.0, 6.0}, kEvenRow, 0.5).fits_elsewhere({1, 2, 3}));
}

}  // namespace
}  // namespace stereobench::slam
