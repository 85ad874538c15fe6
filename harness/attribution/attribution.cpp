#include "harness/attribution/attribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "harness/attribution/shapley.h"
#include "harness/io/text_table.h"
#include "harness/json/json_numbers.h"
#include "harness/run/metric_keys.h"
#include "harness/run/run_result.h"

namespace stereobench::harness {
namespace {

using Json = nlohmann::ordered_json;

/// A metric that is shared among the parts.
struct SharedMetric {
  std::string_view name;
  std::string_view bound;  ///< its name; of a square itself, whose least value is 1, there is none
  bool is_square = false;
};

constexpr std::array<SharedMetric, 3> kShared = {
    {{"ate_rms_m", "bound.pose_rms_m"}, {"landmark_rms_m", "bound.landmark_rms_m"}, {"anees", "", true}}};

std::vector<double> values_of(const SeedMetrics& metrics, const std::string& name, std::size_t seeds) {
  const auto found = metrics.find(name);
  if (found != metrics.end()) return found->second;
  return std::vector<double>(seeds, std::numeric_limits<double>::quiet_NaN());
}

/// The parts whose errors are no noise.
Coalition biased_parts(const std::vector<Oracle>& oracles) {
  Coalition biased = 0;
  for (std::size_t i = 0; i < oracles.size(); ++i)
    if (!oracles[i].is_noise) biased |= Coalition{1} << i;
  return biased;
}

/// Squares of errors by coalition, each with one a seed.
using Squares = std::vector<std::vector<double>>;

Squares squares_of(const std::string& name, bool is_square, const std::vector<SeedMetrics>& metrics,
                   std::size_t seeds) {
  Squares squares;
  for (const SeedMetrics& of_coalition : metrics) {
    squares.push_back(values_of(of_coalition, name, seeds));
    if (!is_square)
      for (double& value : squares.back()) value *= value;
  }
  return squares;
}

/// The share of the squares of a filter's errors that a perfect estimator would have too, over the seeds that
/// have both; NaN where none has.
double least_share(const std::vector<double>& bounds, const std::vector<double>& noisy) {
  double bound = 0.0;
  double error = 0.0;
  for (std::size_t seed = 0; seed < noisy.size(); ++seed) {
    if (!std::isfinite(bounds[seed]) || !std::isfinite(noisy[seed])) continue;
    bound += bounds[seed];
    error += noisy[seed];
  }
  return bound / error;
}

/// Adds the coalitions in which the estimator is perfect, too: see attribution_of.
void add_estimator(double share, Coalition biased, Squares& squares) {
  const std::size_t without = squares.size();
  for (Coalition perfect = 0; perfect < without; ++perfect) {
    std::vector<double> best;
    for (std::size_t seed = 0; seed < squares.front().size(); ++seed) {
      const double left = squares[perfect][seed] - (1.0 - share) * squares[perfect | biased][seed];
      best.push_back(left < 0.0 ? 0.0 : left);
    }
    squares.push_back(std::move(best));
  }
}

/// Leaves out, of each coalition, the seeds that lack a value in any.
/// @return how many those are
std::size_t keep_whole_seeds(Squares& squares) {
  std::vector<bool> is_whole(squares.front().size(), true);
  for (const std::vector<double>& of_coalition : squares)
    for (std::size_t seed = 0; seed < of_coalition.size(); ++seed)
      if (!std::isfinite(of_coalition[seed])) is_whole[seed] = false;
  for (std::vector<double>& of_coalition : squares) {
    std::vector<double> kept;
    for (std::size_t seed = 0; seed < of_coalition.size(); ++seed)
      if (is_whole[seed]) kept.push_back(of_coalition[seed]);
    of_coalition = std::move(kept);
  }
  return static_cast<std::size_t>(std::ranges::count(is_whole, false));
}

AttributedMetric attributed(const std::string& filter, const SharedMetric& shared,
                            const std::vector<Oracle>& oracles, const std::vector<SeedMetrics>& metrics,
                            std::size_t seeds) {
  AttributedMetric metric{
      .filter = filter, .metric = std::string(shared.name), .unit = unit_of(std::string(shared.name))};
  const Coalition biased = biased_parts(oracles);
  Squares errors =
      squares_of(fmt::format("filters.{}.{}", filter, shared.name), shared.is_square, metrics, seeds);
  const Squares bounds = shared.is_square
                             ? Squares{std::vector<double>(seeds, 1.0)}
                             : squares_of(std::string(shared.bound), false, {metrics[biased]}, seeds);
  std::vector<std::string> parts;
  for (const Oracle& oracle : oracles) parts.push_back(oracle.part);
  if (const double share = least_share(bounds.front(), errors[biased]); std::isfinite(share)) {
    add_estimator(share, biased, errors);
    parts.push_back(kEstimator);
  }
  if (parts.empty()) return metric;
  metric.seeds_left_out = keep_whole_seeds(errors);
  if (!shared.is_square)
    for (std::vector<double>& of_coalition : errors)
      for (double& value : of_coalition) value = std::sqrt(value);
  metric.real = summarise(errors.front());
  metric.perfect = summarise(errors.back());
  const std::vector<PartWorth> worths = attribute(errors);
  for (std::size_t i = 0; i < parts.size(); ++i)
    metric.parts.push_back({parts[i], summarise(worths[i].share), summarise(worths[i].only_perfect),
                            summarise(worths[i].only_real)});
  return metric;
}

std::string with_half_width(const Summary& summary) {
  return format_interval(summary.mean, summary.half_width);
}

/// "41 %" of what all parts take away together; "-" where that is nothing.
std::string part_of_whole(const Summary& share, const AttributedMetric& metric) {
  const double whole = metric.real.mean - metric.perfect.mean;
  return whole > 0.0 && std::isfinite(share.mean) ? fmt::format("{:.0f} %", 100.0 * share.mean / whole) : "-";
}

std::string table_of(const AttributedMetric& metric) {
  const std::string unit = metric.unit.empty() ? "" : fmt::format(" [{}]", metric.unit);
  AlignedTable table{.header = {"part", "share" + unit + " +- 95 %", "of the whole",
                                "gone if it alone is perfect", "left if it alone is real"},
                     .rows = {}};
  for (const PartSummary& part : metric.parts)
    table.rows.push_back({part.part, with_half_width(part.share), part_of_whole(part.share, metric),
                          with_half_width(part.only_perfect), with_half_width(part.only_real)});
  const std::string left_out =
      metric.seeds_left_out == 0
          ? std::string()
          : fmt::format(" ({} of the seeds left out: runs without a value)", metric.seeds_left_out);
  return fmt::format("{} {}{}: {} as it is, {} with all parts perfect{}\n{}", metric.filter, metric.metric,
                     unit, with_half_width(metric.real), with_half_width(metric.perfect), left_out,
                     plain_text(table));
}

Json part_json(const PartSummary& part) {
  return {{"part", part.part},
          {"share", summary_json(part.share)},
          {"only_perfect", summary_json(part.only_perfect)},
          {"only_real", summary_json(part.only_real)}};
}

}  // namespace

std::vector<std::vector<std::string>> coalition_lines(const std::vector<Oracle>& oracles) {
  std::vector<std::vector<std::string>> coalitions(Coalition{1} << oracles.size());
  for (Coalition perfect = 0; perfect < coalitions.size(); ++perfect)
    for (std::size_t i = 0; i < oracles.size(); ++i)
      if ((perfect >> i & 1U) != 0)
        coalitions[perfect].insert(coalitions[perfect].end(), oracles[i].set.begin(), oracles[i].set.end());
  return coalitions;
}

Attribution attribution_of(const std::string& scenario, const std::vector<std::uint64_t>& seeds,
                           const std::vector<Oracle>& oracles, const std::vector<std::string>& filters,
                           const std::vector<SeedMetrics>& metrics) {
  Attribution attribution{.scenario = scenario, .seeds = seeds, .parts = oracles, .metrics = {}};
  attribution.parts.push_back({kEstimator, "the filter reaches the Cramer-Rao bound", {}});
  for (const std::string& filter : filters) {
    if (filter == kBaseline) continue;
    for (const SharedMetric& shared : kShared) {
      AttributedMetric metric = attributed(filter, shared, oracles, metrics, seeds.size());
      if (metric.real.count > 0) attribution.metrics.push_back(std::move(metric));
    }
  }
  return attribution;
}

std::string seeds_in_words(std::size_t seeds) {
  return fmt::format("{} seed{}", seeds, seeds == 1 ? "" : "s");
}

std::string attribution_table(const Attribution& attribution) {
  std::string tables;
  for (const AttributedMetric& metric : attribution.metrics)
    tables += (tables.empty() ? "" : "\n") + table_of(metric);
  return tables;
}

nlohmann::ordered_json attribution_json(const Attribution& attribution) {
  Json parts = Json::array();
  for (const Oracle& part : attribution.parts)
    parts.push_back({{"part", part.part}, {"perfect", part.says}, {"set", part.set}});
  Json metrics = Json::array();
  for (const AttributedMetric& metric : attribution.metrics) {
    metrics.push_back({{"filter", metric.filter},
                       {"metric", metric.metric},
                       {"real", summary_json(metric.real)},
                       {"perfect", summary_json(metric.perfect)},
                       {"seeds_left_out", metric.seeds_left_out},
                       {"parts", Json::array()}});
    for (const PartSummary& part : metric.parts) metrics.back()["parts"].push_back(part_json(part));
  }
  return {{"schema", 1},
          {"scenario", attribution.scenario},
          {"seeds", attribution.seeds},
          {"parts", std::move(parts)},
          {"metrics", std::move(metrics)}};
}

}  // namespace stereobench::harness
