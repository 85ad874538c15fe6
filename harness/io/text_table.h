/// Tables for terminals and for Markdown pages.
#pragma once

#include <string>
#include <vector>

namespace stereobench::harness {

/// Rows of cells below a header. Cells are UTF-8; the first column is left-aligned, the others right.
struct AlignedTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header
};

/// Aligns the columns with spaces. @throws std::invalid_argument when a row is not as long as the header
std::string plain_text(const AlignedTable& table);

/// Writes a pipe table; `|` in cells is escaped. @throws std::invalid_argument as above
std::string markdown(const AlignedTable& table);

/// @return the value to so many significant digits in plain notation where that is short; "-" when not finite
std::string format_number(double value, int digits = 3);

/// What "+-" means wherever it is printed.
inline constexpr const char* kIntervalNote =
    "+- is the half width of the 95 % interval of the mean over seeds (Student's t).";

/// @param half_width of the 95 % interval of the mean
/// @return "mean +- half width", both to the decimals of the half width's two significant digits; the mean
/// alone when the half width is not known; "-" when the mean is not finite
std::string format_interval(double mean, double half_width);

/// @return "value (sd 0.12)", both to the decimals of the sd's two significant digits; the value alone for an
/// sd of zero; "-" when the value is not finite
std::string format_with_sd(double value, double sd);

}  // namespace stereobench::harness
