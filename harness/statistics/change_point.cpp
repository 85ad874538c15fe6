#include "harness/statistics/change_point.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

constexpr std::size_t kMostForAllFlips = 14;
constexpr std::size_t kFlips = 99'999;
constexpr std::size_t kEnoughAsLarge = 20;

/// Sums in another order differ in their last bits.
constexpr double kAsLarge = 1.0 - 1e-9;

/// Ranks from 1; equal values share their mean rank.
std::vector<double> mean_ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = 0.5 * static_cast<double>(begin + 1 + end);
    begin = end;
  }
  return ranks;
}

/// For each place, the correlation of the seed's ranks with a step there; zeros where all values are equal.
std::vector<double> rank_cusum(const Series& series) {
  const auto count = static_cast<double>(series.size());
  const std::vector<double> ranks = mean_ranks(series);
  double squares = 0.0;
  for (const double rank : ranks) squares += (rank - 0.5 * (count + 1.0)) * (rank - 0.5 * (count + 1.0));
  std::vector<double> cusum;
  double sum = 0.0;
  for (std::size_t place = 1; place < series.size(); ++place) {
    sum += ranks[place - 1] - 0.5 * (count + 1.0);
    const auto before = static_cast<double>(place);
    cusum.push_back(squares > 0.0 ? -sum * std::sqrt(count / (before * (count - before) * squares)) : 0.0);
  }
  return cusum;
}

/// Each seed's rank of the size of its difference between two results, with the sign of the difference.
std::vector<double> signed_ranks(std::span<const Series> seeds, std::size_t place) {
  std::vector<double> sizes;
  for (const Series& series : seeds) sizes.push_back(std::abs(series[place] - series[place - 1]));
  const auto unchanged = static_cast<double>(std::ranges::count(sizes, 0.0));
  std::vector<double> ranks = mean_ranks(sizes);
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const double difference = seeds[i][place] - seeds[i][place - 1];
    ranks[i] = difference == 0.0 ? 0.0 : std::copysign(ranks[i] - unchanged, difference);
  }
  return ranks;
}

/// What each seed adds to each statistic.
struct Shares {
  std::vector<std::vector<double>> of_seed;  ///< of each seed: neighbours at all places, then CUSUMs at all
  std::vector<double> cusum;                 ///< their sum over the seeds, by place

  std::size_t places() const { return cusum.size(); }
};

/// Scales each statistic so that its shares' squares add up to 1.
void scale(Shares& shares) {
  for (std::size_t i = 0; i < 2 * shares.places(); ++i) {
    double squares = 0.0;
    for (const std::vector<double>& seed : shares.of_seed) squares += seed[i] * seed[i];
    if (squares > 0.0)
      for (std::vector<double>& seed : shares.of_seed) seed[i] /= std::sqrt(squares);
  }
}

Shares shares_of(std::span<const Series> seeds) {
  const std::size_t places = seeds.front().size() - 1;
  Shares shares{.of_seed = std::vector(seeds.size(), std::vector<double>(2 * places)),
                .cusum = std::vector<double>(places)};
  for (std::size_t place = 0; place < places; ++place) {
    const std::vector<double> ranks = signed_ranks(seeds, place + 1);
    for (std::size_t i = 0; i < seeds.size(); ++i) shares.of_seed[i][place] = ranks[i];
  }
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const std::vector<double> cusum = rank_cusum(seeds[i]);
    for (std::size_t place = 0; place < places; ++place) {
      shares.of_seed[i][places + place] = cusum[place];
      shares.cusum[place] += cusum[place];
    }
  }
  scale(shares);
  return shares;
}

/// Sums over the seeds of what each adds to each statistic, with the signs of some seeds flipped. Eight seeds
/// at a time have all their sums in a table.
class FlippedSums {
 public:
  explicit FlippedSums(const Shares& shares)
      : sums_(2 * shares.places()), tables_((shares.of_seed.size() + kSeedsOfTable - 1) / kSeedsOfTable) {
    for (std::size_t table = 0; table < tables_.size(); ++table)
      for (std::size_t flips = 0; flips < kSumsOfTable; ++flips)
        tables_[table].push_back(sum_of(shares, table * kSeedsOfTable, flips));
  }

  /// @param flipped a byte for each table, a bit for each seed
  /// @return the sizes of all statistics
  const std::vector<double>& operator()(std::span<const std::uint8_t> flipped) {
    std::ranges::fill(sums_, 0.0);
    for (std::size_t table = 0; table < tables_.size(); ++table) {
      const std::vector<double>& sum = tables_[table][flipped[table]];
      for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += sum[i];
    }
    for (double& sum : sums_) sum = std::abs(sum);
    return sums_;
  }

  std::size_t tables() const { return tables_.size(); }

 private:
  static constexpr std::size_t kSeedsOfTable = 8;
  static constexpr std::size_t kSumsOfTable = 256;

  std::vector<double> sum_of(const Shares& shares, std::size_t first, std::size_t flips) const {
    std::vector<double> sum(sums_.size());
    const std::size_t end = std::min(first + kSeedsOfTable, shares.of_seed.size());
    for (std::size_t seed = first; seed < end; ++seed)
      for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] += (flips >> (seed - first) & 1U) != 0 ? -shares.of_seed[seed][i] : shares.of_seed[seed][i];
    return sum;
  }

  std::vector<double> sums_;
  std::vector<std::vector<std::vector<double>>> tables_;
};

/// Which seeds are flipped: all ways in turn where they are few, else drawn ones.
class Flips {
 public:
  Flips(std::size_t seeds, std::size_t tables)
      : are_all_(seeds <= kMostForAllFlips),
        count_(are_all_ ? std::size_t{1} << (seeds - 1) : kFlips),
        random_(0, slam::Stream::kResample, seeds),
        flipped_(tables) {}

  bool are_all() const { return are_all_; }
  std::size_t count() const { return count_; }

  /// A bit for each seed, the first seed's the lowest of the first byte.
  std::span<const std::uint8_t> next() {
    std::uint32_t bits = number_++;
    for (std::size_t i = 0; i < flipped_.size(); ++i, bits >>= 8U) {
      if (!are_all_ && i % 4 == 0) bits = random_.bits();
      flipped_[i] = static_cast<std::uint8_t>(bits & 0xffU);
    }
    return flipped_;
  }

 private:
  bool are_all_;
  std::size_t count_;
  slam::RandomStream random_;
  std::vector<std::uint8_t> flipped_;
  std::uint32_t number_ = 0;
};

/// The largest statistics of flipped seeds, sorted, and how many flips there were in place of all.
struct Chance {
  std::vector<double> largest;
  bool adds_one = false;  ///< drawn to the end: what is seen counts as one of them

  double p_of(double statistic) const {
    const auto as_large = largest.end() - std::ranges::lower_bound(largest, statistic * kAsLarge);
    const double more = adds_one ? 1.0 : 0.0;
    return (static_cast<double>(as_large) + more) / (static_cast<double>(largest.size()) + more);
  }
};

Chance chance_of(FlippedSums& sums, std::size_t seeds, double largest) {
  Flips flips(seeds, sums.tables());
  Chance chance;
  std::size_t as_large = 0;
  while (chance.largest.size() < flips.count() && (flips.are_all() || as_large < kEnoughAsLarge)) {
    chance.largest.push_back(std::ranges::max(sums(flips.next())));
    if (chance.largest.back() >= largest * kAsLarge) ++as_large;
  }
  chance.adds_one = !flips.are_all() && as_large < kEnoughAsLarge;
  std::ranges::sort(chance.largest);
  return chance;
}

/// Seeds that are the same in all results say nothing of a change.
std::vector<Series> that_changed(std::span<const Series> seeds) {
  std::vector<Series> changed;
  for (const Series& series : seeds) {
    if (series.size() < 2 || series.size() != seeds.front().size())
      throw std::invalid_argument("find_change: expected series of one length of 2 or more");
    if (std::ranges::count(series, series.front()) < std::ssize(series)) changed.push_back(series);
  }
  return changed;
}

std::vector<Series> part_of(std::span<const Series> seeds, std::size_t begin, std::size_t end) {
  std::vector<Series> part;
  for (const Series& series : seeds)
    part.emplace_back(series.begin() + static_cast<std::ptrdiff_t>(begin),
                      series.begin() + static_cast<std::ptrdiff_t>(end));
  return part;
}

struct Part {
  std::size_t begin = 0;
  std::size_t end = 0;
  double level = 0.0;
  double parted = 1.0;  ///< 2 for each time that the series was parted
};

void search(std::span<const Series> seeds, const Part& part, std::vector<ChangePoint>& found) {
  if (part.end - part.begin < 2) return;
  const ChangePoint change = find_change(part_of(seeds, part.begin, part.end), part.level);
  if (!(change.p < part.level)) return;
  const std::size_t place = part.begin + change.place;
  search(seeds, {part.begin, place, 0.5 * part.level, 2.0 * part.parted}, found);
  found.push_back({place, std::min(1.0, change.p * part.parted)});
  search(seeds, {place, part.end, 0.5 * part.level, 2.0 * part.parted}, found);
}

}  // namespace

ChangePoint find_change(std::span<const Series> seeds, double level) {
  const std::vector<Series> changed = that_changed(seeds);
  if (changed.empty()) return {};
  const Shares shares = shares_of(changed);
  FlippedSums sums_of(shares);
  const std::vector<double> sums = sums_of(std::vector<std::uint8_t>(sums_of.tables()));
  const Chance chance = chance_of(sums_of, changed.size(), std::ranges::max(sums));
  std::vector<ChangePoint> places;
  for (std::size_t i = 0; i < shares.places(); ++i)
    places.push_back({i + 1, chance.p_of(std::max(sums[i], sums[shares.places() + i]))});
  const double most = std::max(level, std::ranges::min(places, {}, &ChangePoint::p).p);
  std::erase_if(places, [&](const ChangePoint& place) { return place.p > most; });
  return std::ranges::max(places, {},
                          [&](const ChangePoint& place) { return std::abs(shares.cusum[place.place - 1]); });
}

std::vector<ChangePoint> find_changes(std::span<const Series> seeds, double level) {
  std::vector<ChangePoint> found;
  if (!seeds.empty()) search(seeds, {0, seeds.front().size(), level, 1.0}, found);
  return found;
}

long fewest_seeds_for(double level) {
  long seeds = 1;
  for (double p = 1.0; p >= level; p *= 0.5) ++seeds;
  return seeds;
}

}  // namespace stereobench::harness
