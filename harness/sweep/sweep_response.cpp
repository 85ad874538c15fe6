#include "harness/sweep/sweep_response.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "harness/experiment/key_kind.h"
#include "harness/sweep/adaptive.h"

namespace stereobench::harness {
namespace {

/// To 12 digits: 0.1224 - 0.12 is 0.0024.
double rounded(double level) {
  return numbers_of({{"level"}, {fmt::format("{:.12g}", level)}}).front();
}

/// Whether levels are far enough apart to tell an error that grows with them from one that stays.
bool span_an_octave(const std::vector<double>& levels) {
  return levels.back() >= 2.0 * levels.front();
}

/// The levels of a sweep; empty where its values are no numbers.
std::vector<double> levels_of(const SweepResult& sweep) {
  try {
    std::vector<double> levels = numbers_of(sweep.variations.front());
    if (sweep.paired_to) {
      const double origin = numbers_of({{"--paired-to"}, {*sweep.paired_to}}).front();
      for (double& level : levels) level = rounded(level - origin);
    }
    return levels;
  } catch (const std::runtime_error&) {
    return {};
  }
}

ResponseCurve curve_of_filter(const SweepResult& sweep, std::size_t filter) {
  ResponseCurve curve{.name = sweep.cells.front().result.filters[filter].filter, .values = {}};
  for (const SweepCell& cell : sweep.cells) curve.values.push_back(cell.ate_m[filter]);
  return curve;
}

}  // namespace

std::optional<Response> response_of(const SweepResult& sweep) {
  constexpr std::size_t kFewestLevels = 3;
  if (sweep.variations.size() != 1 || sweep.variations.front().keys.size() != 1) return {};
  if (takes_whole_numbers(sweep.variations.front().keys.front())) return {};
  const std::vector<double> levels = levels_of(sweep);
  const bool ascends = std::ranges::adjacent_find(levels, std::greater_equal<>()) == levels.end();
  if (levels.size() < kFewestLevels || levels.front() < 0.0 || !ascends || !span_an_octave(levels)) return {};
  const std::string& key = sweep.variations.front().keys.front();
  Response response{.parameter = sweep.paired_to ? fmt::format("{} - {}", key, *sweep.paired_to) : key,
                    .levels = levels,
                    .filters = {},
                    .bound = {.name = "bound", .values = {}}};
  for (std::size_t i = 0; i < sweep.cells.front().ate_m.size(); ++i)
    response.filters.push_back(curve_of_filter(sweep, i));
  const bool has_bound = std::ranges::none_of(
      sweep.cells, [](const SweepCell& cell) { return cell.bound_m.size() != cell.ate_m.front().size(); });
  if (has_bound)
    for (const SweepCell& cell : sweep.cells) response.bound.values.push_back(cell.bound_m);
  return response;
}

}  // namespace stereobench::harness
