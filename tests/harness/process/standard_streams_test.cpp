/// Standard input, output and error that are full or closed, and what quiet commands say.
#include <algorithm>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/commands/processes.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Runs the program in a shell. @param how its arguments and redirections, standard error aside
Outcome run_in_shell(const std::string& how) {
  const TestFolder scratch;
  const std::string errors = (scratch.path() / "err").string();
  Outcome outcome;
  outcome.exit_code = exit_code_of(start_stereobench(how + " 2>'" + errors + "'"));
  outcome.err = bytes_of(errors);
  return outcome;
}

class OutputThatIsNotTaken : public testing::TestWithParam<std::string> {};

// Mutations: no check of what is buffered at the end; std::cout, which --help uses, not checked; a closed
// output opened for writing.
TEST_P(OutputThatIsNotTaken, IsAnError) {
  const TestFolder scratch;
  const std::string picture = scratch.write("dark.pnm", "P3 2 2 255 7 7 7 7 7 7 7 7 7 7 7 7\n");
  const std::string scenario = "'" + scenario_path("ball_circle") + "'";
  const std::string run =
      fmt::format("run '{}' --set gates=[] --seeds 0 --particles 5 --filters ekf --out '{}'",
                  scenario_path("open_field"), (scratch.path() / "out").string());
  for (const std::string& command : {std::string("doctor"), "detect " + scratch.path().string(),
                                     "detect " + picture, std::string("--help"), std::string("--version"),
                                     std::string("run --help"), "world " + scenario, run}) {
    const Outcome outcome = run_in_shell(command + " " + GetParam());
    EXPECT_EQ(outcome.exit_code, 2) << command;
    EXPECT_THAT(outcome.err, StartsWith("stereobench: standard output: cannot")) << command;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

INSTANTIATE_TEST_SUITE_P(All, OutputThatIsNotTaken, testing::Values(">/dev/full", ">&-"),
                         [](const auto& test) { return test.index == 0 ? "Full" : "Closed"; });

// Mutation: an error that is thrown where errors are told.
TEST(StandardStreams, ErrorsThatNobodyTakesKeepTheirExitCode) {
  for (const char* stream : {">/dev/full", ">&-"})
    EXPECT_EQ(exit_code_of(start_stereobench(fmt::format("run no_such.yaml 2{}", stream))), 2) << stream;
}

// Mutation seen to turn this red: what tables say goes to standard output alone.
TEST(StandardStreams, AQuietCommandSaysTheWarningsOfItsTables) {
  const TestFolder scratch;
  const auto truth =
      scratch.write("truth.txt", "0 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n2 2 1 0 0 0 0 1\n3 2 2 0 0 0 0 1\n");
  const auto estimate = scratch.write(
      "estimate.txt", "0 0 0 0 0 0 0 1\n0.99 1 0 0 0 0 0 1\n1.01 1 0 0 0 0 0 1\n2 2 1 0 0 0 0 1\n");
  const Outcome outcome =
      run_in_shell(fmt::format("slam --quiet --evaluate '{}' --truth '{}' --most-dt-s 0.1 --out '{}'",
                               std::string(estimate), std::string(truth), (scratch.path() / "out").string()));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "stereobench: warning: pairs that share a pose with the pair before: 1\n");
}

// Mutation seen to turn this red: what tables say goes to standard output alone.
TEST(StandardStreams, AQuietRunSaysItsWarningsAndNothingElse) {
  const TestFolder scratch;
  const Outcome outcome = run_in_shell(fmt::format(
      "run '{}' --quiet --filters iekf --seeds 0..1 --set gates=[] "
      "--set 'believed_odometry_noise={{v_constant_mps: 0.001, w_constant_degps: 0.01}}' --out '{}'",
      scenario_path("open_field"), (scratch.path() / "out").string()));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("stereobench: warning: iekf makes errors"));
  std::istringstream lines(outcome.err);
  for (std::string line; std::getline(lines, line);) EXPECT_THAT(line, StartsWith("stereobench: warning: "));
}

// Descriptor 0 was given to a pipe, and closed when the detector started. Mutation: open_standard_streams.
TEST(StandardStreams, ThatAreClosedAreNoDetectorsPipes) {
  for (const char* closed : {"<&-", "<&- >&-"}) {
    const TestFolder scratch;
    const Outcome outcome = run_in_shell(fmt::format(
        "run '{}' --set path.laps=0.06 --set gates=[] --seeds 0 --filters dead_reckoning "
        "--detector '{} detect --serve' --out "
        "'{}' {}",
        scenario_path("ball_circle"), STEREOBENCH_PROGRAM, (scratch.path() / "out").string(), closed));
    EXPECT_TRUE(std::filesystem::exists(scratch.path() / "out/run.json")) << outcome.err;
    if (std::string(closed) == "<&-") {
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    }
  }
}

}  // namespace
}  // namespace stereobench::harness
