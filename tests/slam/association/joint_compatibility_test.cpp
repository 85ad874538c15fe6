// The joint test against every assignment there is, with one dense covariance for each.
#include "slam/association/joint_compatibility.h"

#include <algorithm>
#include <optional>
#include <set>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/math/gaussian.h"
#include "slam/math/random.h"

namespace stereobench::slam {
namespace {

constexpr double kProbability = 0.99;
// There is nothing else that a sighting can be of, so that the largest set is the likeliest.
const std::vector<double> kNothingElse(12, 1e3);

using Chosen = std::set<std::pair<int, int>>;  // (sighting, landmark)

// Sightings against landmarks, all off by one error of the pose and by noise of their own.
struct Frame {
  std::vector<Candidate> candidates;
  std::vector<Pairing> pairings;
  std::vector<Eigen::Matrix<double, 2, 3>> by_pose;

  Frame(std::uint64_t seed, int sightings, int landmarks) {
    RandomStream random(seed, Stream::kWorld);
    const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
    for (int k = 0; k < sightings; ++k) {
      for (int j = 0; j < landmarks; ++j) {
        if (k != j && random.uniform() < 0.5) continue;
        by_pose.emplace_back(Eigen::Matrix<double, 2, 3>::NullaryExpr([&] { return random.normal(); }));
        Eigen::Vector2d residual =
            by_pose.back() * error + 0.3 * Eigen::Vector2d(random.normal(), random.normal());
        if (k != j) residual += 1.5 * Eigen::Vector2d(random.normal(), random.normal());
        const Eigen::Matrix2d covariance =
            by_pose.back() * by_pose.back().transpose() + 0.09 * Eigen::Matrix2d::Identity();
        const double length = residual.dot(covariance.inverse() * residual);
        pairings.push_back({residual, covariance});
        candidates.push_back({k, j, length + std::log(covariance.determinant()),
                              length > chi_square_2_quantile(kProbability)});
      }
    }
  }

  Tie tie() const {
    return [this](std::size_t a, std::size_t b) -> Eigen::Matrix2d {
      return by_pose[a] * by_pose[b].transpose();
    };
  }

  // Squared length and cost of some of the pairs together.
  std::pair<double, double> measure(const std::vector<std::size_t>& pairs) const {
    const auto n = static_cast<Eigen::Index>(2 * pairs.size());
    Eigen::MatrixXd covariance(n, n);
    Eigen::VectorXd residual(n);
    for (std::size_t a = 0; a < pairs.size(); ++a) {
      const auto row = static_cast<Eigen::Index>(2 * a);
      residual.segment<2>(row) = pairings[pairs[a]].residual;
      for (std::size_t b = 0; b < pairs.size(); ++b) {
        covariance.block<2, 2>(row, static_cast<Eigen::Index>(2 * b)) =
            a == b ? pairings[pairs[a]].covariance : tie()(pairs[a], pairs[b]);
      }
    }
    const double length = residual.dot(covariance.ldlt().solve(residual));
    return {length, length + std::log((2.0 * M_PI * covariance).determinant())};
  }

  bool competes(std::size_t one) const {
    for (const Candidate& other : candidates) {
      const Candidate& mine = candidates[one];
      if (!other.gated && (other.sighting == mine.sighting) != (other.landmark == mine.landmark)) return true;
    }
    return false;
  }
};

// All sets of pairs that hold the ones without a competitor; nothing when those contradict each other.
std::optional<Chosen> by_brute_force(const Frame& frame) {
  std::vector<std::size_t> fixed;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < frame.candidates.size(); ++i) {
    if (!frame.candidates[i].gated) (frame.competes(i) ? open : fixed).push_back(i);
  }
  std::optional<std::vector<std::size_t>> best;
  double best_cost = 0.0;
  for (unsigned mask = 0; mask < (1u << open.size()); ++mask) {
    std::vector<std::size_t> pairs = fixed;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if ((mask >> i & 1u) != 0u) pairs.push_back(open[i]);
    }
    std::set<int> sightings;
    std::set<int> landmarks;
    for (const std::size_t pair : pairs) {
      sightings.insert(frame.candidates[pair].sighting);
      landmarks.insert(frame.candidates[pair].landmark);
    }
    if (sightings.size() < pairs.size() || landmarks.size() < pairs.size()) continue;
    const auto [length, cost] = frame.measure(pairs);
    if (length > approximate_chi_square_quantile(kProbability, 2.0 * static_cast<double>(pairs.size())))
      continue;
    if (best && (pairs.size() < best->size() || (pairs.size() == best->size() && cost >= best_cost)))
      continue;
    best = pairs;
    best_cost = cost;
  }
  if (!best || frame.measure(fixed).first >
                   approximate_chi_square_quantile(kProbability, 2.0 * static_cast<double>(fixed.size())))
    return std::nullopt;
  Chosen chosen;
  for (const std::size_t pair : *best)
    chosen.emplace(frame.candidates[pair].sighting, frame.candidates[pair].landmark);
  return chosen;
}

Chosen within_gate(const std::vector<Candidate>& candidates) {
  Chosen chosen;
  for (const Candidate& pair : candidates) {
    if (!pair.gated) chosen.emplace(pair.sighting, pair.landmark);
  }
  return chosen;
}

// Subsets of a compatible set need not be compatible under a quantile, so that the search, which asks on its
// way, may rightly end with less than brute force: it must never end with more, and nearly always with as
// much. Mutations tried: the tie left out, a landmark given twice.
TEST(JointCompatibility, FindsWhatTryingEverythingFinds) {
  int equal = 0;
  int compared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Frame frame(seed, 4, 4);
    if (!is_open(frame.candidates)) continue;
    const auto expected = by_brute_force(frame);
    if (!expected) continue;
    std::vector<Candidate> kept = frame.candidates;
    long cut = 0;
    keep_joint(kept, frame.pairings, frame.tie(), kNothingElse, kProbability, cut);
    const Chosen chosen = within_gate(kept);
    EXPECT_EQ(cut, 0);
    EXPECT_LE(chosen.size(), expected->size()) << "seed " << seed;
    ++compared;
    equal += chosen == *expected ? 1 : 0;
  }
  EXPECT_GE(compared, 100);
  EXPECT_GE(equal, compared * 95 / 100);
}

// Mutation: sightings searched in the order in which they come.
TEST(JointCompatibility, DoesNotCareForTheOrderOfCandidates) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Frame frame(seed, 4, 4);
    Frame turned = frame;
    std::ranges::reverse(turned.candidates);
    std::ranges::reverse(turned.pairings);
    std::ranges::reverse(turned.by_pose);
    long cut = 0;
    Frame straight = frame;
    keep_joint(straight.candidates, frame.pairings, frame.tie(), kNothingElse, kProbability, cut);
    const Tie tie = [&](std::size_t a, std::size_t b) -> Eigen::Matrix2d {
      return turned.by_pose[a] * turned.by_pose[b].transpose();
    };
    keep_joint(turned.candidates, turned.pairings, tie, kNothingElse, kProbability, cut);
    EXPECT_EQ(within_gate(straight.candidates), within_gate(turned.candidates)) << "seed " << seed;
  }
}

// Two posts a metre apart, seen from a pose that is off by nearly that: each alone, the left one looks like
// the right one; together they fit one shift only.
TEST(JointCompatibility, WhatBelongsTogetherIsShiftedTogether) {
  std::vector<Candidate> candidates;
  std::vector<Pairing> pairings;
  for (int sighting = 0; sighting < 2; ++sighting) {
    for (int landmark = 0; landmark < 2; ++landmark) {
      const Eigen::Vector2d residual(sighting - landmark + 0.8, 0.0);
      const Eigen::Matrix2d covariance = 1.01 * Eigen::Matrix2d::Identity();
      candidates.push_back({sighting, landmark, residual.squaredNorm() / 1.01, false});
      pairings.push_back({residual, covariance});
    }
  }
  const Tie tie = [](std::size_t, std::size_t) -> Eigen::Matrix2d { return Eigen::Matrix2d::Identity(); };
  std::vector<Target> greedy(2);
  std::vector<Candidate> all = candidates;
  assign(all, false, greedy);
  EXPECT_EQ(greedy[0].landmark, 1) << "likeliest alone";
  long cut = 0;
  keep_joint(candidates, pairings, tie, kNothingElse, kProbability, cut);
  EXPECT_EQ(within_gate(candidates), (Chosen{{0, 0}, {1, 1}}));
}

TEST(JointCompatibility, WithoutCompetitorsNothingIsOpen) {
  const std::vector<Candidate> candidates = {{0, 0, 1.0, false}, {1, 1, 1.0, false}, {1, 0, 9.0, true}};
  EXPECT_FALSE(is_open(candidates));
  EXPECT_TRUE(is_open(std::vector<Candidate>{{0, 0, 1.0, false}, {1, 0, 1.0, false}}));
  EXPECT_TRUE(is_open(std::vector<Candidate>{{0, 0, 1.0, false}, {0, 1, 1.0, false}}));
  EXPECT_TRUE(is_open(std::vector<Candidate>{{0, 0, 1.0, false, true}}));
}

// Posts in a row, a metre apart, seen from a pose that is off by so much along it: what was seen is the whole
// row or, shifted by one, all but one of them.
struct Row {
  std::vector<Candidate> candidates;
  std::vector<Pairing> pairings;
  std::vector<double> costs;
  const Tie tie = [](std::size_t, std::size_t) -> Eigen::Matrix2d { return Eigen::Matrix2d::Identity(); };

  // @param as_other minus twice the log density of other posts
  Row(int posts, double off_m, double as_other) : costs(static_cast<std::size_t>(posts), as_other) {
    constexpr double kNoise = 1e-4;
    for (int sighting = 0; sighting < posts; ++sighting) {
      for (int landmark = 0; landmark < posts; ++landmark) {
        const Eigen::Vector2d residual(sighting - landmark + off_m, 0.0);
        const double variance = 1.0 + kNoise;
        const double length = residual.squaredNorm() / variance;
        if (length > chi_square_2_quantile(kProbability)) continue;
        candidates.push_back(
            {sighting, landmark, length + 2.0 * std::log(2.0 * M_PI * variance), false, true});
        pairings.push_back({residual, variance * Eigen::Matrix2d::Identity()});
      }
    }
  }

  std::vector<int> unsure() {
    long cut = 0;
    return keep_joint(candidates, pairings, tie, costs, kProbability, cut);
  }
};

// A shift by a whole metre leaves a post without a partner, which costs as_other in place of -15. The first
// pair costs 2 log(2 pi) and the square of the shift that is left. It explains two of three all the same
// (fits_elsewhere). Mutation seen to turn this red: no look elsewhere.
TEST(JointCompatibility, IsUnsureInARowThoughOneShiftExplainsMore) {
  Row row(3, 0.4, 5.0);
  EXPECT_EQ(row.unsure(), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(within_gate(row.candidates), (Chosen{{0, 0}, {1, 1}, {2, 2}}));
}

TEST(JointCompatibility, IsUnsureWhereAnotherShiftFitsAsWell) {
  // Other posts are so common that a post beyond the row is no surprise.
  Row row(3, 0.4, -12.0);
  EXPECT_EQ(row.unsure(), (std::vector<int>{0, 1, 2}));
}

TEST(JointCompatibility, IsUnsureOfALoosePairAlone) {
  Row row(1, 0.1, 5.0);
  EXPECT_EQ(row.unsure(), (std::vector<int>{0})) << "another post has exp(-2.5) against 1 / (2 pi)";
  Row sure(1, 0.1, 30.0);
  EXPECT_TRUE(sure.unsure().empty());
}

// Twelve sightings of twelve landmarks on one spot: 13 billion ways. Mutation: no limit, by which it does not
// come back.
TEST(JointCompatibility, GivesUpInTimeAndSaysSo) {
  std::vector<Candidate> candidates;
  std::vector<Pairing> pairings;
  for (int k = 0; k < 12; ++k) {
    for (int j = 0; j < 12; ++j) {
      candidates.push_back({k, j, 0.01 * (k + j), false, true});
      pairings.push_back({Eigen::Vector2d(0.01 * k, 0.01 * j), Eigen::Matrix2d::Identity()});
    }
  }
  const Tie tie = [](std::size_t, std::size_t) -> Eigen::Matrix2d { return Eigen::Matrix2d::Zero(); };
  long cut = 0;
  const std::vector<int> unsure = keep_joint(candidates, pairings, tie, kNothingElse, kProbability, cut);
  EXPECT_EQ(unsure.size(), 12u);
  EXPECT_EQ(cut, 1);
  EXPECT_EQ(candidates.size(), 144u);
}

}  // namespace
}  // namespace stereobench::slam
