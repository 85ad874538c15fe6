#include "harness/commands/arguments.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include "slam/filter_registry.h"

namespace stereobench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Mutation: dead reckoning not put first.
TEST(ParseFilters, PutsDeadReckoningFirstAndKeepsTheOrderOfTheOthers) {
  EXPECT_THAT(parse_filters("ufastslam,fastslam2"), ElementsAre(kBaselineFilter, "ufastslam", "fastslam2"));
  EXPECT_THAT(parse_filters("fastslam2,ufastslam"), ElementsAre(kBaselineFilter, "fastslam2", "ufastslam"));
  EXPECT_THAT(parse_filters("ufastslam,dead_reckoning"), ElementsAre(kBaselineFilter, "ufastslam"));
}

// Law: whatever is asked for, each filter is run once, and dead reckoning always.
// Mutation: not looking for those that are there already.
TEST(ParseFilters, NamesEachFilterOnce) {
  for (const std::string& first : slam::filter_names())
    for (const std::string& second : slam::filter_names()) {
      const auto filters = parse_filters(first + "," + second + "," + first);
      EXPECT_EQ(std::count(filters.begin(), filters.end(), kBaselineFilter), 1);
      EXPECT_EQ(std::count(filters.begin(), filters.end(), first), 1);
      EXPECT_EQ(std::count(filters.begin(), filters.end(), second), 1);
    }
}

// Mutation: letting a comma at the end pass.
TEST(ParseFilters, RefusesUnknownAndEmptyNamesAndSaysWhichThereAre) {
  const std::string all = fmt::format("{}", fmt::join(slam::filter_names(), ", "));
  for (const char* text : {"", ",", "kalman", "ufastslam,", ",ufastslam", "ufastslam,,fastslam2", "UFastSLAM",
                           "ufastslam, fastslam2"})
    EXPECT_THAT([&] { parse_filters(text); }, ThrowsMessage<std::runtime_error>(HasSubstr(all))) << text;
}

RunArguments parsed(std::vector<std::string> words) {
  CLI::App app;
  RunArguments arguments;
  add_run_options(app, arguments);
  std::reverse(words.begin(), words.end());  // as CLI11 wants them
  app.parse(words);
  return arguments;
}

TEST(RunOptions, WhatIsNotGivenIsLeftToTheScenario) {
  const RunArguments arguments = parsed({});
  EXPECT_TRUE(arguments.filters.empty());
  EXPECT_TRUE(arguments.seeds.empty());
  EXPECT_EQ(arguments.particles, 0);
  EXPECT_GE(arguments.jobs, 1);
  EXPECT_EQ(output_folder(arguments, "name"), "out/name");
}

TEST(RunOptions, AreRead) {
  const RunArguments arguments =
      parsed({"--seeds", "3..5", "--particles", "7", "-j", "2", "--out", "here", "--filters", "fastslam2"});
  EXPECT_THAT(arguments.seeds, ElementsAre(3U, 4U, 5U));
  EXPECT_EQ(arguments.particles, 7);
  EXPECT_EQ(arguments.jobs, 2);
  EXPECT_EQ(output_folder(arguments, "name"), "here");
  EXPECT_THAT(arguments.filters, ElementsAre(kBaselineFilter, "fastslam2"));
}

}  // namespace
}  // namespace stereobench::harness
