#include "harness/io/text_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace stereobench::harness {
namespace {

/// How many characters a UTF-8 text shows: its bytes without the continuation bytes.
std::size_t shown_length(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

void check(const AlignedTable& table) {
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() != table.header.size()) {
      throw std::invalid_argument(
          fmt::format("a table row has {} cells below a header of {}", row.size(), table.header.size()));
    }
  }
}

std::vector<std::size_t> column_widths(const AlignedTable& table) {
  std::vector<std::size_t> widths(table.header.size(), 3);
  for (std::size_t column = 0; column < widths.size(); ++column) {
    widths[column] = std::max(widths[column], shown_length(table.header[column]));
    for (const auto& row : table.rows) widths[column] = std::max(widths[column], shown_length(row[column]));
  }
  return widths;
}

std::string padded(const std::string& cell, std::size_t width, bool to_the_left) {
  const std::string blanks(width - shown_length(cell), ' ');
  return to_the_left ? cell + blanks : blanks + cell;
}

/// Cells of one line between two texts, the first column to the left, the others to the right.
std::string join(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                 const std::string& between) {
  std::string line;
  for (std::size_t column = 0; column < cells.size(); ++column) {
    line += (column == 0 ? "" : between) + padded(cells[column], widths[column], column == 0);
  }
  return line;
}

std::string without_trailing_blanks(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

/// A value and its uncertainty to the decimals of the latter's two significant digits.
/// @return an empty second text when the uncertainty is not known, or nothing is uncertain
std::pair<std::string, std::string> format_alike(double value, double uncertainty) {
  constexpr double kMostDecimals = 6.0;
  if (!std::isfinite(value) || !std::isfinite(uncertainty) || !(uncertainty > 0.0))
    return {format_number(value), ""};
  const double wanted = 1.0 - std::floor(std::log10(uncertainty));
  if (wanted > kMostDecimals) return {format_number(value), format_number(uncertainty, 2)};
  const int decimals = static_cast<int>(std::max(wanted, 0.0));
  return {fmt::format("{:.{}f}", value, decimals), fmt::format("{:.{}f}", uncertainty, decimals)};
}

AlignedTable with_pipes_escaped(AlignedTable table) {
  const auto escape = [](std::string& cell) {
    for (std::size_t at = 0; (at = cell.find('|', at)) != std::string::npos; at += 2)
      cell.insert(at, 1, '\\');
  };
  std::for_each(table.header.begin(), table.header.end(), escape);
  for (auto& row : table.rows) std::for_each(row.begin(), row.end(), escape);
  return table;
}

}  // namespace

std::string plain_text(const AlignedTable& table) {
  check(table);
  const std::vector<std::size_t> widths = column_widths(table);
  std::vector<std::string> rules;
  for (const std::size_t width : widths) rules.emplace_back(width, '-');
  std::string text = without_trailing_blanks(join(table.header, widths, "  ")) + "\n";
  text += join(rules, widths, "  ") + "\n";
  for (const auto& row : table.rows) text += without_trailing_blanks(join(row, widths, "  ")) + "\n";
  return text;
}

std::string markdown(const AlignedTable& unescaped) {
  check(unescaped);
  const AlignedTable table = with_pipes_escaped(unescaped);
  const std::vector<std::size_t> widths = column_widths(table);
  std::vector<std::string> rules;
  for (std::size_t column = 0; column < widths.size(); ++column) {
    rules.push_back(std::string(widths[column] - 1, '-') + (column == 0 ? "-" : ":"));
  }
  std::string text = "| " + join(table.header, widths, " | ") + " |\n";
  text += "| " + join(rules, widths, " | ") + " |\n";
  for (const auto& row : table.rows) text += "| " + join(row, widths, " | ") + " |\n";
  return text;
}

std::string format_number(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const double magnitude = std::floor(std::log10(std::abs(value)));
  if (magnitude < -4.0 || magnitude > 6.0) return fmt::format("{:.{}e}", value, digits - 1);
  return fmt::format("{:.{}f}", value, std::max(0, digits - 1 - static_cast<int>(magnitude)));
}

std::string format_interval(double mean, double half_width) {
  const auto [value, uncertainty] = format_alike(mean, half_width);
  return uncertainty.empty() ? value : value + " +- " + uncertainty;
}

std::string format_with_sd(double value, double sd) {
  const auto [text, uncertainty] = format_alike(value, sd);
  return uncertainty.empty() ? text : text + " (sd " + uncertainty + ")";
}

}  // namespace stereobench::harness
