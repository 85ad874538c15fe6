/// Lines of a scenario that get worse: from where to where, and in which steps.
#pragma once

#include <string>
#include <vector>

namespace stereobench::harness {

/// A line of the scenario, from its good to its bad end.
struct BudgetRange {
  std::string key;  ///< e.g. "detector_noise.centre_sd_px"
  double low = 0.0;
  double high = 1.0;      ///< not low; below it where less is worse
  bool is_whole = false;  ///< it takes whole numbers only
};

/// Lines that get worse together: each by the same fraction of its range. Of one line, a level is its value;
/// of several, a level is that fraction.
using BudgetMix = std::vector<BudgetRange>;

/// Reads "KEY=LOW..HIGH".
/// @throws std::runtime_error that begins with "--vary: " and says what was expected: no key, an end that is
///   no number, ends that are the same in their first nine digits
BudgetRange parse_budget_range(const std::string& text);

/// The levels that a budget may be, from the good end to the bad one, both included.
///
/// They are round numbers: multiples of 1, 2 or 5 times a power of ten, so that one that is printed is the
/// one that was run. Neighbours are no farther apart than a share of the level's distance from the good end,
/// or from zero where that is nearer, or than a ten-thousandth of the range where that is more.
/// @param mix one range or more; of several, the levels are those of fractions from 0 to 1
/// @param tolerance that share, in [0.001, 0.5]
/// @throws std::invalid_argument when the mix is empty or the tolerance is not in that range;
///   std::runtime_error as parse_budget_range, and where a line takes whole numbers and its ends are none
std::vector<double> budget_levels(const BudgetMix& mix, double tolerance);

/// What a level makes of a line of a mix, to nine digits; a whole number is rounded to the good end.
double value_at(const BudgetMix& mix, const BudgetRange& range, double level);

/// A level of a mix as overrides of the scenario: "key=value" for each line.
std::vector<std::string> overrides_at(const BudgetMix& mix, double level);

/// "a" or "a and b" or "a, b and c together".
std::string name_of(const BudgetMix& mix);

}  // namespace stereobench::harness
