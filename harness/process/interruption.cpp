#include "harness/process/interruption.h"

#include <csignal>
#include <cstdlib>
#include <string_view>

#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "harness/io/atomic_file.h"

namespace stereobench::harness {
namespace {

volatile std::sig_atomic_t work_is_kept = 0;

void write_line(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Whether a handler runs in the main thread, whose work stands still meanwhile. Elsewhere it would remove
/// one file while that thread begins the next one; then the signal is sent on.
bool is_in_main_thread(int signal) {
  if (::gettid() == ::getpid()) return true;
  ::syscall(SYS_tgkill, ::getpid(), ::getpid(), signal);
  return false;
}

/// Calls what POSIX allows a signal's handler, and nothing else.
void end_program(int signal) {
  if (!is_in_main_thread(signal)) return;
  remove_unfinished_files();
  if (::isatty(STDERR_FILENO) == 1) write_line("\r\033[K");  // in place of a progress line
  write_line(signal == SIGINT ? "stereobench: interrupted (SIGINT)" : "stereobench: terminated (SIGTERM)");
  write_line(work_is_kept != 0 ? "; what is finished is kept, and the same command goes on from there\n"
                               : "\n");
  ::_exit(128 + signal);
}

pid_t parent_of_worker = 0;

/// SIGTERM to a worker: from the kernel when its parent has ended, from others while that is still there.
void end_orphan(int signal) {
  if (::getppid() == parent_of_worker || !is_in_main_thread(signal)) return;
  remove_unfinished_files();
  ::_exit(128 + signal);
}

}  // namespace

void end_on_signals() {
  struct sigaction action {};
  action.sa_handler = end_program;
  for (const int signal : {SIGINT, SIGTERM}) ::sigaddset(&action.sa_mask, signal);
  for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
}

void say_that_work_is_kept() {
  work_is_kept = 1;
}

void follow_parent(pid_t parent) {
  parent_of_worker = parent;
  ::signal(SIGINT, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = end_orphan;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGTERM, &action, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);  // it ended before the line above
}

}  // namespace stereobench::harness
