#include "harness/budget/budget_search.h"

#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <stdexcept>

namespace stereobench::harness {
namespace {

using Index = std::size_t;

/// Seeds that are run at once: part of what is found, so that it does not depend on the machine.
constexpr Index kChunk = 8;
constexpr Index kNever = std::numeric_limits<Index>::max();

/// What is known of one seed. Levels by their number, from good to bad.
struct KnownSeed {
  std::map<Index, double> values;  ///< by level
  std::optional<Index> kept_at;    ///< the worst level
  Index broken_at = kNever;        ///< the best level

  bool is_monotone() const { return !kept_at || *kept_at < broken_at; }
};

/// Whether a seed keeps the limit at a level, where that is known or follows.
enum class Verdict { kKeeps, kBreaks, kUnknown };

class BudgetSearch {
 public:
  BudgetSearch(const BudgetQuestion& question, const MetricAtLevel& run)
      : question_(question),
        run_(run),
        order_(question.too_many ? *question.too_many
                                 : order_of_seeds(std::ssize(question.seeds), question.wanted)),
        seeds_(question.seeds.size()) {
    if (question.levels.size() < 2) throw std::invalid_argument("a budget needs two levels or more");
  }

  Budget find();

 private:
  Verdict verdict(Index seed, Index level) const;
  long breaking(std::span<const Index> seeds, Index level) const;
  void run_at(Index level, std::span<const Index> seeds);
  bool too_many_break(Index level);
  bool holds_for_all(Index level);
  std::optional<Index> worst_level_for_searched(Index first_bad);
  void search_those_that_break(Index level);
  std::vector<Index> not_yet_run_at(Index level) const;
  Budget budget_at(Index level, BudgetOutcome outcome) const;

  const BudgetQuestion& question_;
  const MetricAtLevel& run_;
  long order_;                    ///< so many seeds that fail are too many
  std::vector<KnownSeed> seeds_;  ///< as in the question
  std::vector<Index> searched_;   ///< seeds whose thresholds are looked for
  std::vector<BudgetRun> runs_;
};

Verdict BudgetSearch::verdict(Index seed, Index level) const {
  const KnownSeed& known = seeds_[seed];
  if (const auto value = known.values.find(level); value != known.values.end())
    return keeps_limit(question_.limit, value->second) ? Verdict::kKeeps : Verdict::kBreaks;
  if (known.broken_at <= level) return Verdict::kBreaks;
  return known.kept_at && *known.kept_at >= level ? Verdict::kKeeps : Verdict::kUnknown;
}

long BudgetSearch::breaking(std::span<const Index> seeds, Index level) const {
  return std::ranges::count_if(seeds, [&](Index seed) { return verdict(seed, level) == Verdict::kBreaks; });
}

/// Runs up to a chunk of seeds.
void BudgetSearch::run_at(Index level, std::span<const Index> seeds) {
  std::vector<std::uint64_t> names;
  for (const Index seed : seeds) names.push_back(question_.seeds[seed]);
  const std::vector<double> values = run_(question_.levels[level], names);
  if (values.size() != seeds.size()) throw std::invalid_argument("a budget needs one value a seed");
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    KnownSeed& known = seeds_[seeds[i]];
    known.values[level] = values[i];
    runs_.push_back({question_.levels[level], names[i], values[i]});
    if (!keeps_limit(question_.limit, values[i]))
      known.broken_at = std::min(known.broken_at, level);
    else
      known.kept_at = std::max(known.kept_at.value_or(0), level);
  }
}

/// Whether too many of the searched seeds break the limit, by what is known as far as that goes.
bool BudgetSearch::too_many_break(Index level) {
  std::vector<Index> unknown;
  std::ranges::copy_if(searched_, std::back_inserter(unknown),
                       [&](Index seed) { return verdict(seed, level) == Verdict::kUnknown; });
  long breaks = breaking(searched_, level);
  for (std::span<const Index> left = unknown; breaks < order_ && breaks + std::ssize(left) >= order_;) {
    const std::span<const Index> chunk = left.first(std::min(kChunk, left.size()));
    run_at(level, chunk);
    breaks += breaking(chunk, level);
    left = left.subspan(chunk.size());
  }
  return breaks >= order_;
}

/// The seeds without a value at a level; first those that are not known to keep the limit at a worse one.
std::vector<Index> BudgetSearch::not_yet_run_at(Index level) const {
  std::vector<Index> seeds;
  for (Index seed = 0; seed < seeds_.size(); ++seed)
    if (!seeds_[seed].values.contains(level)) seeds.push_back(seed);
  std::stable_partition(seeds.begin(), seeds.end(),
                        [&](Index seed) { return verdict(seed, level) != Verdict::kKeeps; });
  return seeds;
}

/// Runs all seeds at a level, or until too many break the limit there. Nothing is taken to be so.
bool BudgetSearch::holds_for_all(Index level) {
  const std::vector<Index> seeds = not_yet_run_at(level);
  const auto breaks = [&] {
    return std::ranges::count_if(seeds_, [&](const KnownSeed& seed) {
      const auto value = seed.values.find(level);
      return value != seed.values.end() && !keeps_limit(question_.limit, value->second);
    });
  };
  for (std::span<const Index> left = seeds; !left.empty() && breaks() < order_;) {
    const std::span<const Index> chunk = left.first(std::min(kChunk, left.size()));
    run_at(level, chunk);
    left = left.subspan(chunk.size());
  }
  return breaks() < order_;
}

/// The worst level that not too many of the searched seeds break.
/// @param first_bad that too many of them break; the number of levels while none is searched
/// @return none: too many break the good end
std::optional<Index> BudgetSearch::worst_level_for_searched(Index first_bad) {
  if (searched_.empty()) return first_bad - 1;
  if (too_many_break(0)) return {};
  Index good = 0;
  for (Index bad = first_bad; bad - good > 1;) {
    const Index middle = good + (bad - good) / 2;
    (too_many_break(middle) ? bad : good) = middle;
  }
  return good;
}

void BudgetSearch::search_those_that_break(Index level) {
  for (Index seed = 0; seed < seeds_.size(); ++seed)
    if (verdict(seed, level) == Verdict::kBreaks && std::ranges::count(searched_, seed) == 0)
      searched_.push_back(seed);
}

Budget BudgetSearch::find() {
  Index first_bad = question_.levels.size();
  while (const std::optional<Index> level = worst_level_for_searched(first_bad)) {
    const bool is_bad_end = *level + 1 == question_.levels.size();
    if (holds_for_all(*level))
      return budget_at(*level, is_bad_end ? BudgetOutcome::kWholeRange : BudgetOutcome::kFound);
    search_those_that_break(*level);
    first_bad = *level;
  }
  const std::vector<Index> rest = not_yet_run_at(0);
  for (std::span<const Index> left = rest; !left.empty(); left = left.subspan(std::min(kChunk, left.size())))
    run_at(0, left.first(std::min(kChunk, left.size())));
  return budget_at(0, BudgetOutcome::kNone);
}

Budget BudgetSearch::budget_at(Index level, BudgetOutcome outcome) const {
  Budget budget;
  budget.outcome = outcome;
  budget.level = question_.levels[level];
  budget.may_fail = order_ - 1;
  budget.runs = runs_;
  budget.grid_runs = std::ssize(question_.levels) * std::ssize(question_.seeds);
  if (outcome == BudgetOutcome::kFound) budget.fails_at = question_.levels[level + 1];
  for (Index seed = 0; seed < seeds_.size(); ++seed) {
    const double value = seeds_[seed].values.at(level);
    budget.values.push_back(value);
    budget.failing += keeps_limit(question_.limit, value) ? 0 : 1;
    if (!seeds_[seed].is_monotone()) budget.not_monotone.push_back(question_.seeds[seed]);
  }
  return budget;
}

}  // namespace

bool keeps_limit(const Gate& limit, double value) {
  return limit.relation == Gate::Relation::kAtMost ? value <= limit.limit : value >= limit.limit;
}

Budget find_budget(const BudgetQuestion& question, const MetricAtLevel& run) {
  return BudgetSearch(question, run).find();
}

}  // namespace stereobench::harness
