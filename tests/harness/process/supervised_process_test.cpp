#include "harness/process/supervised_process.h"

#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/harness/commands/program.h"

namespace stereobench::harness {
namespace {

using Clock = std::chrono::steady_clock;

SupervisedProcess::Time in_ms(int milliseconds) {
  return Clock::now() + std::chrono::milliseconds(milliseconds);
}

bool comes_true(const std::function<bool()>& condition) {
  for (const auto until = in_ms(5000); Clock::now() < until;) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return condition();
}

/// Whether a process is there, also as a zombie.
bool exists(const std::string& pid) {
  return std::filesystem::exists("/proc/" + pid);
}

/// A folder of its own for the process to remove, within one that the test removes.
struct Place {
  TestFolder outer;
  std::filesystem::path scratch = outer.path() / "scratch";
  Place() { std::filesystem::create_directory(scratch); }
};

TEST(SupervisedProcess, TalksInLines) {
  const Place place;
  SupervisedProcess process("while read line; do echo \"<$line>\"; done", place.scratch);
  std::string line;
  for (const std::string word : {"one", "two words", ""}) {
    EXPECT_TRUE(process.say(word + "\n", in_ms(5000)));
    EXPECT_EQ(process.hear(line, 100, in_ms(5000)), Heard::kLine);
    EXPECT_EQ(line, "<" + word + ">");
  }
  process.close_input();
  EXPECT_EQ(process.hear(line, 100, in_ms(5000)), Heard::kEnd);
  EXPECT_EQ(process.wait_status(in_ms(5000)), 0);
}

TEST(SupervisedProcess, TellsSilenceFromTheEndAndFromTooMuch) {
  const Place place;
  std::string line;
  EXPECT_EQ(SupervisedProcess("sleep 60", place.scratch).hear(line, 100, in_ms(20)), Heard::kSilence);
  EXPECT_EQ(SupervisedProcess("printf half", place.scratch).hear(line, 100, in_ms(5000)), Heard::kEnd);
  EXPECT_EQ(line, "half");
  EXPECT_EQ(SupervisedProcess("yes '' | tr -d '\\n'", place.scratch).hear(line, 100, in_ms(20)),
            Heard::kSilence);
  EXPECT_EQ(SupervisedProcess("cat /dev/zero", place.scratch).hear(line, 1000, in_ms(5000)), Heard::kTooMuch);
}

// Mutations: SIGPIPE is not ignored (the test dies of it); errors are not read meanwhile (a full pipe of them
// stops the program, and the line never comes).
TEST(SupervisedProcess, NeitherWritingToTheDeadNorAFullPipeOfErrorsStopsIt) {
  const Place place;
  SupervisedProcess dead("exec <&-; echo gone", place.scratch);
  std::string line;
  EXPECT_EQ(dead.hear(line, 100, in_ms(5000)), Heard::kLine);
  EXPECT_TRUE(dead.say(std::string(1 << 20, 'x'), in_ms(5000)));
  SupervisedProcess loud("head -c 300000 /dev/zero >&2; echo >&2; echo ' the end ' >&2; echo here; cat",
                         place.scratch);
  EXPECT_EQ(loud.hear(line, 100, in_ms(5000)), Heard::kLine);
  EXPECT_EQ(line, "here");
  EXPECT_EQ(loud.last_errors(1), std::vector<std::string>{" the end"});
  EXPECT_FALSE(SupervisedProcess("sleep 60", place.scratch).say(std::string(1 << 20, 'x'), in_ms(20)));
}

TEST(SupervisedProcess, SaysHowItEnded) {
  const Place place;
  const auto status = [&](const std::string& command) {
    return SupervisedProcess(command, place.scratch).wait_status(in_ms(5000)).value();
  };
  EXPECT_EQ(WEXITSTATUS(status("exit 7")), 7);
  EXPECT_EQ(WTERMSIG(status("kill -SEGV $$")), SIGSEGV);
  EXPECT_FALSE(SupervisedProcess("sleep 60", place.scratch).wait_status(in_ms(20)));
}

// Mutation: the supervisor ends and the command does not. (Killing the shell and not its group hangs.)
TEST(SupervisedProcess, LeavesNothingBehind) {
  const Place place;
  std::ofstream(place.scratch / "picture.png") << "pixels";
  std::string shell, child;
  {
    SupervisedProcess process("sleep 61 & echo $$; echo $!; trap '' TERM INT HUP; wait", place.scratch);
    ASSERT_EQ(process.hear(shell, 100, in_ms(5000)), Heard::kLine);
    ASSERT_EQ(process.hear(child, 100, in_ms(5000)), Heard::kLine);
    EXPECT_TRUE(exists(shell) && exists(child));
  }
  EXPECT_FALSE(exists(shell) || exists(child));
  EXPECT_FALSE(std::filesystem::exists(place.scratch));
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
}

// What a program starts ends with it, so that nobody waits for the end of what it has left open.
// Mutation: no killing of the group when its leader has ended.
TEST(SupervisedProcess, WhatItStartedEndsWithIt) {
  const Place place;
  SupervisedProcess process("sleep 62 & echo $!", place.scratch);
  std::string child, nothing;
  ASSERT_EQ(process.hear(child, 100, in_ms(5000)), Heard::kLine);
  EXPECT_EQ(process.hear(nothing, 100, in_ms(5000)), Heard::kEnd);
  EXPECT_TRUE(comes_true([&] { return !exists(child); }));
}

// Mutation: only the command's process group is ended.
TEST(SupervisedProcess, WhatItStartedInSessionsOfTheirOwnEndsWithIt) {
  for (const bool is_killed : {false, true}) {
    const Place place;
    std::string daemon, its_child;
    auto process = std::make_unique<SupervisedProcess>(
        "setsid sh -c 'setsid sleep 64 >/dev/null & echo $$; echo $!; exec >&-; sleep 64' & " +
            std::string(is_killed ? "wait" : "sleep 0.2"),
        place.scratch);
    ASSERT_EQ(process->hear(daemon, 100, in_ms(5000)), Heard::kLine);
    ASSERT_EQ(process->hear(its_child, 100, in_ms(5000)), Heard::kLine);
    EXPECT_TRUE(exists(daemon) && exists(its_child));
    if (is_killed) process.reset();
    EXPECT_TRUE(comes_true([&] { return !exists(daemon) && !exists(its_child); })) << is_killed;
  }
}

// Mutations: the last line alone; blank lines kept.
TEST(SupervisedProcess, KeepsTheLastErrors) {
  const Place place;
  SupervisedProcess process(
      "for i in 1 2 3 4 5 6 7 8 9 10 11 12; do echo line $i >&2; echo >&2; done; echo done", place.scratch);
  std::string line;
  ASSERT_EQ(process.hear(line, 100, in_ms(5000)), Heard::kLine);
  const std::vector<std::string> errors = process.last_errors(10);
  ASSERT_EQ(errors.size(), 10U);
  EXPECT_EQ(errors.front(), "line 3");
  EXPECT_EQ(errors.back(), "line 12");
}

// A run that is killed cannot clean up; its supervisor does. Mutation: it does not end
// the command when the lifeline does.
TEST(SupervisedProcess, IsEndedWhenItsOwnerIsKilled) {
  const Place place;
  const std::string note = (place.outer.path() / "pid").string();
  const pid_t owner = ::fork();
  if (owner == 0) {
    const SupervisedProcess process(
        "sleep 63 & echo $! > " + note + ".part; mv " + note + ".part " + note + "; wait", place.scratch);
    ::pause();
  }
  ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(note); }));
  std::string child;
  std::ifstream(note) >> child;
  EXPECT_TRUE(exists(child));
  ::kill(owner, SIGKILL);
  ::waitpid(owner, nullptr, 0);
  EXPECT_TRUE(comes_true([&] { return !exists(child) && !std::filesystem::exists(place.scratch); }));
}

}  // namespace
}  // namespace stereobench::harness
