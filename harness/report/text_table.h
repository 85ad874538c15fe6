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

/// @return "mean +- sd", both to the decimals of the sd's two significant digits; "-" when the mean is not
/// finite
std::string format_mean_sd(double mean, double sd);

}  // namespace stereobench::harness
