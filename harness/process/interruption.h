/// What SIGINT and SIGTERM do to the program and to its worker processes.
#pragma once

#include <sys/types.h>

namespace stereobench::harness {

/// Makes SIGINT and SIGTERM end this process with a line on standard error and exit code 130 or 143. A file
/// that is just being written is removed; workers and detectors end because their parent does.
void end_on_signals();

/// What the line says besides: that the same command goes on from what is finished.
void say_that_work_is_kept();

/// In a forked worker: ends it as soon as its parent ends, with the file that it is just writing removed, and
/// leaves SIGINT and SIGTERM, which terminals and service managers send to all processes at once, to the
/// parent.
/// @param parent the process that forked it
void follow_parent(pid_t parent);

}  // namespace stereobench::harness
