#include "slam/fastslam/landmark_map.h"

#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::slam {
namespace {

Landmark at(double x, double y, int colour = 0, double variance = 0.01) {
  Landmark landmark;
  landmark.belief = {{x, y}, variance * Eigen::Matrix2d::Identity()};
  landmark.status.colour_class = colour;
  return landmark;
}

Landmark anywhere(RandomStream& random) {
  return at(10.0 * random.normal(), 10.0 * random.normal(), 0, random.uniform());
}

void expect_same(const LandmarkMap& map, const std::vector<Landmark>& expected) {
  ASSERT_EQ(map.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_EQ(map[i].belief.mean, expected[i].belief.mean) << i << " of " << expected.size();
}

class Seeds : public testing::TestWithParam<std::uint64_t> {};

// Maps beside plain vectors: a thousand changes to a family of maps that share, copy and die. Mutations: a
// node changed that others own, a copy that shares, a map that is not released (asan), a root lost as the
// tree grows.
TEST_P(Seeds, AFamilyOfMapsIsAFamilyOfVectors) {
  RandomStream random(GetParam(), Stream::kWorld);
  std::vector<LandmarkMap> maps(5);
  std::vector<std::vector<Landmark>> vectors(5);
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
  };
  for (int change = 0; change < 3000; ++change) {
    const std::size_t i = below(5);
    const std::size_t j = below(5);
    const double kind = random.uniform();
    const Landmark landmark = anywhere(random);
    if (kind < 0.5) {
      maps[i].push_back(landmark);
      vectors[i].push_back(landmark);
    } else if (kind < 0.9 && !vectors[i].empty()) {
      const std::size_t k = below(vectors[i].size());
      maps[i].replace(k, landmark);
      vectors[i][k] = landmark;
    } else if (kind < 0.97) {
      maps[i] = maps[j].share();
      vectors[i] = vectors[j];
    } else if (kind < 0.995) {
      maps[i] = maps[j];
      vectors[i] = vectors[j];
    } else {
      maps[i] = {};
      vectors[i].clear();
    }
  }
  for (std::size_t i = 0; i < 5; ++i) expect_same(maps[i], vectors[i]);
}

// Mutations: bounds that are not extended by a changed landmark or by its uncertainty, indices that do not
// count skipped landmarks, an order that is not that of discovery.
TEST_P(Seeds, AVisitWithinBoundsFindsWhatALookAtEachFinds) {
  RandomStream random(GetParam(), Stream::kWorld);
  LandmarkMap map;
  std::vector<Landmark> all;
  for (int i = 0; i < 700; ++i) {
    all.push_back(anywhere(random));
    map.push_back(all.back());
  }
  for (int i = 0; i < 200; ++i) {
    const auto k = static_cast<std::size_t>(random.uniform() * 700.0);
    all[k] = anywhere(random);
    map.replace(k, all[k]);
  }
  for (int look = 0; look < 50; ++look) {
    const Eigen::Vector2d place(10.0 * random.normal(), 10.0 * random.normal());
    const auto near = [&](const Eigen::Vector2d& mean, double variance_m2) {
      return (mean - place).squaredNorm() <= 9.0 * variance_m2;
    };
    std::vector<std::size_t> expected;
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (near(all[i].belief.mean, all[i].belief.covariance.trace())) expected.push_back(i);
    map.visit(
        [&](const LandmarkBounds& bounds) {
          return bounds.places_m.squaredExteriorDistance(place) <= 9.0 * bounds.largest_variance_m2;
        },
        [&](std::size_t i, const Landmark& landmark) {
          ASSERT_EQ(landmark.belief.mean, all[i].belief.mean);
          if (near(landmark.belief.mean, landmark.belief.covariance.trace())) found.push_back(i);
        });
    ASSERT_EQ(found, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(LandmarkMap, Seeds, testing::Range<std::uint64_t>(0, 10));

// A robot finds landmarks along its way: of ten thousand, a search looks at those of the neighbourhood.
TEST(LandmarkMap, ASearchAlongAWayLooksAtFewLandmarks) {
  LandmarkMap map;
  for (int i = 0; i < 10'000; ++i) map.push_back(at(i, 0.0));
  int groups = 0;
  int looks = 0;
  map.visit(
      [&](const LandmarkBounds& bounds) {
        ++groups;
        return bounds.places_m.squaredExteriorDistance(Eigen::Vector2d(5000.5, 0.0)) <= 4.0;
      },
      [&](std::size_t, const Landmark&) { ++looks; });
  EXPECT_LE(looks, 16);
  EXPECT_LE(groups, 64);
}

// What two maps share is one place in memory; what one changes is its own.
TEST(LandmarkMap, OnlyWhatChangesIsCopied) {
  LandmarkMap map;
  for (int i = 0; i < 1000; ++i) map.push_back(at(i, 0.0));
  LandmarkMap heir = map.share();
  heir.replace(500, at(-1.0, 0.0));
  std::set<const Landmark*> own;
  for (std::size_t i = 0; i < 1000; ++i)
    if (&heir[i] != &map[i]) own.insert(&heir[i]);
  EXPECT_EQ(own.size(), 8U);  // the leaf with 500
  EXPECT_EQ(map[500].belief.mean.x(), 500.0);
  const LandmarkMap copy = map;
  EXPECT_NE(&copy[0], &map[0]);
}

TEST(LandmarkMap, AMapThatDiesLeavesItsHeirWhole) {
  LandmarkMap heir;
  {
    LandmarkMap map;
    for (int i = 0; i < 100; ++i) map.push_back(at(i, 0.0));
    heir = map.share();
  }
  EXPECT_EQ(heir.size(), 100U);
  EXPECT_EQ(heir[77].belief.mean.x(), 77.0);
}

}  // namespace
}  // namespace stereobench::slam
