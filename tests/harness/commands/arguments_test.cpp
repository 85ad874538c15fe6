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

// What follows the value is another argument. Mutation: the option takes all that follow.
TEST(RepeatableOption, TakesOneValueAtATime) {
  CLI::App program;
  std::vector<std::string> only, folders;
  repeatable(program.add_option("--only", only, "names"))->type_name("GLOB");
  program.add_option("folders", folders, "results")->required();
  program.parse("--only vision.* A --only batch.* B");
  EXPECT_THAT(only, ElementsAre("vision.*", "batch.*"));
  EXPECT_THAT(folders, ElementsAre("A", "B"));
  EXPECT_THAT(program.help(), HasSubstr("--only GLOB  "));
}

// Mutations: faults that --set forgets; the word without its group.
TEST(FaultsOption, IsALineOfTheScenario) {
  for (const char* line : {"--faults camera.blur=3 --set particles=7 --faults rig.turn=1",
                           "--set particles=7 --faults camera.blur=3 --faults rig.turn=1"}) {
    CLI::App program;
    std::vector<std::string> overrides;
    add_set_option(program, overrides);
    program.parse(line);
    EXPECT_THAT(overrides, ElementsAre("particles=7", "faults.camera.blur=3", "faults.rig.turn=1")) << line;
  }
}

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

// Law: the words of a command line, parsed again, say the same. Mutations: a flag's value among the words; a
// list that is split at its commas; options that were not said.
TEST(WordsOf, SayAgainWhatWasSaidOfTheResult) {
  struct Said {
    std::string scenario;
    std::vector<std::string> set;
    std::vector<double> law;
    bool plain = false;
    RunArguments run;
  };
  const auto parse = [](std::vector<std::string> words, Said& said) {
    auto command = std::make_unique<CLI::App>("", "run");
    command->add_option("scenario", said.scenario);
    add_set_option(*command, said.set);
    command->add_option("--law", said.law)->expected(3)->delimiter(',');
    command->add_flag("--plain", said.plain);
    add_run_options(*command, said.run);
    std::reverse(words.begin(), words.end());
    command->parse(words);
    return words_of(*command);
  };
  Said first, second;
  auto words = parse({"a b.yaml", "--seeds", "0..3", "--set", "x=1,2", "--filters", "ekf,ufastslam", "--law",
                      "1,2,3", "--set", "y=[]", "--plain", "--out", "there", "--jobs", "3"},
                     first);
  EXPECT_THAT(words, ElementsAre("stereobench", "run", "a b.yaml", "--set", "x=1,2", "--set", "y=[]", "--law",
                                 "1,2,3", "--plain", "--filters", "ekf,ufastslam"));
  words.erase(words.begin(), words.begin() + 2);
  parse(words, second);
  EXPECT_EQ(std::tie(first.scenario, first.set, first.law, first.plain, first.run.filters),
            std::tie(second.scenario, second.set, second.law, second.plain, second.run.filters));
}

}  // namespace
}  // namespace stereobench::harness
