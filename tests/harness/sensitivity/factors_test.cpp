#include "harness/sensitivity/factors.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stereobench::harness {
namespace {

std::string refusal_of(const std::string& text) {
  try {
    parse_key_range(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParseKeyRange, ReadsEndsAndSpacing) {
  const KeyRange even = parse_key_range("oracle.range_sd_m=-0.5..1e-1");
  EXPECT_EQ(even.key, "oracle.range_sd_m");
  EXPECT_EQ(even.low, -0.5);
  EXPECT_EQ(even.high, 0.1);
  EXPECT_EQ(even.spacing, Spacing::kEven);
  EXPECT_EQ(parse_key_range("a=1..2:log").spacing, Spacing::kLogarithmic);
  EXPECT_EQ(parse_key_range("a=1..2:whole").spacing, Spacing::kWhole);
}

// Mutation: low == high is accepted.
TEST(ParseKeyRange, RefusesInOneLine) {
  EXPECT_EQ(refusal_of("a"), "--vary: expected key=low..high, got 'a'");
  EXPECT_EQ(refusal_of("=1..2"), "--vary: expected key=low..high, got '=1..2'");
  for (const char* values :
       {"", "1", "1..", "..2", "1,2", "1..2..3", "a..b", "0..inf", "1..2:lin", "1:log..2"})
    EXPECT_EQ(
        refusal_of(std::string("a=") + values),
        std::string("--vary a: expected low..high, low..high:log or low..high:whole, got '") + values + "'");
  EXPECT_EQ(refusal_of("a=2..2"), "--vary a: expected low below high, got '2..2'");
  EXPECT_EQ(refusal_of("a=0..2:log"), "--vary a: expected numbers above 0 before :log, got '0..2:log'");
  EXPECT_EQ(refusal_of("a=0..2.5:whole"),
            "--vary a: expected whole numbers before :whole, got '0..2.5:whole'");
}

// Mutation: the high end of whole numbers is left out.
TEST(ValueAt, GoesFromLowToHigh) {
  constexpr double kAlmostOne = 1.0 - 0x1p-53;
  const KeyRange even{"a", -1.0, 3.0, Spacing::kEven};
  EXPECT_EQ(value_at(even, 0.0), -1.0);
  EXPECT_EQ(value_at(even, 0.25), 0.0);
  const KeyRange logarithmic{"a", 0.01, 100.0, Spacing::kLogarithmic};
  EXPECT_EQ(value_at(logarithmic, 0.0), 0.01);
  EXPECT_NEAR(value_at(logarithmic, 0.5), 1.0, 1e-12);
  EXPECT_LE(value_at(logarithmic, kAlmostOne), 100.0);
  const KeyRange whole{"a", 2.0, 4.0, Spacing::kWhole};
  EXPECT_EQ(value_at(whole, 0.33), 2.0);
  EXPECT_EQ(value_at(whole, 0.34), 3.0);
  EXPECT_EQ(value_at(whole, kAlmostOne), 4.0);
}

TEST(Factors, HaveNamesAndValuesOfKeysThenStreams) {
  const Factors factors{.keys = {{"a", 1.0, 2.5, Spacing::kEven}, {"b", 1.0, 9.0, Spacing::kWhole}},
                        .streams = {"seed"}};
  EXPECT_EQ(factors.size(), 3u);
  EXPECT_EQ(factors.name(1), "b");
  EXPECT_EQ(factors.name(2), "seed");
  EXPECT_EQ(factors.values(0), "1 to 2.5");
  EXPECT_EQ(factors.values(1), "1 to 9, whole");
  EXPECT_EQ(factors.values(2), "random numbers");
}

TEST(Factors, AreRefusedTwice) {
  EXPECT_THROW(check(Factors{}), std::runtime_error);
  EXPECT_THROW(check(Factors{.keys = {{"a"}, {"a"}}, .streams = {}}), std::runtime_error);
  EXPECT_THROW(check(Factors{.keys = {{"seed"}}, .streams = {"seed"}}), std::runtime_error);
  EXPECT_NO_THROW(check(Factors{.keys = {{"a"}, {"b"}}, .streams = {"seed"}}));
}

}  // namespace
}  // namespace stereobench::harness
