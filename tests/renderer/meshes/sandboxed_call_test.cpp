/// Work that crashes, hangs or eats memory ends with a message, in time, and leaves no process behind.

#include "renderer/meshes/sandboxed_call.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/complaint.h"

namespace stereobench::renderer {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

using Work = std::function<std::string()>;

std::string complaint_of_child(const Work& work, const ChildLimits& limits = {}) {
  return complaint_of([&] { call_in_child(work, limits); });
}

bool has_children() {
  return ::waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

std::string hang() {
  for (;;) ::pause();
}

std::string spin() {
  for (std::atomic<unsigned> i = 0;;) ++i;
}

/// Deep enough for any stack.
unsigned recurse(unsigned depth) {  // NOLINT(misc-no-recursion)
  volatile char frame[4096] = {};
  frame[depth % sizeof(frame)] = 1;
  return depth == 0 ? 0U : recurse(depth - 1) + static_cast<unsigned>(frame[0]);
}

TEST(ChildCall, GivesAllBytesOfTheAnswer) {
  std::string sent(3000000, '\0');
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<char>(i * i >> 3U);
  EXPECT_EQ(call_in_child([&] { return sent; }, {}), sent);
  EXPECT_EQ(call_in_child([] { return std::string(); }, {}), "");
  EXPECT_FALSE(has_children());
}

TEST(ChildCall, ChangesNothingHere) {
  int touched = 0;
  call_in_child(
      [&] {
        touched = 1;
        std::puts("never seen");
        return std::string();
      },
      {});
  EXPECT_EQ(touched, 0);
}

TEST(ChildCall, PassesOnWhatWasThrown) {
  EXPECT_EQ(complaint_of_child([]() -> std::string { throw std::runtime_error("no good"); }), "no good");
}

// Meant to catch: the status of the child not looked at (an answer cut off counts as one); exceptions that
// leave the child's function, which then runs the rest of these tests.
TEST(ChildCall, SaysHowTheChildDied) {
  const Work segfault = [] { return std::raise(SIGSEGV) == 0 ? hang() : hang(); };
  EXPECT_THAT(complaint_of_child(segfault), StartsWith("crashed ("));
  EXPECT_EQ(complaint_of_child([]() -> std::string {
              ::raise(SIGKILL), hang();
              return {};
            }),
            "crashed (signal 9)");
  EXPECT_EQ(complaint_of_child([]() -> std::string { ::_exit(3); }), "crashed (exit status 3)");
  EXPECT_THAT(complaint_of_child([]() -> std::string { throw 7; }), StartsWith("crashed ("));
  EXPECT_THAT(complaint_of_child([] { return std::to_string(recurse(1U << 20U)); }), StartsWith("crashed ("));
  EXPECT_FALSE(has_children());
}

// Mutation: no limit on the wall's clock, or none of the processor (a spinning child then takes kPatience
// times as long).
TEST(ChildCall, WaitsNoLongerThanItMay) {
  for (const auto& [work, seconds] : {std::pair(Work(hang), 0.05), std::pair(Work(spin), 0.3)}) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(complaint_of_child(work, {.seconds = seconds}),
              fmt::format("takes longer than {:g} s", seconds));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(6));
    EXPECT_FALSE(has_children());
  }
}

// A machine with other work makes a child wait, and it is not to blame. Mutation: the wall's clock.
TEST(ChildCall, CountsTheTimeOfItsProcessor) {
  const Work sleeper = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    return std::string("done");
  };
  EXPECT_EQ(call_in_child(sleeper, {.seconds = 0.2}), "done");
}

[[maybe_unused]] std::string eat_memory() {
  std::vector<std::vector<char>> eaten;
  for (;;) eaten.emplace_back(std::size_t{1} << 20U, 'x');
}

// Meant to catch: a limit that counts what the parent had.
TEST(ChildCall, GivesNoMoreMemoryThanItMay) {
  const ChildLimits limits{.memory_bytes = std::size_t{64} << 20U};
  const Work modest = [] { return std::string(std::size_t{20} << 20U, 'x'); };
  EXPECT_EQ(call_in_child(modest, limits).size(), std::size_t{20} << 20U);
#ifndef __SANITIZE_ADDRESS__  // whose allocator has taken its terabytes of addresses before
  EXPECT_EQ(complaint_of_child(eat_memory, limits), "needs more than 64 MiB of memory");
#endif
}

// A parent that is killed takes its child along. Mutation tried: no death signal.
TEST(ChildCall, OrphansDoNotLive) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);  // stays open as long as somebody lives who can write to it
  const pid_t parent = ::fork();
  if (parent == 0) {
    ::close(ends[0]);
    ::alarm(20);
    complaint_of_child(
        [&] {
          EXPECT_EQ(::write(ends[1], "!", 1), 1);
          return hang();
        },
        {.seconds = 60.0});
    ::_exit(0);
  }
  ASSERT_GT(parent, 0);
  ::close(ends[1]);
  char byte = 0;
  ASSERT_EQ(::read(ends[0], &byte, 1), 1) << "the child is at work";
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  pollfd polled = {ends[0], POLLIN, 0};
  ASSERT_EQ(::poll(&polled, 1, 5000), 1) << "somebody who could write is still there";
  EXPECT_EQ(::read(ends[0], &byte, 1), 0);
  ::close(ends[0]);
}

}  // namespace
}  // namespace stereobench::renderer
