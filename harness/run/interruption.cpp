#include "harness/run/interruption.h"

#include <csignal>
#include <cstdlib>
#include <string_view>

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "harness/dataset/atomic_file.h"

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

/// Calls what POSIX allows a signal's handler, and nothing else.
void end_program(int signal) {
  remove_unfinished_file();
  if (::isatty(STDERR_FILENO) == 1) write_line("\r\033[K");  // in place of a progress line
  write_line(signal == SIGINT ? "stereobench: interrupted (SIGINT)" : "stereobench: terminated (SIGTERM)");
  write_line(work_is_kept != 0 ? "; what is finished is kept, and the same command goes on from there\n"
                               : "\n");
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
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(EXIT_FAILURE);  // it ended before the line above
  for (const int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_IGN);
}

}  // namespace stereobench::harness
