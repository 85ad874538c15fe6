// EKF-SLAM, the smoother and the particle filters give sightings to landmarks and keep their maps by the same
// rules.
#include <array>
#include <ostream>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/slam/checks.h"

namespace stereobench::slam {
namespace {

constexpr double kRange_m = 12.0;
constexpr double kHalfAngle_rad = 1.5;

// Which of the rules a drive is held against.
struct Rules {
  std::string name;
  double spacing_m = 0.0;
  bool has_sector = true;
  Association association = Association::kJoint;
};

void PrintTo(const Rules& rules, std::ostream* out) {
  *out << rules.name;
}

// What the sensor reports of landmarks that lie about the robot: some have an identity, some a colour, some
// are missed, some are seen twice, and some sightings are of nothing or far off.
std::vector<RangeBearing> look(const Pose& robot, const std::vector<Eigen::Vector2d>& places,
                               double precision, RandomStream& random) {
  const double range_sd_m = 0.1 / precision;
  const double bearing_sd_rad = 0.02 / precision;
  std::vector<RangeBearing> seen;
  const auto see = [&](const Eigen::Vector2d& exact, double reach, std::size_t which) {
    RangeBearing one = sighting(exact, range_sd_m, bearing_sd_rad);
    one.range_m = std::abs(one.range_m + reach * range_sd_m * random.normal());
    one.bearing_rad = wrap_angle(one.bearing_rad + reach * bearing_sd_rad * random.normal());
    one.colour_class = static_cast<int>(which % 2);
    if (which % 5 == 0) one.landmark_id = static_cast<int>(which);
    seen.push_back(one);
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector2d exact = predict_sighting(robot, places[i]);
    if (exact.x() > kRange_m || std::abs(exact.y()) > kHalfAngle_rad || random.uniform() < 0.1) continue;
    see(exact, random.uniform() < 0.05 ? 8.0 : 1.0, i);
    if (random.uniform() < 0.1) see(exact, 1.0, i);
  }
  while (random.uniform() < 0.5)
    see({kRange_m * random.uniform(), kHalfAngle_rad * (2.0 * random.uniform() - 1.0)}, 0.0,
        1 + static_cast<std::size_t>(3.0 * random.uniform()));
  return seen;
}

// What a landmark that may be clutter says of the pose is nothing here: the pose is known.
Outcome as_use(Outcome outcome) {
  return outcome == Outcome::kConfirm ? Outcome::kUse : outcome;
}

class OnePolicy : public ::testing::TestWithParam<Rules> {};
INSTANTIATE_TEST_SUITE_P(Settings, OnePolicy,
                         ::testing::Values(Rules{"defaults"}, Rules{"spacing", 1.5, false},
                                           Rules{"no_sector", 0.0, false},
                                           Rules{"individual", 0.0, true, Association::kIndividual}),
                         [](const auto& rules) { return rules.param.name; });

/// Where odometry is exact, two filters must decide alike of every sighting and landmark. Particles cannot
/// merge landmarks.
void expect_alike(const Rules& rules, double precision, const char* one_name, const char* other_name,
                  bool merges = false) {
  FilterConfig config{.particles = 1,
                      .draw_every = 4,
                      .colour_spacing_m = rules.spacing_m,
                      .association = rules.association,
                      .merge_doubles = merges};
  if (rules.has_sector) config.sector = {kRange_m, kHalfAngle_rad, 0.1, 1.0};
  std::array<int, 7> outcomes{};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed, Stream::kWorld);
    std::vector<Eigen::Vector2d> places(15);
    for (Eigen::Vector2d& place : places) place = {20.0 * random.uniform(), 12.0 * random.uniform() - 6.0};
    Filter first = make_filter(one_name, config, {}, seed);
    Filter second = make_filter(other_name, config, {}, seed);
    Pose robot;
    for (int frame = 0; frame < 40; ++frame) {
      const Control control{0.5, 0.1 * random.normal(), 0.5};
      robot = advance(robot, control);
      const std::vector<RangeBearing> seen = look(robot, places, precision, random);
      for (Filter* filter : {&first, &second}) {
        predict(*filter, control);
        update(*filter, seen);
      }
      constexpr double kKnown = 1e-5;
      const bool is_known = near(estimate_without_map(first).pose, robot, kKnown) &&
                            near(estimate_without_map(second).pose, robot, kKnown);
      if (!is_known) break;  // a contradiction was settled against the odometry
      const Decisions one = last_decisions(first);
      const Decisions other = last_decisions(second);
      ASSERT_EQ(one.sightings.size(), other.sightings.size());
      for (std::size_t k = 0; k < one.sightings.size(); ++k) {
        const Decision& a = one.sightings[k];
        const Decision& b = other.sightings[k];
        ASSERT_EQ(a.sighting, b.sighting);
        ASSERT_EQ(as_use(a.outcome), as_use(b.outcome)) << "seed " << seed << ", frame " << frame;
        ASSERT_EQ(a.origin, b.origin) << "seed " << seed << ", frame " << frame;
        ++outcomes[static_cast<std::size_t>(b.outcome)];
      }
      ASSERT_EQ(std::set(one.mapped.begin(), one.mapped.end()),
                std::set(other.mapped.begin(), other.mapped.end()))
          << "seed " << seed << ", frame " << frame;
      ASSERT_EQ(estimate(first).landmarks.size(), estimate(second).landmarks.size());
    }
  }
  EXPECT_GT(outcomes[static_cast<std::size_t>(Outcome::kAdd)], 50);
  EXPECT_GT(outcomes[static_cast<std::size_t>(Outcome::kUse)], 200);
  EXPECT_GT(outcomes[static_cast<std::size_t>(Outcome::kIgnore)],
            rules.has_sector && precision == 1.0 ? 5 : -1);
  EXPECT_GT(outcomes[static_cast<std::size_t>(Outcome::kRefuse)], 5);
}

// Landmarks are independent in the joint Gaussian as they are in a particle. Mutations, in one filter alone:
// another gate, no landmark taken for clutter, odds that do not fall, the dead still matched, contradictions
// not counted.
TEST_P(OnePolicy, WhereThePoseIsKnownAllFiltersDecideAlike) {
  expect_alike(GetParam(), 1.0, "ekf", "fastslam2");
}

// The smoother hands its reader those landmarks alone that a frame may show. Sightings are precise: a
// landmark's place is then the same to first order and at the mode. Mutations: not those within the
// sector; not those nearer than half the spacing; the odds of before kept.
TEST_P(OnePolicy, TheSmootherDecidesAsItsReaderWouldAlone) {
  expect_alike(GetParam(), 100.0, "iekf", "smoother", true);
}

// So does a particle in blocks, and what its reader says of them goes back into its map. Mutations: not those
// within the sector; not those nearer than half the spacing; what was seen of a landmark before it turned out
// to be elsewhere kept; records not written back; new landmarks not written back.
TEST_P(OnePolicy, AParticleInBlocksDecidesAsItsReaderWouldAlone) {
  expect_alike(GetParam(), 100.0, "iekf", "fastslam2_block");
}

}  // namespace
}  // namespace stereobench::slam
