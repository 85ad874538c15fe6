#include "harness/budget/budget_search.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>

#include "harness/budget/budget_range.h"
#include "slam/math/random.h"
#include "tests/harness/budget/made_up_worlds.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;

constexpr double kNoMetric = std::numeric_limits<double>::quiet_NaN();

/// Seeds whose metric is the level over a threshold of their own, log-normal.
struct Spread {
  std::uint64_t key = 0;
  double centre = 0.3;
  double sd = 0.6;

  double threshold(std::uint64_t seed) const {
    return centre * std::exp(sd * slam::RandomStream(seed, slam::Stream::kWorld, key).normal());
  }
  double operator()(double level, std::uint64_t seed) const { return level / threshold(seed); }
};

BudgetQuestion question_of(std::size_t seeds, const WorldShare& wanted = {}) {
  return {.levels = budget_levels({{"a", 0.0, 1.0}}, 0.02),
          .seeds = seeds_from(0, seeds),
          .limit = {"m", Gate::Relation::kAtMost, 1.0},
          .wanted = wanted};
}

/// All seeds at all levels: the last level before the first one at which too many fail. -1: there is none.
double by_full_grid(const BudgetQuestion& question, const MadeUpWorlds& worlds) {
  const long order = order_of_bound(std::ssize(question.seeds), question.wanted);
  double last = -1.0;
  for (const double level : question.levels) {
    const auto fails = std::ranges::count_if(question.seeds, [&](std::uint64_t seed) {
      return !keeps_limit(question.limit, worlds.metric(level, seed));
    });
    if (fails >= order) return last;
    last = level;
  }
  return last;
}

/// One of many questions: of each share and number of seeds, with narrow and wide thresholds, of which some
/// lie beyond an end.
struct Trial {
  BudgetQuestion question;
  MadeUpWorlds worlds;
};

Trial trial(std::uint64_t key) {
  slam::RandomStream random(key, slam::Stream::kClutter);
  const auto choice = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const WorldShare wanted = {choice(0.5, 0.97), choice(0.6, 0.97)};
  const auto seeds = fewest_worlds(wanted) + static_cast<long>(choice(0.0, 120.0));
  const Spread spread = {key, choice(0.001, 1.5), choice(0.0, 1.2)};
  return {question_of(static_cast<std::size_t>(seeds), wanted), {spread}};
}

// Mutations: one more seed may fail; the level beside it; a seed that failed is taken to keep the limit
// above.
TEST(BudgetSearch, IsTheAnswerOfAFullGrid) {
  int inside = 0;
  for (std::uint64_t key = 0; key < 300; ++key) {
    auto [question, worlds] = trial(key);
    const double expected = by_full_grid(question, worlds);
    const Budget budget = find_budget(question, std::ref(worlds));
    EXPECT_EQ(budget.outcome == BudgetOutcome::kNone ? -1.0 : budget.level, expected) << key;
    EXPECT_EQ(budget.outcome == BudgetOutcome::kWholeRange, expected == question.levels.back()) << key;
    inside += budget.outcome == BudgetOutcome::kFound ? 1 : 0;
    EXPECT_TRUE(budget.not_monotone.empty()) << key;
  }
  EXPECT_GT(inside, 200);
}

// Mutations: a final level of which some seeds were not run; values in the order of the runs; runs asked for
// twice; chunks of all seeds.
TEST(BudgetSearch, RunsEachSeedAtTheBudgetAndNoneTwice) {
  for (std::uint64_t key = 0; key < 300; ++key) {
    auto [question, worlds] = trial(key);
    const Budget budget = find_budget(question, std::ref(worlds));
    ASSERT_EQ(budget.values.size(), question.seeds.size());
    long failing = 0;
    for (std::size_t i = 0; i < question.seeds.size(); ++i) {
      EXPECT_TRUE(worlds.asked.contains({budget.level, question.seeds[i]})) << key;
      EXPECT_EQ(budget.values[i], worlds.metric(budget.level, question.seeds[i]));
      failing += budget.values[i] > 1.0 ? 1 : 0;
    }
    EXPECT_EQ(budget.failing, failing);
    EXPECT_EQ(budget.failing <= budget.may_fail, budget.outcome != BudgetOutcome::kNone) << key;
    EXPECT_FALSE(worlds.asked_twice) << key;
    EXPECT_LE(worlds.largest_chunk, 8U);
    EXPECT_EQ(budget.runs.size(), worlds.asked.size());
    EXPECT_EQ(budget.grid_runs, std::ssize(question.levels) * std::ssize(question.seeds));
  }
}

/// Runs for each seed, in the mean of 50 questions.
double runs_a_seed(std::size_t seeds) {
  double runs = 0.0;
  for (std::uint64_t key = 0; key < 50; ++key)
    runs += static_cast<double>(find_budget(question_of(seeds), MadeUpWorlds{Spread{key}}).runs.size());
  return runs / 50.0 / static_cast<double>(seeds);
}

// Each seed is run at the budget; the rest is what the search costs. Mutations: seeds first that are known to
// keep the limit (2.8 and 8.8); a level that is run to its end though too many fail, or no more than may (3.7
// of many seeds).
TEST(BudgetSearch, IsLazy) {
  EXPECT_LT(runs_a_seed(59), 2.6);
  EXPECT_LT(runs_a_seed(361), 3.5);
}

// What is behind a seed's number does not matter, nor where it stands in the list.
TEST(BudgetSearch, DoesNotDependOnTheOrderOfSeeds) {
  for (std::uint64_t key = 0; key < 100; ++key) {
    auto [question, worlds] = trial(key);
    const Budget budget = find_budget(question, std::ref(worlds));
    std::ranges::reverse(question.seeds);
    std::rotate(question.seeds.begin(), question.seeds.begin() + 3, question.seeds.end());
    const Budget other = find_budget(question, MadeUpWorlds{worlds.metric});
    EXPECT_EQ(other.level, budget.level) << key;
    EXPECT_EQ(other.outcome, budget.outcome) << key;
    EXPECT_EQ(other.failing, budget.failing) << key;
  }
}

// However an engine splits a chunk, or in which order it runs it: the same runs in the same order.
TEST(BudgetSearch, DoesNotDependOnHowAChunkIsRun) {
  const auto question = question_of(100);
  const Spread spread;
  const Budget budget = find_budget(question, MadeUpWorlds{spread});
  const Budget other = find_budget(question, [&](double level, const std::vector<std::uint64_t>& seeds) {
    std::vector<double> values(seeds.size());
    for (std::size_t i = seeds.size(); i > 0; --i) values[i - 1] = spread(level, seeds[i - 1]);
    return values;
  });
  ASSERT_EQ(other.runs.size(), budget.runs.size());
  for (std::size_t i = 0; i < budget.runs.size(); ++i) {
    EXPECT_EQ(other.runs[i].level, budget.runs[i].level);
    EXPECT_EQ(other.runs[i].seed, budget.runs[i].seed);
    EXPECT_EQ(other.runs[i].value, budget.runs[i].value);
  }
}

// Less is worse, and the metric is good where it is large. Mutations: levels that are sorted; `<=` for both.
TEST(BudgetSearch, GoesDownwardsAndWithLowerLimits) {
  BudgetQuestion question = question_of(59);
  question.levels = {9, 8, 7, 6, 5, 4, 3, 2, 1, 0};
  question.limit = {"recall", Gate::Relation::kAtLeast, 0.5};
  const Budget budget = find_budget(question, MadeUpWorlds{[](double level, std::uint64_t seed) {
                                      return level >= (seed == 30 ? 4.0 : 2.0) ? 0.5 : 0.4;
                                    }});
  EXPECT_EQ(budget.outcome, BudgetOutcome::kFound);
  EXPECT_EQ(budget.level, 4.0);
  EXPECT_EQ(budget.fails_at, 3.0);
}

// Mutations: seeds that fail at the good end counted until there are too many only; a bad end that is given
// as a level that fails.
TEST(BudgetSearch, SaysWhatIsAtTheEnds) {
  const BudgetQuestion question = question_of(93);  // of which one may fail
  const Budget none = find_budget(
      question, MadeUpWorlds{[](double, std::uint64_t seed) { return seed % 9 == 0 ? 2.0 : 0.0; }});
  EXPECT_EQ(none.outcome, BudgetOutcome::kNone);
  EXPECT_EQ(none.level, 0.0);
  EXPECT_EQ(none.failing, 11);
  EXPECT_FALSE(none.fails_at);
  const Budget all =
      find_budget(question, MadeUpWorlds{[](double, std::uint64_t seed) { return seed == 50 ? 2.0 : 1.0; }});
  EXPECT_EQ(all.outcome, BudgetOutcome::kWholeRange);
  EXPECT_EQ(all.level, 1.0);
  EXPECT_EQ(all.failing, 1);
  EXPECT_EQ(all.may_fail, 1);
  EXPECT_FALSE(all.fails_at);
  EXPECT_EQ(all.runs.size(), 93U);
}

// Mutation: NaN that keeps a limit.
TEST(BudgetSearch, ARunWithoutAValueBreaksTheLimit) {
  for (const auto relation : {Gate::Relation::kAtMost, Gate::Relation::kAtLeast})
    EXPECT_FALSE(keeps_limit({"m", relation, 0.0}, kNoMetric));
  const Budget budget = find_budget(question_of(59), MadeUpWorlds{[](double level, std::uint64_t seed) {
                                      return seed == 7 && level > 0.3 ? kNoMetric : 0.0;
                                    }});
  EXPECT_EQ(budget.level, 0.3);
}

/// One seed fails within a window of levels and keeps the limit above it, up to where it fails like others.
double with_a_gap(double level, std::uint64_t seed) {
  const bool in_gap = seed == 40 && level > 0.2 && level < 0.4;
  return in_gap || level > 0.5 + 0.001 * static_cast<double>(seed) ? 2.0 : 1.0;
}

// Mutations: an answer that rests on what was taken to be so; seeds that failed last in the list of them.
TEST(BudgetSearch, FindsSeedsThatAreNotMonotone) {
  BudgetQuestion question = question_of(59);
  question.levels = {0.0, 0.1, 0.3, 0.6};
  const Budget budget = find_budget(question, MadeUpWorlds{with_a_gap});
  EXPECT_EQ(budget.level, 0.1);
  EXPECT_EQ(budget.fails_at, 0.3);
  EXPECT_TRUE(budget.not_monotone.empty());  // it never kept the limit above 0.3
  question.levels = {0.0, 0.1, 0.3, 0.5, 0.6};
  const Budget other = find_budget(
      question, MadeUpWorlds{[](double level, std::uint64_t seed) {
        return seed == 40 && level == 0.3 ? 2.0 : seed < 8 && level > 0.3 ? 2.0 : level > 0.5 ? 2.0 : 1.0;
      }});
  EXPECT_EQ(other.level, 0.1);
  EXPECT_TRUE(std::ranges::all_of(other.values, [](double value) { return value <= 1.0; }));
}

// A seed that is tried on a level and kept the limit there, then broke it below: another one made the search
// go on. Mutation: none is listed.
TEST(BudgetSearch, ListsSeedsThatAreNotMonotone) {
  BudgetQuestion question = question_of(59);
  question.levels = {0.0, 1.0, 2.0, 3.0, 4.0};
  const auto metric = [](double level, std::uint64_t seed) {
    if (seed == 0) return level >= 4.0 ? 2.0 : 1.0;   // found first
    if (seed == 20) return level >= 3.0 ? 2.0 : 1.0;  // found at 3, when seeds 1 .. 19 have kept the limit
    if (seed == 5) return level == 2.0 ? 2.0 : 1.0;   // keeps it at 3, breaks it at 2
    return 1.0;
  };
  const Budget budget = find_budget(question, MadeUpWorlds{metric});
  EXPECT_EQ(budget.level, 1.0);
  EXPECT_THAT(budget.not_monotone, ElementsAre(5));
  EXPECT_EQ(budget.failing, 0);
}

// Random seeds that keep and break the limit as they like: what is said of the budget holds.
TEST(BudgetSearch, HoldsWhereverSeedsAreNotMonotone) {
  for (std::uint64_t key = 0; key < 200; ++key) {
    BudgetQuestion question = question_of(60, {0.9, 0.9});
    question.levels = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    MadeUpWorlds worlds{[key](double level, std::uint64_t seed) {
      slam::RandomStream random(seed, slam::Stream::kWorld, 100 * key + static_cast<std::uint64_t>(level));
      return random.uniform() < 0.012 * level ? 2.0 : 1.0;
    }};
    const Budget budget = find_budget(question, std::ref(worlds));
    EXPECT_LE(budget.failing, budget.may_fail) << key;
    EXPECT_FALSE(worlds.asked_twice) << key;
    for (const std::uint64_t seed : budget.not_monotone) {
      double broken = HUGE_VAL, kept = -1.0;
      for (const BudgetRun& run : budget.runs)
        if (run.seed == seed)
          (run.value > 1.0 ? broken : kept) =
              run.value > 1.0 ? std::min(broken, run.level) : std::max(kept, run.level);
      EXPECT_LT(broken, kept) << key;
    }
  }
}

TEST(BudgetSearch, RefusesWhatItCannotAnswer) {
  EXPECT_THROW(find_budget(question_of(58), MadeUpWorlds{Spread{}}), std::runtime_error);
  BudgetQuestion one_level = question_of(59);
  one_level.levels = {1.0};
  EXPECT_THROW(find_budget(one_level, MadeUpWorlds{Spread{}}), std::invalid_argument);
  EXPECT_THROW(find_budget(question_of(59),
                           [](double, const std::vector<std::uint64_t>&) { return std::vector{1.0}; }),
               std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
