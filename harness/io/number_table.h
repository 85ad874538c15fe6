/// Tables of numbers in text files, plain or gzip-compressed, read strictly: whatever is not exactly
/// what is expected is an error that names file, line and column.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stereobench::harness {

/// The number that a whole text is, whatever the locale.
/// @return none for other texts, and for what is not finite
std::optional<double> finite_number_in(std::string_view text);

/// One line of a table.
struct TableRow {
  long line = 0;  ///< in the file, from 1
  std::vector<std::string> cells;
};

/// A table as text: every row has as many cells as there are columns.
struct NumberTable {
  std::filesystem::path file;
  std::vector<std::string> columns;
  std::vector<TableRow> rows;
};

/// The file of a name, or the one with `.gz` added.
/// @return nothing when neither exists
std::optional<std::filesystem::path> find_plain_or_gz(const std::filesystem::path& path);

/// The same of a file that must be there. @throws std::runtime_error when neither exists
std::filesystem::path require_plain_or_gz(const std::filesystem::path& path);

/// Reads comma-separated values below a header line.
/// @param file plain or gzip
/// @param headers the header lines that are allowed, e.g. "t_s,v_mps,w_radps"
/// @throws std::runtime_error for a file that cannot be read, another header, or another number of fields
NumberTable read_csv_table(const std::filesystem::path& file, const std::vector<std::string>& headers);

/// Reads columns separated by blanks; lines that begin with `#` are comments, empty lines are skipped.
/// @param columns their names, for messages
NumberTable read_blank_separated_table(const std::filesystem::path& file,
                                       const std::vector<std::string>& columns);

/// Reads columns separated by commas; comments, empty lines and a header are skipped, and cells behind the
/// columns are left out.
/// @param columns their names, for messages
NumberTable read_comma_separated_table(const std::filesystem::path& file,
                                       const std::vector<std::string>& columns);

/// The first line of a file, plain or gzip, that is neither empty nor a comment; empty where there is none.
std::string first_row(const std::filesystem::path& file);

/// A cell as a finite number.
double number_in(const NumberTable& table, const TableRow& row, std::size_t column);

/// A cell as a whole number of at least `smallest`.
int whole_number_in(const NumberTable& table, const TableRow& row, std::size_t column, int smallest);

/// A cell as a seed: a whole number from 0 to 2^64 - 1.
std::uint64_t seed_in(const NumberTable& table, const TableRow& row, std::size_t column);

/// A cell in seconds as nanoseconds, exact for decimals of up to nine places.
std::int64_t stamp_ns_in(const NumberTable& table, const TableRow& row, std::size_t column);

/// A cell that is a whole number of nanoseconds.
std::int64_t nanoseconds_in(const NumberTable& table, const TableRow& row, std::size_t column);

/// Ends the reading: "file:line: column: what was expected".
[[noreturn]] void refuse(const NumberTable& table, const TableRow& row, std::size_t column,
                         std::string_view expectation);

}  // namespace stereobench::harness
