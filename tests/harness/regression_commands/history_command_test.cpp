/// `history`: what it says of many results, and its exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class HistoryCommand : public testing::Test {
 protected:
  /// Writes a result of ten seeds whose errors are a multiple of 1.0, 1.1, ...
  std::string result(const std::string& name, double factor, const std::string& scenario = "office") {
    nlohmann::json errors, seeds;
    for (int seed = 0; seed < 10; ++seed) {
      seeds.push_back(seed);
      errors.push_back(factor * (1.0 + 0.1 * seed));
    }
    const nlohmann::json run = {{"schema", 1},
                                {"scenario", scenario},
                                {"seeds", seeds},
                                {"per_seed", {{"filters.ekf.ate_rms_m", errors}}}};
    folder_.write(name + "/run.json", run.dump());
    return path(name);
  }
  std::string path(const std::string& name) { return (folder_.path() / name).string(); }

  /// A result for each factor, named 0, 1, ...
  Outcome history(const std::vector<double>& factors, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"history"};
    for (std::size_t i = 0; i < factors.size(); ++i)
      arguments.push_back(result(std::to_string(i), factors[i]));
    return run_stereobench(with(std::move(arguments), more));
  }

  TestFolder folder_;
};

// Mutations: results in the order of their names; 1 for a step without --strict; --strict read and forgotten.
TEST_F(HistoryCommand, SaysBetweenWhichResultsAStepIs) {
  const Outcome outcome = history({1.0, 1.0, 1.0, 1.3, 1.3});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("   4  " + path("3") + " (office, 10 seeds)"), HasSubstr("3 to 4"),
                                 HasSubstr("+30 %"), HasSubstr("worse")));
  EXPECT_EQ(history({1.0, 1.0, 1.0, 1.3, 1.3}, {"--strict"}).exit_code, 1);
  EXPECT_EQ(history({1.3, 1.3, 1.3, 1.0, 1.0}, {"--strict"}).exit_code, 0);
  EXPECT_EQ(history({1.0, 1.0, 1.3, 1.0, 1.0}, {"--strict"}).exit_code, 0);
  EXPECT_THAT(history({1.0, 1.0, 1.0}).out, HasSubstr("0 changed, 0 with a step"));
}

TEST_F(HistoryCommand, WritesWhatItFound) {
  history({1.0, 1.0, 1.3, 1.3}, {"--json", path("out.json"), "--picture", path("out.png")});
  const auto json = nlohmann::json::parse(bytes_of(path("out.json")));
  EXPECT_EQ(json["metrics"][0]["steps"][0]["from_result"], 3);
  EXPECT_EQ(bytes_of(path("out.png")).substr(1, 3), "PNG");
  const std::string once = bytes_of(path("out.png"));
  history({1.0, 1.0, 1.3, 1.3}, {"--picture", path("out.png")});
  EXPECT_EQ(bytes_of(path("out.png")), once);
}

// Mutation: nobody hears of it.
TEST_F(HistoryCommand, SaysWhatGotWorseWhenItIsQuietToo) {
  EXPECT_THAT(history({1.0, 1.0, 1.3}, {"--quiet", "--strict"}).err, HasSubstr("2 to 3"));
  const Outcome better = history({1.3, 1.3, 1.0}, {"--quiet", "--strict"});
  EXPECT_EQ(better.out + better.err, "");
}

TEST_F(HistoryCommand, WarnsOfOtherScenarios) {
  const Outcome outcome = run_stereobench({"history", result("a", 1.0), result("b", 1.0, "room")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("warning: the results are of different scenarios"));
  EXPECT_THAT(history({1.0, 1.0}).out, Not(HasSubstr("warning")));
}

TEST_F(HistoryCommand, RefusesWhatIsNoHistory) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& line) {
    const Outcome outcome = run_stereobench(with({"history"}, arguments));
    EXPECT_EQ(outcome.exit_code, 2) << line;
    EXPECT_THAT(outcome.err, HasSubstr(line));
    EXPECT_EQ(outcome.out, "");
  };
  const std::string one = result("one", 1.0);
  refused({one}, "expected two results or more");
  refused({one, path("nowhere")}, "nowhere: no such file");
  refused({one, one, "--only", "vision.*"}, "fits 'vision.*'");
  refused({one, one, "--margin", "ate"}, "--margin: expected a metric");
  refused({one, one, "--panels", "0"}, "--panels");
  refused({}, "results");
}

}  // namespace
}  // namespace stereobench::harness
