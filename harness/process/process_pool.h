/// Work spread over processes: OpenGL in software has one rasteriser lock per process, and a task that
/// crashes must not take the others with it.
#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace stereobench::harness {

/// A run broke down, through no fault of what it was given.
class RunCrash : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A task ended without an answer: its process crashed or was killed.
class WorkerCrash : public RunCrash {
 public:
  using RunCrash::RunCrash;
};

/// Computes the answer of one task, as bytes.
/// @param index of the task
/// @param report tells the parent how far the task is, in [0, 1]
using Task = std::function<std::string(std::size_t index, const std::function<void(double)>& report)>;

/// Told by the parent as tasks move on: the sum of all tasks' fractions, in [0, tasks].
using OnProgress = std::function<void(double tasks_done)>;

/// Told by the parent when a task has ended, in the order in which tasks end.
using OnAnswer = std::function<void(std::size_t index, std::string answer)>;

/// Told by the parent that a task has failed, or that its process died: the message.
using OnFault = std::function<void(std::size_t index, std::string message)>;

/// Runs `task` for each index in forked processes, and hands on each answer as soon as it is there.
/// @param tasks how many there are
/// @param jobs processes at a time, >= 1
/// @throws std::runtime_error with the message of the first task that fails, at once, a RunCrash when it was
///   one; WorkerCrash when a process dies. The other processes are ended either way, and also when the caller
///   is killed.
void run_in_processes(std::size_t tasks, int jobs, const Task& task, const OnAnswer& on_answer,
                      const OnProgress& on_progress);

/// The same, but a task that fails or whose process dies does not end the others.
void run_all_in_processes(std::size_t tasks, int jobs, const Task& task, const OnAnswer& on_answer,
                          const OnFault& on_fault, const OnProgress& on_progress);

/// The same as run_in_processes, with the answers handed on in the order of index, so that the outcome
/// depends neither on the number of jobs nor on which task ends first. An answer that comes before its turn
/// waits in memory.
void run_in_order(std::size_t tasks, int jobs, const Task& task, const OnAnswer& on_answer,
                  const OnProgress& on_progress);

/// The same, and gives the answers in order of index, so that the outcome depends neither on the number of
/// jobs nor on which task ends first.
/// @return one answer a task
std::vector<std::string> run_in_processes(std::size_t tasks, int jobs, const Task& task,
                                          const OnProgress& on_progress);

}  // namespace stereobench::harness
