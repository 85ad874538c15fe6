/// What a line meets first, against asking everything.
#include "worlds/visibility/bvh.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/worlds/visibility/triangles.h"

namespace stereobench::worlds {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// A disc that faces along an axis.
struct HiddenDisc {
  Eigen::Vector3d centre;
  Eigen::Index axis;
  double radius;

  double enter(const Ray& line) const {
    const double at = (centre[axis] - line.origin_m[axis]) / line.direction[axis];
    if (!(at > 0.0)) return kNever;
    return (line.origin_m + at * line.direction - centre).norm() <= radius ? at : kNever;
  }
  Eigen::AlignedBox3d box() const {
    Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius);
    reach[axis] = 0.0;
    return {centre - reach, centre + reach};
  }
};

// Flat boxes, lines along the axes and lines that begin within boxes among them. Mutations: the stretch's end
// not drawn nearer; what lies behind the origin; a node's end one too early.
TEST(Bvh, MeetsFirstWhatALineEntersFirst) {
  int met = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    slam::RandomStream random(seed, slam::Stream::kWorld);
    std::vector<HiddenDisc> discs;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (std::uint64_t i = 0; i < seed * 5; ++i) {
      discs.push_back(
          {random_in_box(random, 5.0), static_cast<Eigen::Index>(i % 3), 0.01 + 1.49 * random.uniform()});
      boxes.push_back(discs.back().box());
    }
    const Bvh tree(boxes);
    for (int i = 0; i < 200; ++i) {
      Ray line{random_in_box(random, 6.0), random_in_box(random, 1.0)};
      if (i % 5 == 0) line.direction[i % 3] = 0.0;
      if (i % 7 == 0 && !discs.empty()) line.direction = discs[0].centre - line.origin_m;
      const double from = i % 2 == 0 ? 0.0 : 0.7, before = i % 3 == 0 ? 4.0 : kNever;
      Bvh::Met expected{-1, before};
      for (int k = 0; k < static_cast<int>(discs.size()); ++k) {
        const double there = discs[static_cast<std::size_t>(k)].enter(line);
        if (there >= from && there < expected.at) expected = {k, there};
      }
      const Bvh::Met found = tree.first(
          line, from, before, [&](int k) { return discs[static_cast<std::size_t>(k)].enter(line); });
      ASSERT_EQ(found.thing, expected.thing) << seed << ": " << i;
      ASSERT_EQ(found.at, expected.at);
      met += found.thing >= 0 ? 1 : 0;
    }
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace stereobench::worlds
