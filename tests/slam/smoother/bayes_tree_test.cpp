#include "slam/smoother/bayes_tree.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::slam {
namespace {

using Factor = BayesTree::Factor;

/// A problem that grows as a drive does, beside the tree that is to solve it.
class GrowingProblem {
 public:
  explicit GrowingProblem(std::uint64_t seed) : random_(seed, Stream::kWorld) {}

  /// One more pose, tied to the last one and to some landmarks, of which some are new.
  void grow() {
    const int pose = add_variable(3);
    if (poses_.empty()) {
      add(pose, BayesTree::kNone, 3);
    } else {
      add(poses_.back(), pose, 3);
    }
    poses_.push_back(pose);
    last_ = {pose};
    for (int i = 0; i < 3; ++i) {
      const bool is_new = landmarks_.size() < 2 || random_.uniform() < 0.2;
      if (is_new) landmarks_.push_back(add_variable(2));
      const int landmark = is_new ? landmarks_.back() : any(landmarks_);
      add(pose, landmark, 2);
      last_.push_back(landmark);
    }
  }

  /// Replaces a factor of long ago.
  void replace_one() {
    const auto index = static_cast<int>(random_.uniform() * static_cast<double>(factors_.size()));
    Factor& factor = factors_[static_cast<std::size_t>(index)];
    factor = random_factor(factor.first, factor.second, factor.rows);
    tree.replace(index, factor);
  }

  std::vector<int> solve(std::size_t most = BayesTree::kAll) { return tree.solve(last_, most); }

  /// R and the solution, by variable, of the dense problem.
  struct Dense {
    Eigen::MatrixXd information;
    Eigen::VectorXd solution;
    std::vector<Eigen::Index> at;
  };
  Dense dense() const {
    Dense dense;
    Eigen::Index columns = 0;
    for (const int size : sizes_) {
      dense.at.push_back(columns);
      columns += size;
    }
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(factors_.size()), columns);
    Eigen::VectorXd target = Eigen::VectorXd::Zero(all.rows());
    Eigen::Index row = 0;
    for (const Factor& factor : factors_) {
      const auto write = [&](int variable, const Eigen::Matrix3d& by) {
        if (variable == BayesTree::kNone) return;
        const auto v = static_cast<std::size_t>(variable);
        all.block(row, dense.at[v], factor.rows, sizes_[v]) = by.topLeftCorner(factor.rows, sizes_[v]);
      };
      write(factor.first, factor.by_first);
      write(factor.second, factor.by_second);
      target.segment(row, factor.rows) = factor.target.head(factor.rows);
      row += factor.rows;
    }
    dense.information = all.transpose() * all;
    dense.solution = all.colPivHouseholderQr().solve(target);
    return dense;
  }

  int variables() const { return static_cast<int>(sizes_.size()); }
  int numbers_of(int variable) const { return sizes_[static_cast<std::size_t>(variable)]; }
  int any(const std::vector<int>& of) {
    return of[static_cast<std::size_t>(random_.uniform() * static_cast<double>(of.size()))];
  }
  const std::vector<int>& poses() const { return poses_; }
  const std::vector<int>& landmarks() const { return landmarks_; }

  BayesTree tree;

 private:
  int add_variable(int numbers) {
    sizes_.push_back(numbers);
    return tree.add_variable(numbers, Eigen::Vector3d::Zero());
  }

  Factor random_factor(int first, int second, int rows) {
    Factor factor;
    factor.first = first;
    factor.second = second;
    factor.rows = rows;
    for (Eigen::Matrix3d* by : {&factor.by_first, &factor.by_second})
      for (double& value : by->reshaped()) value = random_.normal();
    for (double& value : factor.target) value = 10.0 * random_.normal();
    return factor;
  }

  void add(int first, int second, int rows) {
    factors_.push_back(random_factor(first, second, rows));
    tree.add(factors_.back());
  }

  RandomStream random_;
  std::vector<int> sizes_;
  std::vector<Factor> factors_;
  std::vector<int> poses_, landmarks_, last_;
};

class BayesTreeLaw : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, BayesTreeLaw, testing::Range<std::uint64_t>(0, 4));

// At each step, and with factors of long ago replaced. Each variable is off by at most kFollowed conditional
// deviations given those that are eliminated later: the squares of that add up to the error's length.
// Mutations seen to turn this red: what a child passes is left out; rows beyond the columns are cut off
// before they are made triangular; a replaced factor touches its first variable alone; factors of what is
// taken off are forgotten; a variable is looked at only where its parent has moved, not all its separator.
TEST_P(BayesTreeLaw, SolvesLikeTheDenseProblem) {
  GrowingProblem problem(GetParam());
  for (int step = 0; step < 60; ++step) {
    problem.grow();
    if (step % 4 == 3) problem.replace_one();
    problem.solve();
    const GrowingProblem::Dense dense = problem.dense();
    Eigen::VectorXd off(dense.solution.size());
    for (int v = 0; v < problem.variables(); ++v) {
      const Eigen::Index at = dense.at[static_cast<std::size_t>(v)];
      const int n = problem.numbers_of(v);
      off.segment(at, n) = problem.tree.solution(v).head(n) - dense.solution.segment(at, n);
    }
    EXPECT_LE(off.dot(dense.information * off), 1e-4 * static_cast<double>(problem.variables())) << step;
  }
  EXPECT_EQ(problem.tree.repairs(), 0);
}

// What was left of the past comes in when it is asked for: the same as if it had been solved at once. Each
// variable is then off by at most kFollowed conditional deviations. Mutations: catch_up() solves what it is
// asked for without what that depends on; settled() in the order of the variables.
TEST_P(BayesTreeLaw, BringsInWhatItLeftBehind) {
  GrowingProblem problem(GetParam());
  const auto squared_error = [&problem](const auto& solution) {
    const GrowingProblem::Dense dense = problem.dense();
    Eigen::VectorXd off(dense.solution.size());
    for (int v = 0; v < problem.variables(); ++v) {
      const int n = problem.numbers_of(v);
      const Eigen::Index at = dense.at[static_cast<std::size_t>(v)];
      off.segment(at, n) = solution(v).head(n) - dense.solution.segment(at, n);
    }
    return off.dot(dense.information * off);
  };
  double largest_before = 0.0;
  for (int step = 0; step < 60; ++step) {
    problem.grow();
    if (step % 4 == 3) problem.replace_one();
    problem.solve(2);
    const auto bound = 1e-4 * static_cast<double>(problem.variables());
    const auto held = [&](int v) { return problem.tree.solution(v); };
    largest_before = std::max(largest_before, squared_error(held) / bound);
    const std::vector<Eigen::Vector3d> settled = problem.tree.settled();
    EXPECT_LE(squared_error([&](int v) { return settled[static_cast<std::size_t>(v)]; }), bound) << step;
    if (step % 10 != 9) continue;
    const int asked = problem.any(problem.landmarks());
    problem.tree.catch_up(std::vector<int>{asked});
    EXPECT_LE((held(asked) - settled[static_cast<std::size_t>(asked)]).norm(), 1e-12) << step;
    std::vector<int> all(static_cast<std::size_t>(problem.variables()));
    std::iota(all.begin(), all.end(), 0);
    problem.tree.catch_up(all);
    EXPECT_LE(squared_error(held), bound) << step;
    EXPECT_TRUE(problem.tree.catch_up(all).empty());
  }
  EXPECT_GT(largest_before, 10.0);
}

// Mutation: the columns of a separator taken in the order of their variables.
TEST_P(BayesTreeLaw, GivesCovariancesOfTheDenseProblem) {
  GrowingProblem problem(GetParam());
  problem.grow();
  for (int step = 0; step < 40; ++step) {
    problem.grow();
    problem.solve();
    const std::vector<int> asked{problem.poses().back(), problem.any(problem.landmarks()),
                                 problem.poses().front()};
    const GrowingProblem::Dense dense = problem.dense();
    const Eigen::MatrixXd all = dense.information.inverse();
    const Eigen::MatrixXd covariance = problem.tree.covariance(asked);
    Eigen::Index row = 0;
    for (const int a : asked) {
      Eigen::Index column = 0;
      for (const int b : asked) {
        const Eigen::MatrixXd expected =
            all.block(dense.at[static_cast<std::size_t>(a)], dense.at[static_cast<std::size_t>(b)],
                      problem.numbers_of(a), problem.numbers_of(b));
        const auto block = covariance.block(row, column, expected.rows(), expected.cols());
        EXPECT_LE((block - expected).norm(), 1e-7 * (1.0 + expected.norm())) << step;
        column += problem.numbers_of(b);
      }
      row += problem.numbers_of(a);
    }
  }
}

TEST(BayesTree, GivesEqualBytesForEqualCalls) {
  GrowingProblem one(7), other(7);
  for (int step = 0; step < 30; ++step) {
    for (GrowingProblem* problem : {&one, &other}) {
      problem->grow();
      problem->solve();
    }
    for (int v = 0; v < one.variables(); ++v) EXPECT_EQ(one.tree.solution(v), other.tree.solution(v));
  }
}

// A step changes what the new pose is tied to, not the path of long ago, where that is known well. Mutation:
// all changes followed.
TEST(BayesTree, CostsWhatAStepChanges) {
  BayesTree tree;
  const auto prior = [](int variable, double weight, double target) {
    Factor factor;
    factor.first = variable;
    factor.rows = 3;
    factor.by_first = weight * Eigen::Matrix3d::Identity();
    factor.target = Eigen::Vector3d::Constant(weight * target);
    return factor;
  };
  std::size_t changed = 0;
  for (int step = 0; step < 200; ++step) {
    const int pose = tree.add_variable(3, Eigen::Vector3d::Zero());
    tree.add(prior(pose, 10.0, step % 7));
    if (step > 0) {
      Factor motion = prior(pose, 1.0, 1.0);
      motion.second = pose - 1;
      motion.by_second = -motion.by_first;
      tree.add(motion);
    }
    changed = tree.solve(std::vector<int>{pose}).size();
  }
  EXPECT_LE(changed, 10U);
}

TEST(BayesTree, HoldsWhatNothingIsKnownOf) {
  BayesTree tree;
  const int pose = tree.add_variable(3, {1.0, 2.0, 3.0});
  const int landmark = tree.add_variable(2, {4.0, 5.0, 0.0});
  Factor range;  // of the landmark from the pose, along x: nothing else is known
  range.first = pose;
  range.second = landmark;
  range.rows = 1;
  range.by_first(0, 0) = -100.0;
  range.by_second(0, 0) = 100.0;
  range.target.x() = 300.0;
  tree.add(range);
  tree.solve(std::vector<int>{pose});
  EXPECT_TRUE(tree.solution(pose).isApprox(Eigen::Vector3d(1.0, 2.0, 3.0), 1e-9));
  EXPECT_TRUE(tree.solution(landmark).isApprox(Eigen::Vector3d(4.0, 5.0, 0.0), 1e-9));
  EXPECT_EQ(tree.repairs(), 4);
  EXPECT_TRUE(tree.covariance(std::vector<int>{pose, landmark}).allFinite());
}

// A landmark whose x alone two poses see: once x is eliminated, what is left says where the poses are to each
// other. Mutation: the row that holds the landmark's y takes the place of that.
TEST(BayesTree, KeepsWhatIsKnownOfOthersWhereItHoldsAVariable) {
  BayesTree tree;
  const int known = tree.add_variable(1, {1.0, 0.0, 0.0});
  const int landmark = tree.add_variable(2, {4.0, 5.0, 0.0});
  const int other = tree.add_variable(1, {0.0, 0.0, 0.0});
  Factor prior;
  prior.first = known;
  prior.rows = 1;
  prior.by_first(0, 0) = 100.0;
  prior.target.x() = 100.0;
  tree.add(prior);
  for (const auto& [pose, distance_m] : {std::pair(known, 3.0), std::pair(other, 2.0)}) {
    Factor range;
    range.first = pose;
    range.second = landmark;
    range.rows = 1;
    range.by_first(0, 0) = -100.0;
    range.by_second(0, 0) = 100.0;
    range.target.x() = 100.0 * distance_m;
    tree.add(range);
  }
  tree.solve(std::vector<int>{other});
  EXPECT_NEAR(tree.solution(other).x(), 2.0, 1e-9);
  EXPECT_NEAR(tree.solution(landmark).x(), 4.0, 1e-9);
  EXPECT_NEAR(tree.solution(landmark).y(), 5.0, 1e-9);
}

}  // namespace
}  // namespace stereobench::slam
