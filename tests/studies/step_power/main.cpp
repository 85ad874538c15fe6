/// How often `history` finds a step in drawn histories of one metric, and how often it finds one where there
/// is none.
#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/io/text_table.h"
#include "harness/statistics/change_point.h"
#include "tests/harness/statistics/drawn_history.h"

namespace stereobench::harness {
namespace {

/// Among some histories.
struct Counts {
  long any = 0;      ///< with a step
  long right = 0;    ///< with one at the right place
  long further = 0;  ///< steps elsewhere
};

Counts count_steps(const DrawnHistory& kind, long histories, double level) {
  Counts counts;
  for (long i = 0; i < histories; ++i) {
    const std::vector<ChangePoint> found =
        find_changes(draw_history(kind, static_cast<std::uint64_t>(i)), level);
    const bool is_right = std::ranges::count(found, kind.at, &ChangePoint::place) > 0;
    counts.any += found.empty() ? 0 : 1;
    counts.right += is_right ? 1 : 0;
    counts.further += std::ssize(found) - (is_right ? 1 : 0);
  }
  return counts;
}

std::string share(long count, long histories) {
  return fmt::format("{:.3f}", static_cast<double>(count) / static_cast<double>(histories));
}

/// Found at all, found at the right place, further steps a history.
std::string power_cell(DrawnHistory kind, std::size_t at, long histories) {
  kind.step = 1.2;
  kind.at = at;
  const Counts counts = count_steps(kind, histories, 0.01);
  return fmt::format("{} / {} / {}", share(counts.any, histories), share(counts.right, histories),
                     share(counts.further, histories));
}

std::vector<std::string> row_of(const DrawnHistory& kind, long histories) {
  constexpr long kMoreWithoutStep = 5;  // these take little time
  const long without = kMoreWithoutStep * histories;
  return {kind.changes < 1.0 ? "one in five" : "all",
          fmt::format("{:g} %", 100.0 * kind.noise),
          fmt::format("{}", kind.seeds),
          fmt::format("{}", kind.results),
          share(count_steps(kind, without, 0.05).any, without),
          share(count_steps(kind, without, 0.01).any, without),
          power_cell(kind, kind.results / 2, histories),
          power_cell(kind, kind.results - 1, histories)};
}

int run_study(long histories) {
  AlignedTable table{.header = {"results with new numbers", "noise", "seeds", "results",
                                "false alarms at 5 %", "at 1 %", "+20 % in the middle",
                                "+20 % in the last result"}};
  for (const double changes : {1.0, 0.2})
    for (const double noise : {0.3, 0.1})
      for (const std::size_t seeds : {std::size_t{10}, std::size_t{20}})
        for (const std::size_t results : {std::size_t{2}, std::size_t{6}, std::size_t{20}})
          table.rows.push_back(
              row_of({.seeds = seeds, .results = results, .noise = noise, .changes = changes}, histories));
  fmt::print("{}", markdown(table));
  return 0;
}

}  // namespace
}  // namespace stereobench::harness

int main(int argc, char** argv) {
  CLI::App program("How often history finds a step in drawn histories, and one where there is none.");
  long histories = 200;
  program.add_option("--histories", histories, "of each kind with a step; five times as many without")
      ->capture_default_str();
  CLI11_PARSE(program, argc, argv);
  return stereobench::harness::run_study(histories);
}
