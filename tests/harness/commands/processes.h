/// Other processes, as /proc shows them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace stereobench::harness {

/// Whether a process is there and has not ended. One that has ended and was not waited for is not.
bool is_alive(pid_t process);

/// Whether a process ignores a signal.
bool ignores(pid_t process, int signal);

/// The children of a process that are alive.
std::vector<pid_t> children_of(pid_t process);

/// Waits up to two minutes for something: under the sanitizers a seed of a run takes more than ten seconds.
/// @return whether it came true
bool comes_true_in_time(const std::function<bool()>& condition);

/// Starts the program in a shell: `command` stands after its path, with redirections and all.
/// @return the process, which is the program itself
pid_t start_stereobench(const std::string& command);

/// Waits for a process that was started. @return its exit code, or 128 + signal
int exit_code_of(pid_t process);

}  // namespace stereobench::harness
