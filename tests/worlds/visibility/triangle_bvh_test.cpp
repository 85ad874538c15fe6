/// The tree against looking at every triangle.
#include "worlds/visibility/triangle_bvh.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/worlds/visibility/triangles.h"

namespace stereobench::worlds {
namespace {

bool is_within(std::span<const HalfSpace> halves, const Eigen::Vector3d& point) {
  return std::ranges::all_of(halves,
                             [&](const HalfSpace& half) { return half.dot(point.homogeneous()) >= 0.0; });
}

TEST(TriangleBvh, FindsATriangleExactlyWhereThereIsOne) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    slam::RandomStream draws(seed, slam::Stream::kWorld);
    std::vector<TriangleCorners> triangles = random_triangles(draws, static_cast<int>(seed % 40), 1.0);
    if (seed % 3 == 0 && !triangles.empty()) triangles.resize(9, triangles.front());  // all in one place
    const TriangleBvh tree(triangles);
    std::vector<HalfSpace> within;
    for (int i = 0; i < 5; ++i) {
      within.emplace_back();
      within.back() << random_in_box(draws, 1.0), 0.3 * draws.uniform();
    }
    const auto test = [&](const TriangleCorners& corners) {
      return std::ranges::any_of(corners, [&](const auto& corner) { return is_within(within, corner); });
    };
    EXPECT_EQ(tree.any(within, test), std::ranges::any_of(triangles, test)) << seed;
    found += tree.any(within, test) ? 1 : 0;
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(found, 350);
}

TEST(TriangleBvh, LooksAtFewOfMany) {
  slam::RandomStream draws(1, slam::Stream::kWorld);
  const TriangleBvh tree(random_triangles(draws, 30000, 0.02));
  int looked_at = 0;
  const auto count = [&](const TriangleCorners&) { return ++looked_at < 0; };
  const std::vector<HalfSpace> around_a_line = {
      {1.0, 0.0, 0.0, 0.01}, {-1.0, 0.0, 0.0, 0.01}, {0.0, 1.0, 0.0, 0.01}, {0.0, -1.0, 0.0, 0.01}};
  EXPECT_FALSE(tree.any(around_a_line, count));
  EXPECT_GT(looked_at, 1);
  EXPECT_LT(looked_at, 300);
}

}  // namespace
}  // namespace stereobench::worlds
