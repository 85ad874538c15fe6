#include "harness/process/process_pool.h"

#include <chrono>
#include <map>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace stereobench::harness {
namespace {

const OnProgress kSilent = [](double) {};

std::string square(std::size_t index, const std::function<void(double)>& report) {
  report(0.5);
  return std::string(1000 * index, 'x') + std::to_string(index * index);
}

// Mutation: gathering answers in order of arrival turns this red.
TEST(ProcessPool, AnswersAreInOrderWhateverTheJobsAndTheDurations) {
  const Task slow_first = [](std::size_t index, const std::function<void(double)>& report) {
    if (index == 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return square(index, report);
  };
  const auto one = run_in_processes(40, 1, square, kSilent);
  for (const int jobs : {2, 3, 7, 64}) EXPECT_EQ(run_in_processes(40, jobs, slow_first, kSilent), one);
}

TEST(ProcessPool, AnswersOfManyMegabytesArriveWhole) {
  const Task task = [](std::size_t index, const auto&) {
    return std::string(5'000'000, static_cast<char>('a' + index));
  };
  const auto answers = run_in_processes(3, 2, task, kSilent);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(answers[i], std::string(5'000'000, static_cast<char>('a' + i)));
}

TEST(ProcessPool, NoTaskGivesNoAnswer) {
  EXPECT_TRUE(run_in_processes(0, 2, square, kSilent).empty());
}

TEST(ProcessPool, ErrorOfATaskReachesTheCaller) {
  const Task task = [](std::size_t index, const auto& report) {
    if (index == 3) throw std::runtime_error("no ball in sight");
    return square(index, report);
  };
  for (const int jobs : {1, 2})
    EXPECT_THAT([&] { run_in_processes(10, jobs, task, kSilent); },
                testing::ThrowsMessage<std::runtime_error>("no ball in sight"));
}

// Mutations: a worker that ends after an error; none in the place of one that died; a fault that is
// forgotten.
TEST(ProcessPool, OthersGoOnWhereFaultsAreAskedFor) {
  const Task task = [](std::size_t index, const auto& report) {
    if (index % 4 == 1) throw std::runtime_error("no ball in sight");
    if (index % 4 == 3) ::raise(SIGKILL);
    return square(index, report);
  };
  for (const int jobs : {1, 3}) {
    std::map<std::size_t, std::string> answers, faults;
    run_all_in_processes(
        20, jobs, task, [&](std::size_t index, std::string answer) { answers[index] = std::move(answer); },
        [&](std::size_t index, std::string message) { faults[index] = std::move(message); }, kSilent);
    ASSERT_EQ(answers.size(), 10u);
    ASSERT_EQ(faults.size(), 10u);
    EXPECT_EQ(answers.at(2), square(2, [](double) {}));
    EXPECT_EQ(faults.at(1), "no ball in sight");
    EXPECT_THAT(faults.at(3), testing::HasSubstr("signal 9"));
  }
}

// Mutation: a status of 0 that is always an end in good order.
TEST(ProcessPool, ATaskThatEndsItsProcessIsACrash) {
  const Task task = [](std::size_t index, const auto& report) {
    if (index == 2) ::_exit(0);
    return square(index, report);
  };
  EXPECT_THROW(run_in_processes(4, 1, task, kSilent), WorkerCrash);
}

TEST(ProcessPool, CrashOfATaskIsAnErrorThatNamesIt) {
  const Task task = [](std::size_t index, const auto& report) {
    if (index == 5) ::raise(SIGKILL);
    return square(index, report);
  };
  EXPECT_THAT([&] { run_in_processes(8, 1, task, kSilent); },
              testing::ThrowsMessage<WorkerCrash>(
                  testing::AllOf(testing::HasSubstr("signal 9"), testing::HasSubstr("task 5"))));
}

// Mutation: passed on as any other error.
TEST(ProcessPool, ABreakdownOfATaskIsOneForTheCaller) {
  const Task task = [](std::size_t, const auto&) -> std::string { throw RunCrash("the detector is gone"); };
  EXPECT_THAT([&] { run_in_processes(2, 1, task, kSilent); },
              testing::ThrowsMessage<RunCrash>("the detector is gone"));
}

// Mutations: not waiting for the children leaves zombies, which waitpid finds; not killing them first lasts
// until they wake up.
TEST(ProcessPool, LeavesNoChildBehindAndWaitsForNoneThatIsAtWork) {
  const Task task = [](std::size_t index, const auto&) -> std::string {
    if (index == 0) throw std::runtime_error("stop");
    std::this_thread::sleep_for(std::chrono::seconds(20));
    return "";
  };
  const auto began = std::chrono::steady_clock::now();
  EXPECT_THROW(run_in_processes(4, 3, task, kSilent), std::runtime_error);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(ProcessPool, ProgressGrowsToTheNumberOfTasks) {
  double last = 0.0;
  bool grows = true;
  run_in_processes(9, 2, square, [&](double done) {
    grows = grows && done >= last;
    last = done;
  });
  EXPECT_TRUE(grows);
  EXPECT_EQ(last, 9.0);
}

TEST(ProcessPool, RefusesToRunWithoutJobs) {
  EXPECT_THROW(run_in_processes(1, 0, square, kSilent), std::invalid_argument);
}

}  // namespace
}  // namespace stereobench::harness
