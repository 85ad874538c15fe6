#include "harness/io/number_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zlib.h>

namespace stereobench::harness {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;  // a larger log is a mistake or a gzip bomb
constexpr std::size_t kMaxQuoted = 40;

/// What a file said, made fit for one line of a message.
std::string in_quotes(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text.substr(0, kMaxQuoted)) {
    const bool printable = c >= ' ' && c <= '~';
    quoted += printable ? c : '?';
  }
  return quoted + (text.size() > kMaxQuoted ? "...'" : "'");
}

[[noreturn]] void fail_at(const fs::path& file, long line, std::string_view what) {
  throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), line, what));
}

[[noreturn]] void fail(const fs::path& file, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

struct CloseGz {
  void operator()(gzFile_s* file) const { gzclose(file); }
};

/// All of a file, unpacked. zlib passes plain files through.
std::string read_all(const fs::path& file) {
  if (fs::is_directory(file)) fail(file, "is a folder, expected a file");
  const std::unique_ptr<gzFile_s, CloseGz> stream(gzopen(file.c_str(), "rbe"));
  if (!stream) fail(file, std::strerror(errno));
  std::string text;
  std::array<char, 1 << 16> part;
  int count = 0;
  while ((count = gzread(stream.get(), part.data(), part.size())) > 0) {
    text.append(part.data(), static_cast<std::size_t>(count));
    if (text.size() > kMaxBytes) fail(file, "unpacks to more than 1 GiB, expected a log of a robot's drive");
  }
  int error = Z_OK;
  gzerror(stream.get(), &error);
  if (error != Z_OK || count < 0) fail(file, "gzip data are damaged or end too early; copy the file again");
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

/// The lines of a text without their ends; a last line without an end counts.
std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::vector<std::string> split_at_commas(std::string_view line) {
  std::vector<std::string> cells;
  for (std::size_t end = 0; end != std::string_view::npos;) {
    end = line.find(',');
    cells.emplace_back(line.substr(0, end));
    if (end != std::string_view::npos) line.remove_prefix(end + 1);
  }
  return cells;
}

std::vector<std::string> split_at_blanks(std::string_view line) {
  std::vector<std::string> cells;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return cells;
    const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
    cells.emplace_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

/// Whether a line is a comment or empty.
bool is_left_out(std::string_view line) {
  return line.starts_with('#') || line.find_first_not_of(" \t") == std::string_view::npos;
}

void append_row(NumberTable& table, long line, std::vector<std::string> cells) {
  if (cells.size() != table.columns.size()) {
    fail_at(table.file, line,
            fmt::format("expected {} fields ({}), found {}", table.columns.size(),
                        fmt::join(table.columns, ", "), cells.size()));
  }
  table.rows.push_back({line, std::move(cells)});
}

/// A whole number that fits its type.
template <class Integer>
std::optional<Integer> parse_whole(std::string_view text) {
  Integer value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Seconds as nanoseconds without passing through a double, which near a Unix epoch resolves only 240 ns.
std::optional<std::int64_t> parse_stamp(std::string_view text) {
  const bool negative = text.starts_with('-');
  const std::string_view digits = text.substr(negative ? 1 : 0);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::string_view whole = digits.substr(0, point);
  std::string fraction(digits.substr(std::min(point + 1, digits.size())));
  const bool exact = is_digits(whole) && whole.size() <= 10 && fraction.size() <= 9 &&
                     (fraction.empty() || is_digits(fraction));
  if (!exact) {
    const std::optional<double> seconds = finite_number_in(text);
    if (!seconds || std::abs(*seconds) >= 9e9) return {};
    return std::llround(*seconds * 1e9);
  }
  fraction.resize(9, '0');
  std::int64_t seconds = 0;
  std::int64_t nanoseconds = 0;
  std::from_chars(whole.data(), whole.data() + whole.size(), seconds);
  std::from_chars(fraction.data(), fraction.data() + fraction.size(), nanoseconds);
  if (seconds >= 9'000'000'000) return {};
  const std::int64_t stamp = seconds * 1'000'000'000 + nanoseconds;
  return negative ? -stamp : stamp;
}

}  // namespace

std::optional<double> finite_number_in(std::string_view text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_all = error == std::errc() && end == text.data() + text.size();
  return is_all && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<fs::path> find_plain_or_gz(const fs::path& path) {
  if (fs::exists(path)) return path;
  const fs::path packed = path.string() + ".gz";
  if (fs::exists(packed)) return packed;
  return {};
}

fs::path require_plain_or_gz(const fs::path& path) {
  const std::optional<fs::path> found = find_plain_or_gz(path);
  if (!found) throw std::runtime_error(fmt::format("{}[.gz]: no such file", path.string()));
  return *found;
}

NumberTable read_csv_table(const fs::path& file, const std::vector<std::string>& headers) {
  const std::string text = read_all(file);
  const std::vector<std::string_view> lines = split_lines(text);
  const std::string expected = fmt::format("expected the header '{}'", fmt::join(headers, "' or '"));
  if (lines.empty()) fail_at(file, 1, "the file is empty, " + expected);
  if (std::find(headers.begin(), headers.end(), lines[0]) == headers.end()) {
    fail_at(file, 1, fmt::format("{}, found {}", expected, in_quotes(lines[0])));
  }
  NumberTable table{file, split_at_commas(lines[0]), {}};
  table.rows.reserve(lines.size() - 1);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    append_row(table, static_cast<long>(i) + 1, split_at_commas(lines[i]));
  }
  return table;
}

NumberTable read_blank_separated_table(const fs::path& file, const std::vector<std::string>& columns) {
  const std::string text = read_all(file);
  const std::vector<std::string_view> lines = split_lines(text);
  NumberTable table{file, columns, {}};
  table.rows.reserve(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_left_out(lines[i])) continue;
    append_row(table, static_cast<long>(i) + 1, split_at_blanks(lines[i]));
  }
  return table;
}

NumberTable read_comma_separated_table(const fs::path& file, const std::vector<std::string>& columns) {
  const std::string text = read_all(file);
  const std::vector<std::string_view> lines = split_lines(text);
  NumberTable table{file, columns, {}};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_left_out(lines[i])) continue;
    if (table.rows.empty() && std::isalpha(static_cast<unsigned char>(lines[i][0])) != 0)
      continue;  // a header
    std::vector<std::string> cells;
    for (const std::string& cell : split_at_commas(lines[i])) {
      const std::vector<std::string> words = split_at_blanks(cell);
      cells.push_back(words.size() == 1 ? words.front() : cell);
    }
    if (cells.size() > columns.size()) cells.resize(columns.size());
    append_row(table, static_cast<long>(i) + 1, std::move(cells));
  }
  return table;
}

std::string first_row(const fs::path& file) {
  const std::string text = read_all(file);
  for (const std::string_view line : split_lines(text))
    if (!is_left_out(line)) return std::string(line);
  return {};
}

double number_in(const NumberTable& table, const TableRow& row, std::size_t column) {
  const std::optional<double> value = finite_number_in(row.cells[column]);
  if (!value) refuse(table, row, column, "expected a finite number");
  return *value;
}

int whole_number_in(const NumberTable& table, const TableRow& row, std::size_t column, int smallest) {
  const auto value = parse_whole<int>(row.cells[column]);
  if (!value || *value < smallest)
    refuse(table, row, column, fmt::format("expected a whole number of at least {}", smallest));
  return *value;
}

std::uint64_t seed_in(const NumberTable& table, const TableRow& row, std::size_t column) {
  const auto seed = parse_whole<std::uint64_t>(row.cells[column]);
  if (!seed) refuse(table, row, column, "expected a whole number that is not negative");
  return *seed;
}

std::int64_t stamp_ns_in(const NumberTable& table, const TableRow& row, std::size_t column) {
  const std::optional<std::int64_t> stamp = parse_stamp(row.cells[column]);
  if (!stamp) refuse(table, row, column, "expected a time in seconds within 9e9");
  return *stamp;
}

std::int64_t nanoseconds_in(const NumberTable& table, const TableRow& row, std::size_t column) {
  const auto stamp_ns = parse_whole<std::int64_t>(row.cells[column]);
  if (!stamp_ns) refuse(table, row, column, "expected a time as a whole number of nanoseconds");
  return *stamp_ns;
}

void refuse(const NumberTable& table, const TableRow& row, std::size_t column, std::string_view expectation) {
  fail_at(table.file, row.line,
          fmt::format("{}: {}, found {}", table.columns[column], expectation, in_quotes(row.cells[column])));
}

}  // namespace stereobench::harness
