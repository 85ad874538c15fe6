/// Runs that are ended by signals.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/harness/commands/processes.h"
#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A run of which each seed takes many seconds, by two workers.
std::string long_run(const TestFolder& scratch) {
  return fmt::format("run '{}' --particles 3000 --seeds 0..9 --jobs 2 --out '{}' >/dev/null 2>'{}'",
                     scenario_path("open_field"), (scratch.path() / "out").string(),
                     (scratch.path() / "err").string());
}

bool have_all_ended(const std::vector<pid_t>& processes) {
  return std::none_of(processes.begin(), processes.end(), is_alive);
}

struct Ending {
  std::string name;
  int signal;
  int exit_code;
  std::string line;  ///< on standard error, or none
};
void PrintTo(const Ending& ending, std::ostream* out) {
  *out << ending.name;
}
class EndedRun : public testing::TestWithParam<Ending> {};

// Mutations: no PR_SET_PDEATHSIG (both workers compute on); no handlers (no line); workers with the parent's
// handlers (a line from each worker that a terminal's signal reaches).
TEST_P(EndedRun, LeavesNoWorkerBehind) {
  const TestFolder scratch;
  const pid_t run = start_stereobench(long_run(scratch));
  ASSERT_TRUE(comes_true_in_time([&] { return children_of(run).size() == 2; }));
  const std::vector<pid_t> workers = children_of(run);
  for (const pid_t worker : workers) EXPECT_TRUE(comes_true_in_time([&] { return ignores(worker, SIGINT); }));
  for (const pid_t worker : workers) ::kill(worker, SIGINT);  // as a terminal sends it to all
  ::kill(run, GetParam().signal);
  EXPECT_EQ(exit_code_of(run), GetParam().exit_code);
  EXPECT_TRUE(comes_true_in_time([&] { return have_all_ended(workers); }));
  const std::string errors = bytes_of(scratch.path() / "err");
  EXPECT_THAT(errors, StartsWith(GetParam().line));
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), GetParam().line.empty() ? 0 : 1) << errors;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out/run.json"));
  for (const pid_t worker : workers)
    if (is_alive(worker)) ::kill(worker, SIGKILL);  // of a test that failed
}

INSTANTIATE_TEST_SUITE_P(
    All, EndedRun,
    testing::Values(Ending{"Terminated", SIGTERM, 143, "stereobench: terminated (SIGTERM)"},
                    Ending{"Interrupted", SIGINT, 130, "stereobench: interrupted (SIGINT)"},
                    Ending{"Killed", SIGKILL, 137, ""}),
    [](const auto& test) { return test.param.name; });

// Mutation: what a detector has started in a session of its own is let be (by the supervisor, which finds it
// among its children).
TEST(EndedRunOfADetector, LeavesNothingOfTheDetectorBehind) {
  const TestFolder scratch;
  const std::string note = (scratch.path() / "pids").string();
  const std::string script = scratch.write(
      "daemon.sh", "setsid sh -c 'echo $$ >>" + note + "; setsid sleep 300 & echo $! >>" + note +
                       "; sleep 300' &\necho $$ >>" + note + "; read setup; sleep 300\n");
  const pid_t run = start_stereobench(
      fmt::format("run '{}' --seeds 0 --jobs 1 --detector 'sh {}' --out '{}' >/dev/null 2>&1",
                  scenario_path("ball_circle"), script, (scratch.path() / "out").string()));
  const auto noted = [&] {
    std::vector<pid_t> pids;
    std::ifstream file(note);
    for (pid_t pid = 0; file >> pid;) pids.push_back(pid);
    return pids;
  };
  ASSERT_TRUE(comes_true_in_time([&] { return noted().size() == 3; }));
  for (const pid_t pid : noted()) EXPECT_TRUE(is_alive(pid));
  ::kill(run, SIGTERM);
  EXPECT_EQ(exit_code_of(run), 143);
  EXPECT_TRUE(comes_true_in_time([&] { return have_all_ended(noted()); }));
  for (const pid_t pid : noted())
    if (is_alive(pid)) ::kill(pid, SIGKILL);  // of a test that failed
}

// Whoever renders is the program itself, which may be at a file. Mutation: no handler that removes it.
TEST(EndedRender, LeavesNoUnfinishedFile) {
  const TestFolder scratch;
  const auto out = scratch.path() / "out";
  for (const int first_frames : {0, 1, 3}) {
    const pid_t render = start_stereobench(
        fmt::format("render '{}' --set path.laps=0.3 --out '{}' >/dev/null 2>'{}'",
                    scenario_path("ball_circle"), out.string(), (scratch.path() / "err").string()));
    const auto frames = [&] {
      const auto left = out / "left";
      return std::filesystem::exists(left) ? std::distance(std::filesystem::directory_iterator(left), {})
                                           : std::ptrdiff_t{-1};
    };
    ASSERT_TRUE(comes_true_in_time([&] { return frames() >= first_frames; }));
    ::kill(render, SIGTERM);
    EXPECT_EQ(exit_code_of(render), 143);
    EXPECT_THAT(bytes_of(scratch.path() / "err"), HasSubstr("terminated (SIGTERM)"));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
      EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
  }
}

}  // namespace
}  // namespace stereobench::harness
