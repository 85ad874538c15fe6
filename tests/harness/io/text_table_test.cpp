#include "harness/io/text_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>

#include "slam/math/random.h"

namespace stereobench::harness {
namespace {

const std::vector<std::string> kCells = {"", "-", "UFastSLAM", "0.412 +- 0.051", "±2 µm", "a|b", "1e-07"};

AlignedTable any_table(slam::RandomStream& random) {
  const auto cell = [&] { return kCells[random.bits() % kCells.size()]; };
  AlignedTable table;
  table.header.resize(1 + random.bits() % 6);
  std::generate(table.header.begin(), table.header.end(), cell);
  table.rows.resize(random.bits() % 5, table.header);
  for (auto& row : table.rows) std::generate(row.begin(), row.end(), cell);
  return table;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Characters, not bytes.
std::size_t length_of(const std::string& text) {
  std::size_t length = 0;
  for (const char c : text) length += (c & '\xC0') != '\x80' ? 1u : 0u;
  return length;
}

// Catches: bytes counted for characters, the widest cell ignored, columns padded on the wrong side.
TEST(ReportTable, MarkdownLinesAreAlikeLongWithPipesBelowPipes) {
  slam::RandomStream random(1, slam::Stream::kWorld);
  for (int trial = 0; trial < 200; ++trial) {
    const AlignedTable table = any_table(random);
    const std::vector<std::string> lines = lines_of(markdown(table));
    ASSERT_EQ(lines.size(), table.rows.size() + 2);
    for (const std::string& line : lines) {
      EXPECT_EQ(length_of(line), length_of(lines.front()));
      std::size_t pipes = 0;
      for (std::size_t i = 0; i < line.size(); ++i) {
        const bool escaped = i > 0 && line[i - 1] == '\\';
        pipes += line[i] == '|' && !escaped ? 1u : 0u;
      }
      EXPECT_EQ(pipes, table.header.size() + 1);
    }
  }
}

TEST(ReportTable, PlainTextAligns) {
  const AlignedTable table = {{"filter", "ATE [m]"}, {{"dead reckoning", "0.4"}, {"µ", "±0.01"}}};
  EXPECT_EQ(plain_text(table),
            "filter          ATE [m]\n"
            "--------------  -------\n"
            "dead reckoning      0.4\n"
            "µ                 ±0.01\n");
}

TEST(ReportTable, PlainTextHasNoTrailingBlanks) {
  slam::RandomStream random(2, slam::Stream::kWorld);
  for (int trial = 0; trial < 100; ++trial) {
    for (const std::string& line : lines_of(plain_text(any_table(random)))) {
      EXPECT_TRUE(line.empty() || line.back() != ' ');
    }
  }
}

TEST(ReportTable, RefusesRowsOfAnotherLength) {
  const AlignedTable table = {{"a", "b"}, {{"1"}}};
  EXPECT_THROW(plain_text(table), std::invalid_argument);
  EXPECT_THROW(markdown(table), std::invalid_argument);
}

// Catches: a digit too few, decimals counted from the wrong end.
TEST(ReportTable, NumbersKeepTheirDigits) {
  slam::RandomStream random(3, slam::Stream::kWorld);
  for (int trial = 0; trial < 500; ++trial) {
    const double value = random.normal() * std::pow(10.0, 16.0 * random.uniform() - 8.0);
    for (const int digits : {2, 3, 5}) {
      const double half_a_digit = 0.5000001 * std::pow(10.0, 1 - digits) * std::abs(value);
      EXPECT_NEAR(std::stod(format_number(value, digits)), value, half_a_digit);
    }
  }
  EXPECT_EQ(format_number(0.02134), "0.0213");
  EXPECT_EQ(format_number(0.0), "0");
  EXPECT_EQ(format_number(1234.5), "1234");
  EXPECT_EQ(format_number(std::numeric_limits<double>::quiet_NaN()), "-");
  EXPECT_EQ(format_number(-std::numeric_limits<double>::infinity()), "-");
}

// Mutation: six decimals for any half width.
TEST(ReportTable, MeansHaveAsManyDecimalsAsTheirInterval) {
  EXPECT_EQ(format_interval(0.41234, 0.0513), "0.412 +- 0.051");
  EXPECT_EQ(format_interval(12.345, 3.21), "12.3 +- 3.2");
  EXPECT_EQ(format_interval(1234.5, 321.0), "1234 +- 321");
  EXPECT_EQ(format_interval(0.02, 0.0), "0.0200");
  EXPECT_EQ(format_interval(0.02, std::numeric_limits<double>::infinity()), "0.0200") << "of a single seed";
  EXPECT_EQ(format_interval(3e-6, 2.2e-7), "3.00e-06 +- 2.2e-07");
  EXPECT_EQ(format_with_sd(0.41234, 0.0513), "0.412 (sd 0.051)");
  EXPECT_EQ(format_with_sd(0.02, 0.0), "0.0200");
  EXPECT_EQ(format_interval(std::numeric_limits<double>::quiet_NaN(), 1.0), "-");
}

}  // namespace
}  // namespace stereobench::harness
